// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/stabilise.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "hyperex/core/within_95.hpp"
#include "hyperex/face/canonical_face.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/face/point_words.hpp"
#include "hyperex/face/words_to_point.hpp"
#include "hyperex/geometry/transform.hpp"
#include "hyperex/motion/expressive_pose.hpp"
#include "hyperex/motion/option_error.hpp"
#include "hyperex/motion/still_points.hpp"

namespace hyperex::motion {

namespace {

// Below this spread, the rotation about the line through the points is mostly noise.
constexpr double kLeastSkullSpread = 0.02;
// Smaller residuals (m) occur with any sensor and are no reason to lower a point's weight.
constexpr double kResidualFloor = 1e-5;

/// The tip of the nose moves with the upper lip: it is used only where the other points lie close
/// to a line.
const std::vector<std::string> kNoseTip = {face::ibug(30), "pronasale"};
// The spread of the eye corners alone about their line is smaller than this.
constexpr double kWellSpread = 0.2;
// By how much the errors that expressions cause exceed the prior's: set so that the bounds hold for
// 95 % of expressions, see docs/symmetry.md.
constexpr double kBeyondPrior = 1.5;

Points rows_of(const Points& all, const std::vector<int>& rows) {
  Points some(Eigen::Index(rows.size()), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) some.row(Eigen::Index(i)) = all.row(rows[i]);
  return some;
}

/// "a, b, c and 4 more": as many names as fit into a message without being truncated.
std::string listed(std::vector<std::string> names) {
  constexpr std::size_t most_letters = 240;
  std::size_t shown = 0, letters = 0;
  while (shown < names.size() && (shown == 0 || letters + names[shown].size() <= most_letters))
    letters += names[shown++].size() + 2;
  const std::size_t more = names.size() - shown;
  names.resize(shown);
  return fmt::format("{}{}", fmt::join(names, ", "),
                     more > 0 ? fmt::format(" and {} more", more) : "");
}

constexpr const char* kNeeded =
    "head pose needs three points that move with the skull and not with expressions (eye corners, "
    "bridge of the nose, a band around the forehead, temples, upper teeth)";

/// The end of the message after the option's name: the points that it could name, those found to
/// keep still, else the motion's other points. Names that are not landmarks of a face (of
/// markers on a helmet, for example) come first, since the usual landmarks are tried already.
/// Points that move with the mouth are never proposed.
std::string other_names(const Motion& motion, const std::vector<int>& known) {
  if (const auto still = find_still_points(motion); !still.empty())
    return " names others; these keep still against each other, as points of the skull do: " +
           listed(still);
  std::vector<std::string> names;
  bool of_mouth = false;
  for (int i = 0; i < int(motion.names.size()); ++i) {
    if (std::ranges::find(known, i) != known.end()) continue;
    const std::string& name = motion.names[std::size_t(i)];
    const bool moves = face::moves_with_mouth(name);
    if (moves) of_mouth = true;
    if (!moves) names.push_back(name);
  }
  if (known.size() + names.size() < 3)
    return fmt::format(" finds too few others, as {}: record three such points or more",
                       of_mouth ? "the motion's other points move with mouth and chin"
                                : "the motion has no other points");
  const auto& of_faces = face::canonical_face().landmarks;
  std::ranges::stable_partition(names,
                                [&](const std::string& name) { return !of_faces.contains(name); });
  return fmt::format(" names others; the motion's other points{} are {}",
                     of_mouth ? ", without those of mouth and chin," : "",
                     listed(std::move(names)));
}

/// Points of the mouth and the chin would give the head's pose to the expression.
void refuse_points_of_mouth(const Motion& motion, const std::vector<std::string>& stated) {
  std::vector<std::string> of_mouth;
  for (const auto& name : stated)
    if (face::moves_with_mouth(name)) of_mouth.push_back(face::name_in_words(name));
  if (of_mouth.empty() || stated.size() - of_mouth.size() >= 3) return;
  throw OptionError(named(motion), fmt::format("{}; ", kNeeded), "rigid_points",
                    " names points that move with mouth and chin: " + listed(of_mouth));
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
  refuse_points_of_mouth(motion, stated);
  const Points first = rows_of(motion.positions[0], indices);
  if (stated.empty() && !(first.allFinite() && spread_off_line(first) > kWellSpread))
    for (const auto& name : kNoseTip)
      if (const int index = motion.index_of(name); index >= 0) indices.push_back(index);
  if (indices.size() < 3)
    throw OptionError(named(motion),
                      fmt::format("{}; the motion has {} of them. ", kNeeded, indices.size()),
                      "rigid_points", other_names(motion, indices));
  return indices;
}

/// The rigid points that are measured both in one sample and in sample 0.
struct Pairs {
  Points reference, current;
  std::vector<int> rows;  ///< indices into the list of rigid points
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
  if (std::min(spread_off_line(pairs.reference), spread_off_line(pairs.current)) <
      kLeastSkullSpread)
    refuse(motion, fmt::format("at {:.4g} s the points that move with the skull lie on one line: "
                               "head pose cannot be determined from them",
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

/// The pose with the covariance estimated from the residuals, which assumes that the points move
/// independently.
UncertainPose with_covariance(const Pairs& pairs, const Eigen::VectorXd& weights,
                              const Eigen::Isometry3d& pose) {
  UncertainPose known;
  known.pose = pose;
  known.centre = pairs.reference.colwise().mean().transpose();
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  double sum = 0;
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    const auto arm = pose_derivative(pairs.reference.row(i).transpose() - known.centre);
    normal += weights(i) * arm.transpose() * arm;
    const Vec3 moved = pose * pairs.reference.row(i).transpose();
    sum += weights(i) * (moved - pairs.current.row(i).transpose()).squaredNorm();
  }
  const double free = 3 * double(weights.size()) - 6;
  known.covariance = sum / free * normal.inverse();
  return known;
}

/// Poses from given points by Kabsch's method; points with larger residuals have smaller weights.
std::vector<UncertainPose> poses_of_stated(const std::vector<Pairs>& pairs, std::size_t points,
                                           int reweightings) {
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(Eigen::Index(points));
  std::vector<Eigen::Isometry3d> poses(pairs.size());
  for (int round = 0;; ++round) {
    for (std::size_t k = 0; k < pairs.size(); ++k)
      poses[k] = fit_rigid(pairs[k].reference, pairs[k].current, weights_of(pairs[k], weights));
    if (round >= reweightings) break;
    weights = cauchy_weights(point_residuals(pairs, poses, weights.size()));
  }
  std::vector<UncertainPose> uncertain;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    uncertain.push_back(with_covariance(pairs[k], weights_of(pairs[k], weights), poses[k]));
  return uncertain;
}

/// With the part of the covariance that expressions cause widened. Jitter is measured.
Eigen::Matrix<double, 6, 6> widened(const UncertainPose& pose, double by) {
  return by * by * (pose.covariance - pose.of_jitter) + pose.of_jitter;
}

/// Moves all points into the frame of sample 0, and bounds how far an error of the pose may shift
/// them.
void take_out(const std::vector<UncertainPose>& poses, double widening, StabilisedMotion& result) {
  for (std::size_t k = 0; k < poses.size(); ++k) {
    UncertainPose at = poses[k];
    at.covariance = widened(at, widening);
    if (k == 0) at.covariance.setZero(), at.of_jitter.setZero();
    const Eigen::Isometry3d back = at.pose.inverse();
    Points& seen = result.motion.positions[k];
    seen = ((seen * back.linear().transpose()).rowwise() + back.translation().transpose()).eval();
    result.motion.head_pose.push_back(at.pose);
    result.poses.push_back(at);
    double variance = 0, count = 0;
    for (Eigen::Index p = 0; p < seen.rows(); ++p)
      if (seen.row(p).allFinite()) {
        const auto arm = pose_derivative(seen.row(p).transpose() - at.centre);
        variance += (arm * at.covariance * arm.transpose()).trace();
        ++count;
      }
    result.shift_uncertainty_m.push_back(kWithin95 * std::sqrt(variance / std::max(1.0, count)));
    result.turn_uncertainty_rad.push_back(kWithin95 *
                                          std::sqrt(at.covariance.topLeftCorner<3, 3>().trace()));
  }
}

}  // namespace

Eigen::Matrix<double, 3, 6> pose_derivative(const Vec3& arm) {
  Eigen::Matrix<double, 3, 6> d;
  d << 0, arm.z(), -arm.y(), 1, 0, 0,  //
      -arm.z(), 0, arm.x(), 0, 1, 0,   //
      arm.y(), -arm.x(), 0, 0, 0, 1;
  return d;
}

const std::vector<std::string>& default_rigid_points() {
  static const std::vector<std::string> names = {
      face::ibug(36),  face::ibug(39),   face::ibug(42),   face::ibug(45), face::ibug(27),
      face::ibug(28),  face::ibug(29),   face::ibug(0),    face::ibug(16), "exocanthion_R",
      "exocanthion_L", "endocanthion_R", "endocanthion_L", "nasion"};
  return names;
}

void check_pose_points(const Motion& motion, const std::vector<std::string>& rigid_points) {
  if (!motion.positions.empty()) rigid_indices(motion, rigid_points);
}

StabilisedMotion stabilise(const Motion& motion, const StabiliseOptions& options) {
  if (motion.positions.empty()) refuse(motion, "there are no samples");
  const std::vector<int> rigid = rigid_indices(motion, options.rigid_points);
  std::vector<Pairs> pairs;
  for (std::size_t k = 0; k < motion.positions.size(); ++k)
    pairs.push_back(pairs_at(motion, rigid, k));

  StabilisedMotion result;
  result.motion = motion;
  result.motion.head_pose.clear();
  result.motion.skull_points = options.rigid_points;
  std::vector<UncertainPose> poses;
  if (options.rigid_points.empty()) {
    const std::vector<KnownLandmark> landmarks = known_landmarks(motion);
    for (const KnownLandmark& landmark : landmarks)
      result.pose_points.push_back(motion.names[std::size_t(landmark.column)]);
    poses = expressive_poses(motion, landmarks);
  } else {
    result.pose_points = options.rigid_points;
    poses = poses_of_stated(pairs, rigid.size(), options.reweightings);
  }
  poses[0].pose.setIdentity();
  take_out(poses, options.rigid_points.empty() ? kBeyondPrior : 1, result);
  return result;
}

StabilisedMotion with_still_head(const Motion& motion) {
  StabilisedMotion result;
  result.motion = motion;
  const std::size_t samples = motion.positions.size();
  result.motion.head_pose.assign(samples, Eigen::Isometry3d::Identity());
  result.poses.assign(samples, {});
  result.shift_uncertainty_m.assign(samples, 0);
  result.turn_uncertainty_rad.assign(samples, 0);
  return result;
}

}  // namespace hyperex::motion
