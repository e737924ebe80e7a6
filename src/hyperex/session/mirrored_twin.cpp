// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/mirrored_twin.hpp"

#include <fmt/format.h>

#include "hyperex/face/canonical_face.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/muscles/muscle_template.hpp"
#include "hyperex/session/simulation_options.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "hyperex/tissue/field/layers.hpp"

namespace hyperex::session {
namespace {

constexpr double counterpart_within_m = 0.005;

/// The row that point i has its counterpart in; -1: none.
int counterpart_of(const simulate::AlignedMotion& motion, const metrics::MidsagittalPlane& plane,
                   int i) {
  const std::string& name = motion.motion.names[std::size_t(i)];
  const bool landmark = face::canonical_face().landmarks.contains(name) || name.ends_with("_L") ||
                        name.ends_with("_R");
  if (landmark) return motion.motion.index_of(face::mirrored_landmark(name));
  Eigen::Index nearest = 0;
  const double apart =
      (motion.rest.rowwise() - plane.reflect(motion.rest.row(i).transpose()).transpose())
          .rowwise()
          .norm()
          .minCoeff(&nearest);
  return apart <= counterpart_within_m ? static_cast<int>(nearest) : -1;
}

/// Names of the points that the simulation uses: driven points and points of the jaw.
std::vector<std::string> used_points(const scene::Scene& scene, const Inputs& inputs) {
  std::vector<std::string> names = inputs.driven;
  const auto& jaw = scene.support.jaw_points;
  names.insert(names.end(), jaw.begin(), jaw.end());
  for (const std::string& chin : {face::ibug(8), std::string("pogonion")})
    if (inputs.motion.motion.index_of(chin) >= 0) names.push_back(chin);
  return names;
}

}  // namespace

std::optional<simulate::AlignedMotion> mirrored_motion(const simulate::AlignedMotion& motion,
                                                       const metrics::MidsagittalPlane& plane,
                                                       const std::vector<std::string>& needed,
                                                       std::string& why_not) {
  simulate::AlignedMotion out = motion;
  std::vector<int> counterpart(std::size_t(motion.rest.rows()));
  for (std::size_t i = 0; i < counterpart.size(); ++i)
    counterpart[i] = counterpart_of(motion, plane, static_cast<int>(i));
  for (const std::string& name : needed)
    if (const int row = motion.motion.index_of(name); row >= 0 && counterpart[row] < 0) {
      why_not = fmt::format("point {} has no counterpart on the other side in the motion", name);
      return std::nullopt;
    }
  for (std::size_t k = 0; k < out.motion.positions.size(); ++k)
    for (std::size_t i = 0; i < counterpart.size(); ++i) {
      if (counterpart[i] < 0) continue;
      const Vec3 moved = motion.motion.positions[k].row(counterpart[i]) -
                         motion.motion.positions.front().row(counterpart[i]);
      out.motion.positions[k].row(Eigen::Index(i)) =
          motion.motion.positions.front().row(Eigen::Index(i)) +
          plane.reflect_vector(moved).transpose();
    }
  return out;
}

void take_mirrored(const tissue::TissueField& field, const tissue::TissueMesh& mesh,
                   const metrics::MidsagittalPlane& plane, simulate::TissueValues& values) {
  const Tetrahedra& tets = mesh.volume.tets;
  Points reflected(tets.rows(), 3);
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    Vec3 centroid = Vec3::Zero();
    for (int k = 0; k < 4; ++k) centroid += mesh.volume.nodes.row(tets(t, k)).transpose() / 4;
    reflected.row(t) = plane.reflect(centroid).transpose();
  }
  const auto feet = SurfaceTree(mesh.skin).query_all(reflected);
  const auto of_elements = [&](const Eigen::VectorXd& skin) {
    std::vector<double> out;
    for (const ClosestPoint& foot : feet) {
      double value = 0;
      for (int k = 0; k < 3; ++k)
        value += foot.weights[k] * skin[mesh.skin.triangles(foot.triangle, k)];
      out.push_back(value);
    }
    return out;
  };
  for (int p = 0; p < tissue::parameter_count; ++p) {
    std::vector<std::vector<double>> layers = {of_elements(field.skin[p])};
    for (const tissue::SkinField& under : field.deeper) layers.push_back(of_elements(under[p]));
    values.element[p] = field.deeper.empty() ? std::move(layers.front())
                                             : tissue::layer_means(field.layer_share, layers);
  }
  values.volume_ratio.clear();
  if (field.skin_volume_ratio.size() > 0)
    values.volume_ratio = of_elements(field.skin_volume_ratio);
}

