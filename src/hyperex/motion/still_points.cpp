// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/still_points.hpp"

#include <algorithm>

#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/transform.hpp"
#include "hyperex/motion/stabilise.hpp"

namespace hyperex::motion {
namespace {

constexpr std::size_t kMostStillSamples = 200;
constexpr std::size_t kLeastStillPoints = 4;
constexpr double kLeastStillSpread = 0.02;  // the least that stabilise() accepts

std::vector<int> candidates(const Motion& motion) {
  std::vector<std::string> moves;
  for (int i = 4; i <= 12; ++i) moves.push_back(face::ibug(i));
  for (int i = 48; i <= 67; ++i) moves.push_back(face::ibug(i));
  std::vector<int> out;
  for (std::size_t p = 0; p < motion.names.size(); ++p)
    if (std::ranges::find(moves, motion.names[p]) == moves.end() &&
        std::ranges::all_of(motion.positions,
                            [&](const Points& at) { return at.row(Eigen::Index(p)).allFinite(); }))
      out.push_back(int(p));
  return out;
}

/// The largest change of the distance between each pair of `points`.
Eigen::MatrixXd distance_changes(const Motion& motion, const std::vector<int>& points) {
  const auto count = Eigen::Index(points.size());
  Eigen::MatrixXd most = Eigen::MatrixXd::Zero(count, count);
  const std::size_t step = std::max<std::size_t>(1, motion.positions.size() / kMostStillSamples);
  for (std::size_t k = 0; k < motion.positions.size(); k += step)
    for (Eigen::Index i = 0; i < count; ++i)
      for (Eigen::Index j = i + 1; j < count; ++j) {
        const int a = points[std::size_t(i)], b = points[std::size_t(j)];
        const auto distance = [&](const Points& at) { return (at.row(a) - at.row(b)).norm(); };
        const double change =
            std::abs(distance(motion.positions[k]) - distance(motion.positions.front()));
        most(i, j) = most(j, i) = std::max(most(i, j), change);
      }
  return most;
}

}  // namespace

std::vector<std::string> find_still_points(const Motion& motion) {
  if (motion.positions.size() < 2) return {};
  const std::vector<int> points = candidates(motion);
  const Eigen::MatrixXd change = distance_changes(motion, points);
  std::vector<Eigen::Index> best;
  for (Eigen::Index seed = 0; seed < change.rows(); ++seed) {
    std::vector<Eigen::Index> nearest(std::size_t(change.rows()));
    for (std::size_t i = 0; i < nearest.size(); ++i) nearest[i] = Eigen::Index(i);
    std::ranges::stable_sort(nearest, {}, [&](Eigen::Index i) { return change(seed, i); });
    std::vector<Eigen::Index> set;
    for (const Eigen::Index i : nearest)
      if (std::ranges::all_of(
              set, [&](Eigen::Index other) { return change(i, other) <= kStillPoints_m; }))
        set.push_back(i);
    if (set.size() > best.size()) best = set;
  }
  if (best.size() < kLeastStillPoints) return {};
  std::ranges::sort(best);
  std::vector<std::string> names;
  Points at(Eigen::Index(best.size()), 3);
  for (std::size_t i = 0; i < best.size(); ++i) {
    const int row = points[std::size_t(best[i])];
    names.push_back(motion.names[std::size_t(row)]);
    at.row(Eigen::Index(i)) = motion.positions.front().row(row);
  }
  return spread_off_line(at) < kLeastStillSpread ? std::vector<std::string>{} : names;
}

bool has_pose_points(const Motion& motion) {
  return std::ranges::count_if(default_rigid_points(), [&](const std::string& name) {
           return motion.index_of(name) >= 0;
         }) >= 3;
}

std::vector<std::string> proposed_rigid_points(const Motion& motion) {
  return has_pose_points(motion) ? std::vector<std::string>() : find_still_points(motion);
}

}  // namespace hyperex::motion
