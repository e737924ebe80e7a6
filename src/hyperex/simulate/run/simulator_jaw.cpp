// SPDX-License-Identifier: GPL-3.0-or-later
// Where the jaw is during a run.
#include <Eigen/SVD>

#include "hyperex/face/ibug.hpp"
#include "hyperex/simulate/run/simulator_impl.hpp"

namespace hyperex::simulate {
namespace {

/// The rigid motion nearest to x -> x + turn x + slide, which moves `at` alike. Between the samples
/// of a load both are interpolated, and turns do not add up.
Eigen::Isometry3d nearest_rigid(const Boundary::JawMotion& jaw, const Vec3& at) {
  const Eigen::Matrix3d linear = Eigen::Matrix3d::Identity() + jaw.turn;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(linear, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear() = svd.matrixU() * svd.matrixV().transpose();
  out.translation() = linear * at + jaw.slide - out.linear() * at;
  return out;
}

}  // namespace

std::vector<Eigen::Isometry3d> Simulator::Impl::jaw_now_from_rest(
    const std::vector<double>& times_s, const PointCurve& points) const {
  std::vector<Eigen::Isometry3d> out(times_s.size(), Eigen::Isometry3d::Identity());
  if (options.support.mandible == Mandible::held) return out;
  if (options.drive.by == DriveBy::muscles && stages.load.has_value()) {
    const HeldLoad& load = stages.load.value();
    const Eigen::MatrixXd course = course_at(load, jaw_row(load), 12, times_s);
    const Vec3 chin = landmarks->at(face::ibug(8));
    const Eigen::Isometry3d& moved = stages.moved_bones->lower_teeth;
    for (std::size_t i = 0; i < out.size(); ++i) {
      const auto own = course.col(Eigen::Index(i));
      out[i] = nearest_rigid({own.head<9>().reshaped(3, 3), own.tail<3>()}, moved * chin) * moved;
    }
    return out;
  }
  const std::vector<int> rows = jaw_rows(*motion, stages.points->rows, options.support);
  if (rows.empty()) return out;
  Jaw jaw(*landmarks, mesh->bones.get());
  const Points rest = motion->rest(rows, Eigen::all);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = jaw.follow(rest, points.at(times_s[i])(rows, Eigen::all));
  return out;
}

}  // namespace hyperex::simulate
