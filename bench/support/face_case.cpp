// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/face_case.hpp"

#include <cmath>

#include "hyperex/motion/resample.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/session/inputs.hpp"
#include "support/timing.hpp"

namespace hyperex::bench {
namespace {

namespace fs = std::filesystem;

scene::Scene scene_of(Face face) {
  const fs::path scan =
      fs::path(HYPEREX_SOURCE_DIR) / "../shared/data/ict/subject_A_neutral_scan.ply";
  const bool subject_a = face == Face::subject_a_if_there && fs::exists(scan);
  return scene::read_scene(
      fs::path(HYPEREX_SOURCE_DIR) /
      (subject_a ? "bench/scenes/subject_a_mouth_open.toml" : "examples/mouth_open.toml"));
}

}  // namespace

FaceCase::FaceCase(Face face, const MeshSize& size) {
  scene::Scene scene = scene_of(face);
  if (size.element_size_m > 0) scene.mesh.element_size_m = size.element_size_m;
  if (size.layers > 0) scene.mesh.layers = size.layers;
  // The benchmark starts after the choice of the drive, so that the scene's own drive is used.
  scene.origins.emplace("drive.by", scene::Origin{scene.file, 0});
  const session::FaceSession session(scene, {.certainty = session::Certainty::on_request});
  name_ = scene.title;
  landmarks_ = session.inputs().landmarks;
  motion_ = session.inputs().motion;
  options_ = session.options(0);
  mesh_ = session.shared_mesh();
  mesh_s_ = session.seconds().mesh;
  const auto region = simulate::measured_region(mesh(), landmarks_, motion_, options_.region);
  boundary_ = std::make_unique<simulate::Boundary>(mesh(), landmarks_, motion_, region,
                                                   options_.drive, options_.support);

  points_ = std::make_unique<simulate::PointCurve>(motion_, options_.drive.gain);
  start_s_ = motion_.motion.time_s.front();
  const double end_s =
      options_.time.end_s > 0 ? options_.time.end_s : motion_.motion.time_s.back() - start_s_;
  dt_s_ = options_.time.step_s;
  steps_ = static_cast<int>(std::ceil(end_s / dt_s_ - 1e-9));
  double most = -1;
  for (double t = 0; t <= end_s; t += 1 / options_.time.frame_rate_hz)
    if (const double moved = points_->at(t).norm(); moved > most) {
      most = moved;
      peak_s_ = t;
    }
}

simulate::Simulator FaceCase::simulator() const {
  return {mesh_, landmarks_, motion_, options_};
}

fem::Material FaceCase::material(double viscosity_factor) const {
  simulate::TissueValues values = options_.tissue;
  values.uniform[tissue::viscosity] *= viscosity_factor;
  return values.material(static_cast<std::size_t>(mesh().volume.tets.rows()),
                         options_.model.viscous_form);
}

void FaceCase::assemble(const fem::Assembler& assembler, const fem::Material& material,
                        fem::System& system) const {
  assembler.assemble(material, system);
  boundary_->add_springs(system.stiffness);
}

fem::System FaceCase::system(fem::ElementKind kind, double viscosity_factor) const {
  const fem::Assembler assembler(mesh().volume.nodes, mesh().volume.tets, kind);
  fem::System system;
  assemble(assembler, material(viscosity_factor), system);
  return system;
}

fem::Drive FaceCase::shapes(const std::function<Points(double)>& points, double tolerance,
                            int steps) const {
  // A copy: following the jaw starts at its last position, so that the Boundary belongs to one
  // result.
  simulate::Boundary boundary = *boundary_;
  return simulate::input_shapes(boundary, points, dt_s_, steps, 1e-3 * tolerance).drive;
}

fem::Drive FaceCase::drive(double solver_tolerance, int steps) const {
  return shapes([this](double t) { return points_->at(t); }, solver_tolerance,
                steps > 0 ? steps : steps_);
}

fem::Drive FaceCase::sine(double period_s, double solver_tolerance) const {
  const Points peak = points_->at(peak_s_);
  // Sampled like a recording, at the camera's instants, then interpolated by the same spline.
  motion::Motion recorded = motion_.motion;
  for (std::size_t k = 0; k < recorded.time_s.size(); ++k)
    recorded.positions[k] = std::sin(2 * M_PI * (recorded.time_s[k] - start_s_) / period_s) * peak;
  const motion::MotionCurve curve(recorded);
  return shapes([&](double t) -> Points { return curve.at(start_s_ + t); }, solver_tolerance,
                steps_);
}

double greatest_apart(const Eigen::Ref<const Eigen::VectorXd>& a,
                      const Eigen::Ref<const Eigen::VectorXd>& b) {
  double most = 0;
  for (Eigen::Index n = 0; n < a.size(); n += 3)
    most = std::max(most, (a.segment<3>(n) - b.segment<3>(n)).squaredNorm());
  return std::sqrt(most);
}

double greatest(const Eigen::Ref<const Eigen::MatrixXd>& d) {
  double most = 0;
  for (Eigen::Index c = 0; c < d.cols(); ++c)
    for (Eigen::Index n = 0; n < d.rows(); n += 3)
      most = std::max(most, d.col(c).segment<3>(n).squaredNorm());
  return std::sqrt(most);
}

}  // namespace hyperex::bench
