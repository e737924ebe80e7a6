// SPDX-License-Identifier: GPL-3.0-or-later
#include "estimate/estimate_twin.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "hyperex/anatomy/register_face.hpp"
#include "hyperex/core/within_95.hpp"
#include "hyperex/estimate/standard_expressions.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/motion/stabilise.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"
#include "muscles/a_face.hpp"
#include "support/finite_twin.hpp"

namespace hyperex::estimate::test {
namespace {

std::vector<double> part(const tissue::TissueFieldMaker& maker, const std::string& name) {
  tissue::TissueFieldOptions options;
  tissue::TissueRegion region;
  region.name = name;
  region.factor[tissue::young] = 2;
  options.regions = {region};
  std::vector<double> out = maker.make(options).element[tissue::young];
  for (double& young : out) young = young / tissue::default_parameters[tissue::young] - 1;
  return out;
}

Points places_of(const std::vector<std::string>& points) {
  Points out(Eigen::Index(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    out.row(Eigen::Index(i)) = programs_mesh().face.landmarks.at(points[i]).transpose();
  return out;
}

void add_noise(motion::Motion& motion, double noise_m, std::mt19937& random) {
  std::normal_distribution<double> normal(0, noise_m);
  for (Points& at : motion.positions)
    for (double& coordinate : at.reshaped()) coordinate += normal(random);
}

}  // namespace

TwinMesh::TwinMesh(double element_size_m) {
  const muscles::test::AFace face_here(element_size_m);
  face.mesh = std::make_shared<const tissue::TissueMesh>(face_here.mesh);
  face.landmarks = face_here.landmarks;
  const anatomy::EmbeddedFace scan = anatomy::embedded_face();
  const auto registered = anatomy::register_canonical_face(face.landmarks, scan.mesh);
  const tissue::TissueFieldMaker maker(*face.mesh, face.landmarks, &registered);
  cheek_L = part(maker, "cheek_L");
  cheek_R = part(maker, "cheek_R");
}

const TwinMesh& programs_mesh() {
  static const TwinMesh mesh(0.005);
  return mesh;
}
const TwinMesh& truths_mesh() {
  static const TwinMesh mesh(0.0042);
  return mesh;
}

std::vector<std::string> inner_points() {
  std::vector<std::string> out;
  for (int p = 6; p < 68; ++p)
    if (p <= 10 || p >= 17) out.push_back(face::ibug(p));
  return out;
}

FaceModel model_of(const Question& question, const std::vector<std::string>& points) {
  const TwinMesh& mesh = programs_mesh();
  return face_model(*mesh.face.mesh, mesh.face.landmarks, mesh.face.options, points,
                    places_of(points), question);
}

std::vector<Observation> observations_of(const Patient& patient,
                                         const std::vector<std::string>& expressions,
                                         const std::vector<std::string>& points) {
  using hyperex::test::TwinTruth;
  const TwinMesh& truth_mesh = truths_mesh();
  const double root = std::sqrt(patient.cheek_ratio);
  hyperex::test::TwinChange change{"patient", {}, {{patient.weak, patient.gain}}};
  for (std::size_t t = 0; t < truth_mesh.cheek_L.size(); ++t)
    change.young_factor.push_back((1 + truth_mesh.cheek_L[t] * (root - 1)) *
                                  (1 + truth_mesh.cheek_R[t] * (1 / root - 1)));
  const std::vector<hyperex::test::TwinChange> changes{change};
  const auto muscles = hyperex::test::displaced_lines(muscles::muscle_template(),
                                                      1e3 * patient.lines_off_m, patient.seed);
  const TwinTruth truth(truth_mesh.face, muscles, patient.young_factor, changes, points);
  std::mt19937 random(patient.seed);
  std::normal_distribution<double> normal;
  std::vector<Observation> out;
  for (const std::string& name : expressions) {
    const auto expression =
        std::ranges::find(standard_expressions(), name, &StandardExpression::name);
    hyperex::test::Activations activations;
    const double sides = patient.uneven * normal(random);
    for (const auto& [muscle, activation] : expression->activations) {
      const double own = patient.uneven * normal(random);
      activations[muscle + "_L"] = activation * (1 + sides + own);
      activations[muscle + "_R"] = activation * (1 - sides - own);
    }
    simulate::JawPose jaw = simulate::JawPose::Zero();
    jaw[0] = expression->opening_rad;
    RecordingErrors errors{
        .jitter_m = std::max(1e-5, patient.noise_m), .head_turn_rad = 2e-3, .head_shift_m = 2e-4};
    auto motion = truth.recorded(activations, 0, 0, patient.finite ? 0 : 1, jaw);
    if (patient.finite) {
      motion.motion = hyperex::test::at_finite_strain(truth_mesh.face, motion, muscles,
                                                      patient.young_factor, changes)
                          .back();
      motion.rest = motion.motion.positions.front();
    }
    add_noise(motion.motion, patient.noise_m, random);
    out.push_back(observe(motion, points, errors, name));
    const Points places = places_of(points);
    const Eigen::RowVector3d middle = places.colwise().mean();
    const Vec3 turn =
        errors.head_turn_rad * Vec3::NullaryExpr([&](auto) { return normal(random); });
    const Vec3 shift =
        errors.head_shift_m * Vec3::NullaryExpr([&](auto) { return normal(random); });
    for (Eigen::Index p = 0; p < places.rows(); ++p)
      out.back().displacement_m.segment<3>(3 * p) +=
          turn.cross((places.row(p) - middle).transpose()) + shift;
  }
  return out;
}

Observation lying_observation_of(const Patient& patient, double young_factor,
                                 const std::array<Vec3, 2>& turned,
                                 const std::vector<std::string>& points) {
  const auto& face = truths_mesh().face;
  KnownLoad load = lying_down(face.landmarks);
  const Points places = places_of(points);
  FaceResponses responses(*face.mesh, face.landmarks, face.options, points, places, {}, {load});
  responses.set_stiffness(Eigen::VectorXd::Constant(1, std::log(patient.young_factor)));
  load.before += turned[0].cross(load.before);
  load.after += turned[1].cross(load.after);
  const Eigen::VectorXd moved = responses.columns().loads[0] * load.amount() / young_factor;
  simulate::AlignedMotion motion;
  motion.motion.names = motion.common = points;
  motion.rest = places;
  constexpr int kUpright = 20, kLying = 20;
  for (int k = 0; k < kUpright + kLying; ++k) {
    motion.motion.time_s.push_back(k / 30.0);
    Points at = places;
    if (k >= kUpright)
      for (Eigen::Index p = 0; p < at.rows(); ++p) at.row(p) += moved.segment<3>(3 * p).transpose();
    motion.motion.positions.push_back(at);
  }
  std::mt19937 random(patient.seed + 1000);
  add_noise(motion.motion, patient.noise_m, random);
  const Eigen::AngleAxisd turn(-std::numbers::pi / 2, Vec3::UnitX());
  for (std::size_t k = kUpright; k < motion.motion.positions.size(); ++k)
    motion.motion.positions[k] *= turn.toRotationMatrix().transpose();
  const motion::StabilisedMotion steady = motion::stabilise(motion.motion);
  motion.motion = steady.motion;
  const auto greatest = [](const std::vector<double>& bounds) {
    return *std::ranges::max_element(bounds) / kWithin95;
  };
  Observation out = observe_load(motion, points,
                                 {patient.noise_m, greatest(steady.turn_uncertainty_rad),
                                  greatest(steady.shift_uncertainty_m)},
                                 "lying");
  out.load = 0;
  return out;
}

}  // namespace hyperex::estimate::test