namespace {

/// Runs `simulator`, which follows the mirrored motion, with the scene's options mirrored.
MirroredTwin twin_of(const scene::Scene& scene, const Inputs& inputs,
                     const tissue::TissueField* field, const metrics::MidsagittalPlane& plane,
                     std::shared_ptr<simulate::Simulator> simulator,
                     const std::function<bool()>& cancelled) {
  simulate::SimulationOptions options = simulation_options(scene, inputs);
  options.solver.method = simulate::SolverMethod::reduced;
  options.solver.verify = false;
  options.time.still_times_s.clear();
  for (simulate::MuscleGain& gain : options.muscles.gains)
    gain.muscle = muscles::other_side(gain.muscle);
  for (simulate::BoneMove& move : options.surgery.bones) {
    move.move_m[0] = -move.move_m[0];
    move.turn_deg[1] = -move.turn_deg[1];
    move.turn_deg[2] = -move.turn_deg[2];
  }
  if (field) take_mirrored(*field, simulator->mesh(), plane, options.tissue);
  simulator->set_options(std::move(options));
  simulate::SimulationResult result =
      simulator->run({.progress = {}, .cancelled = cancelled, .skin_alone = true});
  return {.why_not = {},
          .landmarks = std::move(result.performance.landmarks),
          .skin_displacement_m = std::move(result.performance.skin_displacement_m),
          .neutral_displacement_m = std::move(result.performance.neutral_displacement_m),
          .simulator = std::move(simulator)};
}

}  // namespace

MirroredTwin simulate_twin(const scene::Scene& scene, const Inputs& inputs,
                           const tissue::TissueField* field, const metrics::MidsagittalPlane& plane,
                           const simulate::Simulator& run, const std::function<bool()>& cancelled) {
  MirroredTwin none;
  if (scene.region.measured != simulate::Measured::none) {
    none.why_not = "a region of the skin follows the recording itself";
    return none;
  }
  auto motion = mirrored_motion(inputs.motion, plane, used_points(scene, inputs), none.why_not);
  if (!motion) return none;
  auto simulator = std::make_shared<simulate::Simulator>(run);
  simulator->set_motion(std::move(*motion));
  return twin_of(scene, inputs, field, plane, std::move(simulator), cancelled);
}

MirroredTwin simulate_variants_twin(const scene::Scene& scene, const Inputs& inputs,
                                    const tissue::TissueField* field,
                                    const metrics::MidsagittalPlane& plane,
                                    simulate::Simulator& run, const MirroredTwin& of_base,
                                    const std::function<bool()>& cancelled) {
  // A variant may use options for which there is no twin.
  MirroredTwin none;
  if (!of_base.simulator || scene.region.measured != simulate::Measured::none ||
      !mirrored_motion(inputs.motion, plane, used_points(scene, inputs), none.why_not))
    return simulate_twin(scene, inputs, field, plane, run, cancelled);
  auto simulator = std::make_shared<simulate::Simulator>(*of_base.simulator);
  simulator->hold_load();
  simulator->reuse_factor(std::move(run));
  return twin_of(scene, inputs, field, plane, std::move(simulator), cancelled);
}

}  // namespace hyperex::session
