// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/jaw.hpp"

#include <numbers>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"

namespace hyperex::simulate {
namespace {
// Weights of the priors beside residuals in millimetres: 1 mm of sliding counts as 0.3 mm of
// residual, one degree of turning as 0.35 mm.
constexpr double slide_weight = 0.3, turn_weight_per_rad = 20;
}  // namespace

JawHinge::JawHinge(const io::Landmarks& landmarks, const anatomy::Bones* bones)
    : frame(face::face_frame(landmarks)),
      centre(0.5 * (landmarks.at(face::ibug(1)) + landmarks.at(face::ibug(15)))) {
  if (!bones || !bones->condyles()) return;
  const anatomy::Condyles& condyles = *bones->condyles();
  centre = 0.5 * (condyles[0] + condyles[1]);
  frame.x = (condyles[0] - condyles[1]).normalized();
  frame.y = (frame.y - frame.y.dot(frame.x) * frame.x).normalized();
  frame.z = frame.x.cross(frame.y);
}

Eigen::Matrix3d JawHinge::turned(double opening, double turn, double tilt) const {
  return (Eigen::AngleAxisd(opening, frame.x) * Eigen::AngleAxisd(turn, frame.y) *
          Eigen::AngleAxisd(tilt, frame.z))
      .toRotationMatrix();
}

Jaw::Jaw(const io::Landmarks& landmarks, const anatomy::Bones* bones) : hinge_(landmarks, bones) {}

Eigen::Isometry3d Jaw::transform(const Parameters& p) const {
  Eigen::Isometry3d t = Eigen::Isometry3d::Identity();
  const face::FaceFrame& axes = hinge_.frame;
  t.linear() = hinge_.turned(p[0], p[1]);
  t.translation() =
      hinge_.centre - t.linear() * hinge_.centre + p[2] * axes.x + p[3] * axes.y + p[4] * axes.z;
  return t;
}

Eigen::Isometry3d Jaw::follow(const Points& rest, const Points& displacement) {
  const Eigen::Index n = rest.rows();
  const auto residual = [&](const Parameters& p) {
    Eigen::VectorXd r(3 * n + 4);
    const Eigen::Isometry3d t = transform(p);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Vec3 x = rest.row(i);
      r.segment<3>(3 * i) = 1e3 * (t * x - x - displacement.row(i).transpose());
    }
    r[3 * n] = turn_weight_per_rad * p[1];
    r.tail<3>() = slide_weight * 1e3 * p.tail<3>();
    return r;
  };
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Eigen::VectorXd r = residual(last_);
    const Eigen::MatrixXd jacobian = central_differences(residual, last_);
    const Eigen::Matrix<double, 5, 5> normal = jacobian.transpose() * jacobian;
    const Parameters change = normal.ldlt().solve(jacobian.transpose() * r);
    last_ -= change;
    if (change.norm() < 1e-10) break;
  }
  return transform(last_);
}

double Jaw::opening_deg() const {
  return last_[0] * 180 / std::numbers::pi;
}

}  // namespace hyperex::simulate
