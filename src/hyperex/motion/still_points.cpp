// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/still_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hyperex/core/quantile.hpp"
#include "hyperex/core/within_95.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/face/optional_landmarks.hpp"
#include "hyperex/face/same_place.hpp"
#include "hyperex/face/words_to_point.hpp"
#include "hyperex/geometry/transform.hpp"
#include "hyperex/motion/fill_gaps.hpp"
#include "hyperex/motion/jitter.hpp"
#include "hyperex/motion/measured_rows.hpp"
#include "hyperex/motion/rigid_set.hpp"
#include "hyperex/motion/try_stabilise.hpp"

namespace hyperex::motion {
namespace {

constexpr std::size_t kMostStillSamples = 200;
constexpr std::size_t kLeastStillPoints = 4;
constexpr double kLeastStillSpread = 0.02;  // the least that stabilise() accepts

// Beside the landmarks of the face, which give a pose already.
/// What a band gives, beyond jitter.
constexpr double kBandGives_m = 0.2e-3;
/// A smaller set turns the head by its own jitter.
constexpr double kLeastStillSize_m = 0.05;
/// A face that moves less does not show which of its points are still.
constexpr double kFaceMoves_m = 3e-3;
/// Of many points a few keep still by chance: measured, up to three of 39 on a smile.
constexpr std::size_t kMoreThanChance = 6;

/// Which points may be still, by their names.
using MayBeStill = bool (*)(const std::string& name);

bool is_not_of_the_mouth(const std::string& name) {
  return !face::moves_with_mouth(name);
}

/// The points that may be still, with gaps of at most `most_gap_s`.
std::vector<int> candidates(const Motion& motion, MayBeStill may_be_still, double most_gap_s) {
  std::vector<int> rows;
  for (std::size_t p = 0; p < motion.names.size(); ++p)
    if (may_be_still(motion.names[p])) rows.push_back(int(p));
  return hardly_interrupted(motion, rows, most_gap_s);
}

/// The one of `rows` whose point is called `name`, else the one at the same place; -1: none.
int row_of(const Motion& motion, const std::vector<int>& rows, const std::string& name) {
  const auto called = [&](int row) -> const std::string& { return motion.names[std::size_t(row)]; };
  auto found = std::ranges::find(rows, name, called);
  if (found == rows.end())
    found = std::ranges::find(rows, face::place_name(name),
                              [&](int row) { return face::place_name(called(row)); });
  return found == rows.end() ? -1 : *found;
}

/// Points that all motions have.
struct CommonPoints {
  std::vector<std::string> names;      ///< in the first motion
  std::vector<std::vector<int>> rows;  ///< of each motion, in the order of the names
};

CommonPoints common_points(const std::vector<const Motion*>& motions, MayBeStill may_be_still,
                           double most_gap_s) {
  std::vector<std::vector<int>> of_each;
  for (const Motion* motion : motions)
    of_each.push_back(candidates(*motion, may_be_still, most_gap_s));
  CommonPoints common{{}, std::vector<std::vector<int>>(motions.size())};
  for (const int first : of_each.front()) {
    const std::string& name = motions.front()->names[std::size_t(first)];
    std::vector<int> rows;
    for (std::size_t i = 0; i < motions.size(); ++i) {
      const int row = row_of(*motions[i], of_each[i], name);
      // Two names of one place in one recording may meet a single one in another.
      if (row >= 0 && std::ranges::find(common.rows[i], row) == common.rows[i].end())
        rows.push_back(row);
    }
    if (rows.size() < motions.size()) continue;
    common.names.push_back(name);
    for (std::size_t i = 0; i < motions.size(); ++i) common.rows[i].push_back(rows[i]);
  }
  return common;
}

/// The points at evenly spaced samples, each coordinate the median of at most five samples about
/// it; NaN where none of these is measured.
std::vector<Points> smoothed_samples(const Motion& motion, const std::vector<int>& points) {
  const std::size_t count = motion.positions.size();
  const std::size_t beside = std::min<std::size_t>(2, (count - 1) / 4);
  const std::size_t step = std::max<std::size_t>(1, count / kMostStillSamples);
  std::vector<Points> out;
  for (std::size_t k = 0; k < count; k += step) {
    const std::size_t first = std::min(k - std::min(k, beside), count - 1 - 2 * beside);
    Points at(Eigen::Index(points.size()), 3);
    for (std::size_t p = 0; p < points.size(); ++p)
      for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> seen;
        for (std::size_t j = first; j <= first + 2 * beside; ++j)
          if (const double x = motion.positions[j](points[p], axis); std::isfinite(x))
            seen.push_back(x);
        at(Eigen::Index(p), axis) =
            seen.empty() ? std::numeric_limits<double>::quiet_NaN() : median(std::move(seen));
      }
    out.push_back(std::move(at));
  }
  return out;
}

/// How far the distance between each pair of points changes in 95 % of the samples; 0 where the two
/// are never measured together.
Eigen::MatrixXd usual_changes(const std::vector<Points>& samples) {
  constexpr double share = 0.95;
  const Eigen::Index count = samples.front().rows();
  Eigen::MatrixXd changes = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = i + 1; j < count; ++j) {
      std::vector<double> distances;
      for (const Points& at : samples)
        if (const double d = (at.row(i) - at.row(j)).norm(); std::isfinite(d))
          distances.push_back(d);
      if (distances.empty()) continue;
      const double first = distances.front();
      for (double& d : distances) d = std::abs(d - first);
      std::ranges::sort(distances);
      changes(i, j) = changes(j, i) = quantile_of_sorted(distances, share);
    }
  return changes;
}

