// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/stabilise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hyperex/geometry/transform.hpp"

namespace hyperex::motion {

namespace {

// Below this the turn about the line through the points is mostly noise.
constexpr double kLeastSpread = 0.02;
// Residuals under this are what any sensor has, and no reason to doubt a point (m).
constexpr double kResidualFloor = 1e-5;

/// The tip of the nose goes with the upper lip: better than a line, worse than anything else.
const std::vector<std::string> kNoseTip = {"ibug68_30", "pronasale"};
// Eye corners alone spread less than this about their line.
constexpr double kWellSpread = 0.2;

Points rows_of(const Points& all, const std::vector<int>& rows) {
  Points some(Eigen::Index(rows.size()), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) some.row(Eigen::Index(i)) = all.row(rows[i]);
  return some;
}

std::vector<int> rigid_indices(const Motion& motion, const std::vector<std::string>& stated) {
  std::vector<int> indices;
  for (const auto& name : stated.empty() ? default_rigid_points() : stated) {
    const int index = motion.index_of(name);
    if (index >= 0)
      indices.push_back(index);
    else if (!stated.empty())
      refuse(motion, "there is no point " + name + ", which was named as moving with the skull");
  }
  const Points first = rows_of(motion.positions[0], indices);
  if (stated.empty() && !(first.allFinite() && spread_off_line(first) > kWellSpread))
    for (const auto& name : kNoseTip)
      if (const int index = motion.index_of(name); index >= 0) indices.push_back(index);
  if (indices.size() < 3)
    refuse(motion, fmt::format("head pose needs three points that move with the skull (eye "
                               "corners, nose); the motion has {}",
                               indices.size()));
  return indices;
}

/// The rigid points of one sample that are measured there and in sample 0.
struct Pairs {
  Points reference, current;
  std::vector<int> rows;  ///< into the list of rigid points
};

Pairs pairs_at(const Motion& motion, const std::vector<int>& rigid, std::size_t k) {
  Pairs pairs;
  for (int i = 0; i < int(rigid.size()); ++i)
    if (motion.positions[0].row(rigid[std::size_t(i)]).allFinite() &&
        motion.positions[k].row(rigid[std::size_t(i)]).allFinite())
      pairs.rows.push_back(i);
  pairs.reference.resize(Eigen::Index(pairs.rows.size()), 3);
  pairs.current.resize(Eigen::Index(pairs.rows.size()), 3);
  for (std::size_t j = 0; j < pairs.rows.size(); ++j) {
    const int point = rigid[std::size_t(pairs.rows[j])];
    pairs.reference.row(Eigen::Index(j)) = motion.positions[0].row(point);
    pairs.current.row(Eigen::Index(j)) = motion.positions[k].row(point);
  }
  if (pairs.rows.size() < 3)
    refuse(motion, fmt::format("at {:.4g} s only {} of the points that move with the skull are "
                               "measured: three are needed",
                               motion.time_s[k], pairs.rows.size()));
  if (std::min(spread_off_line(pairs.reference), spread_off_line(pairs.current)) < kLeastSpread)
    refuse(motion, fmt::format("at {:.4g} s the points that move with the skull lie on one line: "
                               "head pose cannot be told from them",
                               motion.time_s[k]));
  return pairs;
}

/// Root mean square residual of each rigid point over the motion.
Eigen::VectorXd point_residuals(const std::vector<Pairs>& pairs,
                                const std::vector<Eigen::Isometry3d>& poses, Eigen::Index points) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(points), count = sum;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    for (std::size_t j = 0; j < pairs[k].rows.size(); ++j) {
      const Eigen::Index row = Eigen::Index(j);
      const Vec3 moved = poses[k] * pairs[k].reference.row(row).transpose();
      sum(pairs[k].rows[j]) += (moved - pairs[k].current.row(row).transpose()).squaredNorm();
      count(pairs[k].rows[j]) += 1;
    }
  return (sum.array() / count.array().max(1)).sqrt();
}

Eigen::VectorXd cauchy_weights(const Eigen::VectorXd& residuals) {
  std::vector<double> sorted(residuals.data(), residuals.data() + residuals.size());
  std::nth_element(sorted.begin(), sorted.begin() + long(sorted.size() / 2), sorted.end());
  const double scale = std::max(sorted[sorted.size() / 2], kResidualFloor);
  const Eigen::VectorXd weights = 1 / (1 + (residuals.array() / scale).square());
  return weights / weights.maxCoeff();
}

Eigen::VectorXd weights_of(const Pairs& pairs, const Eigen::VectorXd& weights) {
  Eigen::VectorXd own(Eigen::Index(pairs.rows.size()));
  for (std::size_t j = 0; j < pairs.rows.size(); ++j) own(Eigen::Index(j)) = weights(pairs.rows[j]);
  return own;
}

}  // namespace

const std::vector<std::string>& default_rigid_points() {
  static const std::vector<std::string> names = {
      "ibug68_36",     "ibug68_39",      "ibug68_42",      "ibug68_45", "ibug68_27",
      "ibug68_28",     "ibug68_29",      "ibug68_0",       "ibug68_16", "exocanthion_R",
      "exocanthion_L", "endocanthion_R", "endocanthion_L", "nasion"};
  return names;
}

StabilisedMotion stabilise(const Motion& motion, const StabiliseOptions& options) {
  if (motion.positions.empty()) refuse(motion, "there are no samples");
  const std::vector<int> rigid = rigid_indices(motion, options.rigid_points);
  std::vector<Pairs> pairs;
  for (std::size_t k = 0; k < motion.positions.size(); ++k)
    pairs.push_back(pairs_at(motion, rigid, k));

  StabilisedMotion result;
  for (const int index : rigid) result.rigid_points.push_back(motion.names[std::size_t(index)]);
  result.weights = Eigen::VectorXd::Ones(Eigen::Index(rigid.size()));
  std::vector<Eigen::Isometry3d> poses(pairs.size());
  for (int round = 0;; ++round) {
    for (std::size_t k = 0; k < pairs.size(); ++k)
      poses[k] =
          fit_rigid(pairs[k].reference, pairs[k].current, weights_of(pairs[k], result.weights));
    if (round >= options.reweightings) break;
    result.weights = cauchy_weights(point_residuals(pairs, poses, result.weights.size()));
  }
  poses[0] = Eigen::Isometry3d::Identity();

  result.motion = motion;
  result.motion.head_pose = poses;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Eigen::Isometry3d head_from_reference = poses[k].inverse();
    const Points& seen = motion.positions[k];
    result.motion.positions[k] = (seen * head_from_reference.linear().transpose()).rowwise() +
                                 head_from_reference.translation().transpose();
    Points moved = (pairs[k].reference * poses[k].linear().transpose()).rowwise() +
                   poses[k].translation().transpose();
    result.rms_residual_m.push_back(
        rms_distance(moved, pairs[k].current, weights_of(pairs[k], result.weights)));
  }
  return result;
}

}  // namespace hyperex::motion
