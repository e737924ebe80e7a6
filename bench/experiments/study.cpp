// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiments/study.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cstdio>

#include "hyperex/face/canonical_face.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/metrics/midsagittal.hpp"

namespace hyperex::bench {
namespace {

/// Marks the drive as given, so that the scene's own drive or its default is used.
scene::Scene with_own_drive(scene::Scene scene) {
  scene.origins.emplace("drive.by", scene::Origin{scene.file, 0});
  return scene;
}

}  // namespace

Study::Study(const std::filesystem::path& scene, const std::vector<std::string>& overrides)
    : scene_(with_own_drive(scene::read_scene(scene, overrides))),
      session_(scene_, {.certainty = session::Certainty::on_request}),
      frame_(face::face_frame(session_.inputs().landmarks)),
      base_(session_.simulator()) {
  simulate::SimulationOptions options = base_.options();
  options.tissue.element = {};  // every trial has its own
  base_.set_options(std::move(options));
  base_.run();
}

std::string Study::name() const {
  return embedded() ? "embedded face" : "subject A";
}

Tissue Study::tissue_of(const scene::Scene& scene) {
  const simulate::TissueValues values = session_.tissue_of(scene);
  Tissue tissue = values.element;
  for (int p = 0; p < tissue::parameter_count; ++p)
    if (tissue[p].empty())
      tissue[p].assign(std::size_t(mesh().volume.tets.rows()), values.uniform[p]);
  return tissue;
}

simulate::SimulationResult Study::simulate(const Trial& trial) const {
  return simulate(trial, nullptr);
}

simulate::SimulationResult Study::simulate(const Trial& trial,
                                           const simulate::AlignedMotion& motion) const {
  return simulate(trial, &motion);
}

simulate::SimulationOptions Study::options_of(const Trial& trial) const {
  // Differences of some hundredths of a millimetre are evaluated. The reduced model must therefore
  // be more accurate than in an ordinary run.
  constexpr double tolerance = 1e-4;
  simulate::SimulationOptions options = base_.options();
  options.model.element = trial.element;
  options.solver.tolerance = tolerance;
  if (!trial.reduced) options.solver.method = simulate::SolverMethod::direct;
  options.model.viscous_form = trial.form;
  options.tissue.element = trial.tissue;
  return options;
}

simulate::SimulationResult Study::simulate(const Trial& trial,
                                           const simulate::AlignedMotion* motion) const {
  simulate::Simulator simulator = base_;
  simulator.set_options(options_of(trial));
  if (motion) simulator.set_motion(*motion);
  return simulator.run();
}

std::vector<simulate::SimulationResult> Study::by_same_forces(
    const std::vector<Trial>& trials) const {
  simulate::Simulator simulator = base_;
  std::vector<simulate::SimulationResult> results;
  for (const Trial& trial : trials) {
    simulator.set_options(options_of(trial));
    results.push_back(simulator.run());
    simulator.hold_load();
  }
  return results;
}

void Study::simulate_all(
    const std::vector<Trial>& trials,
    const std::function<void(std::size_t, simulate::SimulationResult)>& take) const {
  std::atomic<int> done = 0;
  tbb::parallel_for(std::size_t(0), trials.size(), [&](std::size_t i) {
    take(i, simulate(trials[i]));
    if (const int now = ++done; now % 10 == 0 || now == int(trials.size()))
      fmt::print(stderr, "  {}: {} of {} simulations\n", name(), now, trials.size());
  });
}

metrics::SymmetryCurve Study::symmetry_of(const motion::Motion& landmarks) const {
  return metrics::symmetry_of(landmarks, scene_.output.symmetry_floor, inputs().jitter_m);
}

simulate::AlignedMotion Study::mirrored_motion() const {
  const metrics::MidsagittalPlane plane =
      metrics::midsagittal_plane(inputs().scan.mesh, inputs().landmarks);
  simulate::AlignedMotion mirrored = inputs().motion;
  const motion::Motion& from = inputs().motion.motion;
  for (std::size_t p = 0; p < from.names.size(); ++p) {
    const int other = from.index_of(face::mirrored_landmark(from.names[p]));
    if (other < 0) continue;  // a point without a counterpart keeps its motion
    for (std::size_t k = 0; k < from.positions.size(); ++k) {
      const Vec3 moved = (from.positions[k].row(other) - from.positions[0].row(other)).transpose();
      mirrored.motion.positions[k].row(Eigen::Index(p)) =
          from.positions[0].row(Eigen::Index(p)) + plane.reflect_vector(moved).transpose();
    }
  }
  return mirrored;
}

Points track_of(const motion::Motion& landmarks, const std::string& name) {
  const int row = landmarks.index_of(name);
  if (row < 0) throw std::invalid_argument("no landmark " + name);
  Points track(Eigen::Index(landmarks.positions.size()), 3);
  for (std::size_t k = 0; k < landmarks.positions.size(); ++k)
    track.row(Eigen::Index(k)) = landmarks.positions[k].row(row);
  return track;
}

Tissue times(Tissue tissue, tissue::Parameter parameter, double factor) {
  for (double& value : tissue[parameter]) value *= factor;
  return tissue;
}

Tissue at_once(Tissue tissue) {
  constexpr double hardly_any = 0.01;
  return times(times(std::move(tissue), tissue::viscosity, hardly_any), tissue::density,
               hardly_any);
}

std::vector<std::string> undriven_landmarks(const Study& study, const simulate::Performance& p) {
  constexpr double moves_m = 1e-3;
  const double clear_m = 2 * study.scene().drive.patch_radius_m;
  std::vector<std::string> names;
  for (const std::string& name : p.landmarks.names) {
    const Points track = track_of(p.landmarks, name);
    bool kept = (track.rowwise() - track.row(0)).rowwise().norm().maxCoeff() > moves_m;
    for (const auto at : p.driven_points_rest.rowwise())
      kept = kept && (at - track.row(0)).norm() > clear_m;
    if (kept) names.push_back(name);
  }
  return names;
}

}  // namespace hyperex::bench
