// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/rigid_set.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hyperex/core/quantile.hpp"
#include "hyperex/motion/against_set.hpp"
#include "hyperex/motion/jitter.hpp"
#include "hyperex/motion/measured_rows.hpp"

namespace hyperex::motion {
namespace {

using Indices = std::vector<Eigen::Index>;

constexpr std::size_t kMostRigidSamples = 400;
constexpr double kShortestMean_s = 0.2;
constexpr std::size_t kFewestInMean = 5;
/// A reading farther from its neighbours than this, and six times the jitter, is off them.
constexpr double kOffNeighbours_m = 0.5e-3;
/// With fewer samples jitter and motion cannot be separated, and the estimated jitter is limited.
constexpr std::size_t kFewSamples = 20;
constexpr double kMostJitterOfFew_m = 0.1e-3;

/// A coordinate in sample `k`. Where this reading alone is off the two on each side, it is the
/// median of the five. It is off if it is farther than `most_m` from that median and from the cubic
/// through the four, which a head that turns quickly follows. Beside a gap it stays.
double without_lone_reading(const Motion& motion, std::size_t k, int row, Eigen::Index axis,
                            double most_m) {
  const auto at = [&](std::size_t j) { return motion.positions[j](row, axis); };
  if (k < 2 || k + 2 >= motion.positions.size()) return at(k);
  if (!std::isfinite(at(k - 2) + at(k - 1) + at(k + 1) + at(k + 2))) return at(k);
  const double middle = median({at(k - 2), at(k - 1), at(k), at(k + 1), at(k + 2)});
  const double between = (4 * (at(k - 1) + at(k + 1)) - at(k - 2) - at(k + 2)) / 6;
  const bool off = std::abs(at(k) - middle) > most_m && std::abs(at(k) - between) > most_m;
  return off ? middle : at(k);
}

/// The points `rows` in sample `k`.
Points points_of_sample(const Motion& motion, std::size_t k, const std::vector<int>& rows,
                        const std::vector<double>& jitter_m) {
  Points at(Eigen::Index(rows.size()), 3);
  for (std::size_t p = 0; p < rows.size(); ++p)
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      at(Eigen::Index(p), axis) =
          without_lone_reading(motion, k, rows[p], axis, kOffNeighbours_m + 6 * jitter_m[p]);
  return at;
}

std::vector<double> jitter_of_each(const Motion& motion, const std::vector<int>& rows) {
  std::vector<double> jitter_m;
  for (const int row : rows) {
    const double own_m = jitter_of_motion(motion, {row});
    jitter_m.push_back(std::isnan(own_m) ? jitter_of_differences(motion, {row}) : own_m);
  }
  if (jitter_m.empty()) return jitter_m;
  const double usual_m = median(jitter_m);
  for (double& own_m : jitter_m) own_m = std::max(own_m, usual_m);
  if (motion.positions.size() < kFewSamples)
    for (double& own_m : jitter_m) own_m = std::min(own_m, kMostJitterOfFew_m);
  return jitter_m;
}

/// The change of the distance of each pair, divided by the bound of give and jitter.
Eigen::MatrixXd distance_shares(const std::vector<TrackedPoints>& recordings, double give_m) {
  const auto count = Eigen::Index(recordings.front().jitter_m.size());
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(count, count);
  for (const TrackedPoints& points : recordings) {
    const double in_mean = double(points.shortest);
    const double rare =
        rare_chi_square(1) + 2 * std::log(double(points.positions.size()) / in_mean);
    for (Eigen::Index i = 0; i < count; ++i)
      for (Eigen::Index j = i + 1; j < count; ++j) {
        Eigen::MatrixXd distance(Eigen::Index(points.positions.size()), 1);
        for (std::size_t k = 0; k < points.positions.size(); ++k)
          distance(Eigen::Index(k), 0) =
              (points.positions[k].row(i) - points.positions[k].row(j)).norm();
        const Eigen::MatrixXd means = window_means(distance, points.shortest);
        const double jitter_m =
            std::hypot(points.jitter_m[std::size_t(i)], points.jitter_m[std::size_t(j)]);
        const double share = (means.array() - means.mean()).abs().maxCoeff() /
                             (give_m / 2 + jitter_m * std::sqrt(rare / in_mean));
        shares(i, j) = shares(j, i) = std::max(shares(i, j), share);
      }
  }
  return shares;
}

/// The largest set found in which no share is above 1, in rising order; of several the one with the
/// least sum. A set is grown from each point in turn.
Indices largest_by_distances(const Eigen::MatrixXd& shares) {
  Indices best;
  double best_sum = 0;
  for (Eigen::Index seed = 0; seed < shares.rows(); ++seed) {
    Indices nearest;
    for (Eigen::Index i = 0; i < shares.rows(); ++i) nearest.push_back(i);
    std::ranges::stable_sort(nearest, {}, [&](Eigen::Index i) { return shares(seed, i); });
    Indices set;
    for (const Eigen::Index i : nearest)
      if (std::ranges::all_of(set, [&](Eigen::Index other) { return shares(i, other) <= 1; }))
        set.push_back(i);
    double sum = 0;
    for (const Eigen::Index i : set)
      for (const Eigen::Index j : set) sum += shares(i, j);
    if (set.size() > best.size() || (set.size() == best.size() && sum < best_sum)) {
      best = set;
      best_sum = sum;
    }
  }
  std::ranges::sort(best);
  return best;
}

}  // namespace

TrackedPoints tracked_points(const Motion& motion, const std::vector<int>& rows) {
  TrackedPoints out;
  out.jitter_m = jitter_of_each(motion, rows);
  const std::vector<std::size_t> samples = samples_with_all(motion, rows);
  const std::size_t count = samples.size(),
                    step = std::max<std::size_t>(1, count / kMostRigidSamples);
  for (std::size_t i = 0; i < count; i += step)
    out.positions.push_back(points_of_sample(motion, samples[i], rows, out.jitter_m));
  const double sample_s = double(step) * (motion.time_s.back() - motion.time_s.front()) /
                          double(std::max<std::size_t>(1, count - 1));
  const std::size_t wanted = std::max(kFewestInMean, std::size_t(kShortestMean_s / sample_s));
  out.shortest = std::max<std::size_t>(1, std::min(wanted, out.positions.size() / 4));
  if (out.shortest % 2 == 0) --out.shortest;
  return out;
}

RigidSet largest_rigid_set(const std::vector<TrackedPoints>& recordings, double give_m) {
  constexpr std::size_t fewest = 3;
  RigidSet out;
  if (recordings.empty() || recordings.front().jitter_m.empty()) return out;
  Indices& set = out.points;
  set = largest_by_distances(distance_shares(recordings, give_m));
  out.moves_m.assign(recordings.front().jitter_m.size(), 0);
  std::vector<bool> dropped(out.moves_m.size(), false);
  while (set.size() >= fewest) {
    const std::vector<Against> all = all_against(recordings, set, give_m);
    const auto share = [&](Eigen::Index p) { return all[std::size_t(p)].share; };
    // A point that moves takes the others' poses along: it is the one without which most is gone.
    const Eigen::Index worst = *std::ranges::max_element(
        set, {}, [&](Eigen::Index p) { return share(p) > 1 ? all[std::size_t(p)].relief_m2 : -1; });
    if (share(worst) > 1) {
      dropped[std::size_t(worst)] = true;
      std::erase(set, worst);
      continue;
    }
    out.left_out.clear();
    Indices wanted;
    for (Eigen::Index p = 0; p < Eigen::Index(all.size()); ++p) {
      out.moves_m[std::size_t(p)] = all[std::size_t(p)].moves_m;
      if (std::ranges::binary_search(set, p)) continue;
      if (share(p) <= 1 && !dropped[std::size_t(p)]) wanted.push_back(p);
      if (share(p) > 1 || dropped[std::size_t(p)]) out.left_out.push_back(p);
    }
    if (wanted.empty()) break;
    const Eigen::Index stillest = *std::ranges::min_element(wanted, {}, share);
    set.insert(std::ranges::upper_bound(set, stillest), stillest);
  }
  return out;
}

}  // namespace hyperex::motion
