// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/estimate/known_load.hpp"

#include <cmath>

#include "hyperex/core/error.hpp"
#include "hyperex/face/face_frame.hpp"

namespace hyperex::estimate {
namespace {

constexpr double kGravity_m_s2 = 9.81, kFarthest_m = 0.01;

/// Share of a weight at `place` that each node of the skin carries; the shares sum to 1.
Eigen::VectorXd shares_about(const tissue::TissueMesh& mesh, const Vec3& place) {
  const auto skin = mesh.volume.nodes.topRows(mesh.volume.surface_nodes());
  const Eigen::VectorXd squares = (skin.rowwise() - place.transpose()).rowwise().squaredNorm();
  if (squares.minCoeff() > kFarthest_m * kFarthest_m)
    throw InputError("weight", "expected a place on the simulated skin");
  const Eigen::VectorXd out =
      (-squares / (2 * kWeightSpread_m * kWeightSpread_m)).array().exp().matrix();
  return out / out.sum();
}

}  // namespace

KnownLoad lying_down(const io::Landmarks& landmarks) {
  const face::FaceFrame head = face::face_frame(landmarks);
  return {KnownLoad::Kind::gravity, -kGravity_m_s2 * head.z, -kGravity_m_s2 * head.y, Vec3::Zero()};
}

KnownLoad hung_weight(const io::Landmarks& landmarks, const Vec3& place, double mass_kg) {
  const face::FaceFrame head = face::face_frame(landmarks);
  return {KnownLoad::Kind::weight, -kGravity_m_s2 * mass_kg * head.y, Vec3::Zero(), place};
}

Eigen::MatrixXd unit_forces_of(const KnownLoad& load, const tissue::TissueMesh& mesh,
                               const fem::SparseMatrix& mass) {
  Eigen::MatrixXd each = Eigen::MatrixXd::Zero(mass.rows(), 3);
  const bool gravity = load.kind == KnownLoad::Kind::gravity;
  const Eigen::VectorXd at =
      gravity ? Eigen::VectorXd::Ones(mesh.volume.nodes.rows()) : shares_about(mesh, load.place);
  for (Eigen::Index n = 0; n < at.size(); ++n)
    for (int axis = 0; axis < 3; ++axis) each(3 * n + axis, axis) = at[n];
  return gravity ? Eigen::MatrixXd(mass * each) : each;
}

}  // namespace hyperex::estimate
