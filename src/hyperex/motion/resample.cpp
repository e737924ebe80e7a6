// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/resample.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hyperex::motion {

namespace {

/// The interval of rising times that contains t, and the share of the interval before t.
struct Place {
  std::size_t before;
  double share, length;
};

Place place_of(const std::vector<double>& time_s, double t) {
  const std::size_t next = std::upper_bound(time_s.begin(), time_s.end(), t) - time_s.begin();
  const double length = time_s[next] - time_s[next - 1];
  return {next - 1, (t - time_s[next - 1]) / length, length};
}

Eigen::Isometry3d pose_at(const Motion& motion, double t) {
  if (t <= motion.time_s.front()) return motion.head_pose.front();
  if (t >= motion.time_s.back()) return motion.head_pose.back();
  const Place place = place_of(motion.time_s, t);
  const Eigen::Isometry3d &a = motion.head_pose[place.before],
                          &b = motion.head_pose[place.before + 1];
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond(a.linear()).slerp(place.share, Eigen::Quaterniond(b.linear()));
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = turn.toRotationMatrix();
  pose.translation() = (1 - place.share) * a.translation() + place.share * b.translation();
  return pose;
}

}  // namespace

// Solves a tridiagonal, diagonally dominant system without pivoting.
Eigen::MatrixXd spline_slopes(const std::vector<double>& t, const Eigen::MatrixXd& y) {
  const Eigen::Index n = y.rows();
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(n, y.cols());
  std::vector<double> upper(t.size(), 0.0);
  for (Eigen::Index i = 1; i + 1 < n; ++i) {
    const std::size_t k = std::size_t(i);
    const double h0 = t[k] - t[k - 1], h1 = t[k + 1] - t[k];
    const double lower = 1 / h0, diagonal = 2 / h0 + 2 / h1;
    const double pivot = diagonal - lower * upper[k - 1];
    upper[k] = 1 / h1 / pivot;
    m.row(i) = (3 * (y.row(i) - y.row(i - 1)) / (h0 * h0) +
                3 * (y.row(i + 1) - y.row(i)) / (h1 * h1) - lower * m.row(i - 1)) /
               pivot;
  }
  for (Eigen::Index i = n - 3; i >= 0; --i) m.row(i) -= upper[std::size_t(i)] * m.row(i + 1);
  return m;
}

Eigen::MatrixXd bounded_slopes(const std::vector<double>& t, const Eigen::MatrixXd& y,
                               double smooth_up_to_s) {
  constexpr double slack_s = 1e-9;  // of times that are written as decimals
  Eigen::MatrixXd m = spline_slopes(t, y);
  for (Eigen::Index i = 1; i + 1 < y.rows(); ++i) {
    const std::size_t k = std::size_t(i);
    const double h0 = t[k] - t[k - 1], h1 = t[k + 1] - t[k];
    if (std::max(h0, h1) <= smooth_up_to_s + slack_s) continue;
    for (Eigen::Index c = 0; c < y.cols(); ++c) {
      const double d0 = (y(i, c) - y(i - 1, c)) / h0, d1 = (y(i + 1, c) - y(i, c)) / h1;
      const double most = 3 * std::min(std::abs(d0), std::abs(d1));
      const bool turns = d0 * d1 <= 0;
      m(i, c) =
          turns ? 0 : std::copysign(std::clamp(std::copysign(1.0, d0) * m(i, c), 0.0, most), d0);
    }
  }
  return m;
}

MotionCurve::MotionCurve(const Motion& motion, Interpolation interpolation)
    : time_s_(motion.time_s) {
  if (motion.positions.empty()) refuse(motion, "there are no samples");
  const Eigen::Index points = Eigen::Index(motion.names.size());
  value_.resize(Eigen::Index(time_s_.size()), 3 * points);
  for (std::size_t k = 0; k < time_s_.size(); ++k)
    value_.row(Eigen::Index(k)) =
        Eigen::Map<const Eigen::RowVectorXd>(motion.positions[k].data(), 3 * points);
  if (!value_.allFinite()) refuse(motion, "there are gaps: fill them before interpolating in time");
  if (interpolation == Interpolation::cubic)
    slope_ = bounded_slopes(time_s_, value_, motion.smooth_up_to_s);
}

Points MotionCurve::at(double t_s) const {
  Points result(value_.cols() / 3, 3);
  Eigen::Map<Eigen::RowVectorXd> flat(result.data(), value_.cols());
  if (t_s <= time_s_.front()) {
    flat = value_.row(0);
  } else if (t_s >= time_s_.back()) {
    flat = value_.row(value_.rows() - 1);
  } else {
    const auto [before, u, h] = place_of(time_s_, t_s);
    const Eigen::Index i = Eigen::Index(before);
    const double v = 1 - u;
    if (slope_.size() == 0)
      flat = v * value_.row(i) + u * value_.row(i + 1);
    else
      flat = (1 + 2 * u) * v * v * value_.row(i) + u * u * (1 + 2 * v) * value_.row(i + 1) +
             h * u * v * (v * slope_.row(i) - u * slope_.row(i + 1));
  }
  return result;
}

Motion resample(const Motion& motion, const std::vector<double>& time_s,
                Interpolation interpolation) {
  const MotionCurve curve(motion, interpolation);
  Motion result = motion;
  result.time_s = time_s;
  result.positions.clear();
  result.head_pose.clear();
  for (const double t : time_s) {
    result.positions.push_back(curve.at(t));
    if (!motion.head_pose.empty()) result.head_pose.push_back(pose_at(motion, t));
  }
  return result;
}

}  // namespace hyperex::motion