/// The one of `points` with most changes above `allowed_m`, of several the one whose changes are
/// larger in sum; -1 where no change is above it.
Eigen::Index most_unsteady(const Eigen::MatrixXd& changes, const std::vector<Eigen::Index>& points,
                           double allowed_m) {
  std::pair<int, double> most{0, 0};
  Eigen::Index worst = -1;
  for (const Eigen::Index i : points) {
    std::pair<int, double> of_point{0, 0};
    for (const Eigen::Index j : points) {
      if (changes(i, j) > allowed_m) ++of_point.first;
      of_point.second += changes(i, j);
    }
    if (of_point.first > 0 && of_point > most) {
      most = of_point;
      worst = i;
    }
  }
  return worst;
}

/// The first sample in which all `rows` are measured; there must be one.
const Points& first_whole(const Motion& motion, const std::vector<int>& rows) {
  return motion.positions[samples_with_all(motion, rows).front()];
}

bool lie_near_a_line(const Motion& motion, const std::vector<int>& rows) {
  const Points at = first_whole(motion, rows)(rows, Eigen::all);
  return spread_off_line(at) < kLeastStillSpread;
}

bool names_a_landmark(const std::string& name) {
  return face::is_known_landmark(face::full_name(name)) || !face::name_of_words(name).empty();
}

/// Names that are not those of landmarks, nor words for one.
bool is_beside_landmarks(const std::string& name) {
  return is_not_of_the_mouth(name) && !names_a_landmark(name);
}

/// Points of all motions that keep still against each other in each.
struct CommonStill {
  StillPoints points;
  std::vector<std::vector<int>> rows;  ///< of the points, in each motion
  std::size_t of = 0;                  ///< among so many common points
};

/// The largest such set of the common points, of any size. Landmarks that move are not named: they
/// are expected to.
CommonStill still_among(const std::vector<const Motion*>& motions, const CommonPoints& common,
                        double give_m) {
  std::vector<TrackedPoints> tracked;
  for (std::size_t i = 0; i < motions.size(); ++i)
    tracked.push_back(tracked_points(*motions[i], common.rows[i]));
  const RigidSet set = largest_rigid_set(tracked, give_m);
  CommonStill out{{}, std::vector<std::vector<int>>(motions.size()), common.names.size()};
  for (const Eigen::Index p : set.points) {
    out.points.names.push_back(common.names[std::size_t(p)]);
    for (std::size_t i = 0; i < motions.size(); ++i)
      out.rows[i].push_back(common.rows[i][std::size_t(p)]);
  }
  for (const Eigen::Index p : set.left_out)
    if (const std::string& name = common.names[std::size_t(p)]; !names_a_landmark(name))
      out.points.left_out.push_back({name, set.moves_m[std::size_t(p)]});
  return out;
}

/// How many of `count` points must keep still.
std::size_t enough_of(std::size_t count) {
  return count == 3 ? 3 : std::clamp((count + 1) / 2, kLeastStillPoints, kMoreThanChance);
}

double greatest_distance(const Points& at, const std::vector<int>& rows) {
  double most = 0;
  for (const int a : rows)
    for (const int b : rows) most = std::max(most, (at.row(a) - at.row(b)).norm());
  return most;
}

/// Whether some point of a motion without head pose moves as an expression makes it.
bool face_moves(const Motion& motion) {
  return std::ranges::any_of(motion.positions, [&](const Points& at) {
    return ((at - motion.positions.front()).rowwise().norm().array() > kFaceMoves_m).any();
  });
}

/// Whether these points move with the skull by the landmarks of the face, too, which those of the
/// lower teeth do not: at 95 % of the samples their displacement (root mean square) is within what
/// an error of the landmarks' pose and the points' jitter in both samples make there (95 %), and
/// kStillPoints_m. Displacements count from the first sample with all points.
bool stay_by_landmarks(const StabilisedMotion& steady, const std::vector<int>& rows) {
  const double jitter_m = jitter_of_motion(steady.motion, rows);
  const double of_jitter = std::isnan(jitter_m) ? 0 : 6 * jitter_m * jitter_m;
  const std::vector<std::size_t> samples = samples_with_all(steady.motion, rows);
  const Points& first = steady.motion.positions[samples.front()];
  const Eigen::Matrix<double, 6, 6>& of_first = steady.poses[samples.front()].covariance;
  std::size_t off = 0;
  for (const std::size_t k : samples) {
    const UncertainPose& pose = steady.poses[k];
    double moved = 0, variance = 0;
    for (const int row : rows) {
      const Vec3 at = steady.motion.positions[k].row(row).transpose();
      moved += (at.transpose() - first.row(row)).squaredNorm();
      const auto arm = pose_derivative(at - pose.centre);
      variance += (arm * (pose.covariance + of_first) * arm.transpose()).trace();
    }
    const auto count = double(rows.size());
    if (std::sqrt(moved / count) >
        kWithin95 * std::sqrt(variance / count + of_jitter) + kStillPoints_m)
      ++off;
  }
  return 20 * off <= samples.size();
}

bool all_have_samples(const std::vector<const Motion*>& motions) {
  return !motions.empty() &&
         std::ranges::all_of(motions, [](const Motion* m) { return m->positions.size() >= 2; });
}

bool all_have_pose_points(const std::vector<const Motion*>& motions) {
  return std::ranges::all_of(motions, [](const Motion* m) { return has_pose_points(*m); });
}

bool any_near_a_line(const std::vector<const Motion*>& motions, const CommonStill& still) {
  for (std::size_t i = 0; i < motions.size(); ++i)
    if (lie_near_a_line(*motions[i], still.rows[i])) return true;
  return false;
}

/// What makes some still points the ones that are sought.
using AreSought = bool (*)(const std::vector<const Motion*>& motions, const CommonStill& still);

bool give_poses_in_gaps(const std::vector<const Motion*>& motions, const CommonStill& still) {
  for (std::size_t i = 0; i < motions.size(); ++i)
    if (!give_pose_in_gaps(*motions[i], still.rows[i], kLeastStillSpread)) return false;
  return true;
}

/// Those of all points that may be still; none where they are not sought. Short gaps, which a run
/// fills, cost no point as long as the others give the pose there. Where points with gaps make the
/// difference, those without are judged alone.
CommonStill sought_among(const std::vector<const Motion*>& motions, MayBeStill may_be_still,
                         double give_m, AreSought are_sought) {
  if (!all_have_samples(motions)) return {};
  const CommonPoints hardly = common_points(motions, may_be_still, GapOptions().max_gap_s),
                     whole = common_points(motions, may_be_still, 0);
  CommonStill still = still_among(motions, hardly, give_m);
  if (are_sought(motions, still) && give_poses_in_gaps(motions, still)) return still;
  if (whole.rows == hardly.rows) return {};
  still = still_among(motions, whole, give_m);
  return are_sought(motions, still) ? still : CommonStill();
}

bool are_enough_for_a_pose(const std::vector<const Motion*>& motions, const CommonStill& still) {
  return still.points.names.size() >= kLeastStillPoints && !any_near_a_line(motions, still);
}

bool are_many_and_far_apart(const std::vector<const Motion*>& motions, const CommonStill& still) {
  return still.of >= 3 && still.points.names.size() >= enough_of(still.of) &&
         !any_near_a_line(motions, still) &&
         greatest_distance(first_whole(*motions.front(), still.rows.front()), still.rows.front()) >=
             kLeastStillSize_m;
}

/// find_still_points() with the points that move.
StillPoints still_without_landmarks(const std::vector<const Motion*>& motions) {
  return sought_among(motions, is_not_of_the_mouth, kStillPoints_m, are_enough_for_a_pose).points;
}

/// Candidates beside the landmarks that are still, many and far apart; else none.
CommonStill still_beside_landmarks(const std::vector<const Motion*>& motions) {
  return sought_among(motions, is_beside_landmarks, kBandGives_m, are_many_and_far_apart);
}

}  // namespace

std::vector<std::string> find_still_points(const Motion& motion) {
  return find_still_points(std::vector{&motion});
}

std::vector<std::string> find_still_points(const std::vector<const Motion*>& motions) {
  return still_without_landmarks(motions).names;
}

std::vector<std::string> own_names(const Motion& motion, const std::vector<std::string>& points) {
  std::vector<int> rows;
  for (int row = 0; row < int(motion.names.size()); ++row) rows.push_back(row);
  std::vector<std::string> names;
  for (const std::string& point : points) {
    const int row = row_of(motion, rows, point);
    names.push_back(row >= 0 ? motion.names[std::size_t(row)] : point);
  }
  return names;
}

std::vector<UnsteadyPoint> unsteady_points(const Motion& motion,
                                           const std::vector<std::string>& names,
                                           double allowed_m) {
  std::vector<int> rows;
  for (const std::string& name : names)
    if (const int row = motion.index_of(name); row >= 0) rows.push_back(row);
  if (motion.positions.empty() || rows.empty()) return {};
  const Eigen::MatrixXd changes = usual_changes(smoothed_samples(motion, rows));
  std::vector<Eigen::Index> steady;
  for (Eigen::Index i = 0; i < changes.rows(); ++i) steady.push_back(i);
  for (Eigen::Index i; (i = most_unsteady(changes, steady, allowed_m)) >= 0;) std::erase(steady, i);
  if (steady.size() < 2) steady.clear();
  std::vector<UnsteadyPoint> out;
  for (Eigen::Index i = 0; i < changes.rows(); ++i)
    if (const double most = changes.row(i).maxCoeff();
        most > allowed_m && std::ranges::find(steady, i) == steady.end())
      out.push_back({motion.names[std::size_t(rows[std::size_t(i)])], most});
  return out;
}

bool has_pose_points(const Motion& motion) {
  return std::ranges::count_if(default_rigid_points(), [&](const std::string& name) {
           return motion.index_of(name) >= 0;
         }) >= 3;
}

std::vector<std::string> proposed_rigid_points(const Motion& motion) {
  return proposed_rigid_points(std::vector{&motion});
}

std::vector<std::string> proposed_rigid_points(const std::vector<const Motion*>& motions) {
  return all_have_pose_points(motions) ? std::vector<std::string>() : find_still_points(motions);
}

std::vector<std::string> still_points_beside_landmarks(const StabilisedMotion& steady) {
  const Motion& motion = steady.motion;
  if (motion.positions.size() < 2 || steady.poses.size() != motion.positions.size() ||
      !motion.skull_points.empty())
    return {};
  CommonStill still = still_beside_landmarks({&motion});
  if (still.points.names.empty() || !face_moves(motion) ||
      !stay_by_landmarks(steady, still.rows.front()))
    return {};
  return std::move(still.points.names);
}

StillPoints points_to_hold_the_head(const std::vector<const Motion*>& motions) {
  if (!all_have_pose_points(motions)) return still_without_landmarks(motions);
  CommonStill still = still_beside_landmarks(motions);
  if (still.points.names.empty()) return {};
  StillPoints none;
  bool moves = false;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    StabilisedMotion steady = try_stabilise(*motions[i], {}, "rigid_points").steady;
    if (steady.poses.empty()) return none;
    none.by_landmarks.push_back(std::move(steady));
    if (!stay_by_landmarks(none.by_landmarks.back(), still.rows[i])) return none;
    moves = moves || face_moves(none.by_landmarks.back().motion);
  }
  if (!moves) return none;
  still.points.beside_landmarks = true;
  return std::move(still.points);
}

StillPoints points_to_hold_the_head(const Motion& motion) {
  return points_to_hold_the_head(std::vector{&motion});
}

}  // namespace hyperex::motion
