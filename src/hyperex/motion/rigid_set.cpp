// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/rigid_set.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hyperex/core/quantile.hpp"
#include "hyperex/geometry/transform.hpp"
#include "hyperex/motion/jitter.hpp"
#include "hyperex/motion/uncertain_pose.hpp"

namespace hyperex::motion {
namespace {

using Indices = std::vector<Eigen::Index>;

constexpr std::size_t kMostRigidSamples = 400;
constexpr double kShortestMean_s = 0.2;
constexpr std::size_t kFewestInMean = 5;
/// A normal variable is above this once in a thousand draws.
constexpr double kRare = 3.0;
/// The relative standard deviation of an estimated jitter is this over the root of the number of
/// samples: measured beyond the bias of a median of few.
constexpr double kJitterSpread = 0.3;
/// A direction in which the pose takes up more than this of a point's own movement shows nothing.
constexpr double kLeastShown = 0.15;
/// Readings farther from the median of five than this, and six times the jitter, are replaced.
constexpr double kOffNeighbours_m = 0.5e-3;

/// The point of chi-square that a draw in a thousand exceeds, divided by the degrees of freedom
/// (Wilson and Hilferty, PNAS 17 (1931) 684).
double rare_chi_square(double freedom) {
  const double variance = 2 / (9 * freedom);
  return std::pow(1 - variance + kRare * std::sqrt(variance), 3);
}

/// Readings that alone are off the samples beside them are replaced by the median of five.
void replace_lone_readings(TrackedPoints& points) {
  const std::vector<Points> seen = points.positions;
  for (std::size_t k = 2; k + 2 < seen.size(); ++k)
    for (Eigen::Index p = 0; p < seen[k].rows(); ++p)
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        std::vector<double> near;
        for (std::size_t j = k - 2; j <= k + 2; ++j) near.push_back(seen[j](p, axis));
        const double middle = median(std::move(near));
        const double most = kOffNeighbours_m + 6 * points.jitter_m[std::size_t(p)];
        if (std::abs(seen[k](p, axis) - middle) > most) points.positions[k](p, axis) = middle;
      }
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
  return jitter_m;
}

/// Means over `width` samples about each; at the ends the window lies within.
Eigen::MatrixXd window_means(const Eigen::MatrixXd& values, std::size_t width) {
  const auto count = std::size_t(values.rows());
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(values.rows() + 1, values.cols());
  for (Eigen::Index k = 0; k < values.rows(); ++k) sums.row(k + 1) = sums.row(k) + values.row(k);
  Eigen::MatrixXd means(values.rows(), values.cols());
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t first = std::min(k - std::min(k, width / 2), count - width);
    means.row(Eigen::Index(k)) =
        (sums.row(Eigen::Index(first + width)) - sums.row(Eigen::Index(first))) / double(width);
  }
  return means;
}

Points some_rows(const Points& all, const Indices& rows) {
  Points some(Eigen::Index(rows.size()), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) some.row(Eigen::Index(i)) = all.row(rows[i]);
  return some;
}

/// The points of every sample less the mean shape, in its frame, where the pose is that of `set`.
struct RigidResiduals {
  Points shape;
  std::vector<Points> off;
};

RigidResiduals rigid_residuals(const TrackedPoints& points, const Indices& set) {
  RigidResiduals out{points.positions.front(), points.positions};
  constexpr int rounds = 3;
  for (int round = 0; round < rounds; ++round) {
    const Points held = some_rows(out.shape, set);
    Points sum = Points::Zero(out.shape.rows(), 3);
    for (std::size_t k = 0; k < points.positions.size(); ++k) {
      const Points& at = points.positions[k];
      const Eigen::Isometry3d back = fit_rigid(some_rows(at, set), held);
      out.off[k] =
          ((at * back.linear().transpose()).rowwise() + back.translation().transpose()) - out.shape;
      sum += out.off[k];
    }
    if (round + 1 < rounds) out.shape += sum / double(points.positions.size());
  }
  return out;
}

/// How a point's own displacement follows from its residual, and its covariance by jitter.
struct OwnDisplacement {
  Eigen::MatrixXd of_residual;  ///< 3 x m: m directions in which it shows
  Eigen::MatrixXd covariance;   ///< m x m, square metres, of one sample
};

/// Of all points. Those of the set carry the pose, too, and a residual shows a part of what they
/// do.
std::vector<OwnDisplacement> own_displacements(const Points& shape,
                                               const std::vector<double>& jitter_m,
                                               const Indices& set) {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  const Eigen::RowVector3d centre = some_rows(shape, set).colwise().mean();
  std::vector<Eigen::Matrix<double, 3, 6>> arms;
  for (Eigen::Index p = 0; p < shape.rows(); ++p)
    arms.push_back(pose_derivative((shape.row(p) - centre).transpose()));
  Matrix6 normal = Matrix6::Zero(), noise = Matrix6::Zero();
  for (const Eigen::Index p : set) {
    const Matrix6 own = arms[std::size_t(p)].transpose() * arms[std::size_t(p)];
    normal += own;
    noise += std::pow(jitter_m[std::size_t(p)], 2) * own;
  }
  const Matrix6 inverse = normal.completeOrthogonalDecomposition().pseudoInverse();
  const Matrix6 of_pose = inverse * noise * inverse;
  std::vector<OwnDisplacement> out;
  for (std::size_t p = 0; p < arms.size(); ++p) {
    const double variance = jitter_m[p] * jitter_m[p];
    const Eigen::Matrix3d pose = arms[p] * of_pose * arms[p].transpose(),
                          identity = Eigen::Matrix3d::Identity();
    if (!std::ranges::binary_search(set, Eigen::Index(p))) {
      out.push_back({identity, variance * identity + pose});
      continue;
    }
    const Eigen::Matrix3d taken_up = arms[p] * inverse * arms[p].transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> shown(identity - taken_up);
    Eigen::MatrixXd directions(3, 0);
    for (Eigen::Index i = 0; i < 3; ++i)
      if (shown.eigenvalues()[i] > kLeastShown) {
        directions.conservativeResize(3, directions.cols() + 1);
        directions.rightCols<1>() = shown.eigenvectors().col(i) / shown.eigenvalues()[i];
      }
    const Eigen::Matrix3d residual = variance * (identity - 2 * taken_up) + pose;
    out.push_back({directions, directions.transpose() * residual * directions});
  }
  return out;
}

/// How a point moves against a set.
struct Against {
  double share = 0;    ///< of what give and jitter allow; above 1: it moves
  double moves_m = 0;  ///< farthest from the first sample, in means of the shortest window
};

Against against_set(const Eigen::MatrixXd& displacement, const Eigen::MatrixXd& covariance,
                    std::size_t shortest, double give_m) {
  Against out;
  if (displacement.cols() == 0) return out;
  const auto count = std::size_t(displacement.rows());
  const double widened = std::pow(1 + kRare * kJitterSpread / std::sqrt(double(count)), 2);
  const double total = widened * covariance.trace();
  const double largest =
      widened * Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(covariance).eigenvalues().maxCoeff();
  for (std::size_t width = shortest; width == shortest || width <= count / 4;
       width = 2 * width + 1) {
    Eigen::MatrixXd means = window_means(displacement, width);
    if (width == shortest)
      out.moves_m = (means.rowwise() - means.row(0)).rowwise().norm().maxCoeff();
    means.rowwise() -= means.colwise().mean().eval();
    const auto in_mean = double(width);
    const double windows = std::max(1.0, double(count) / in_mean);
    const double freedom = std::max(1.0, windows - 1) * (largest > 0 ? total / largest : 1.0);
    const double rms_m = std::sqrt(means.rowwise().squaredNorm().mean()),
                 most_m = means.rowwise().norm().maxCoeff();
    const double rms_allowed_m =
        std::hypot(give_m / 4, std::sqrt(rare_chi_square(freedom) * total / in_mean));
    const double most_allowed_m =
        give_m / 2 + std::sqrt(std::max(0.0, largest) / in_mean *
                               (3 * rare_chi_square(3) + 2 * std::log(windows)));
    out.share = std::max({out.share, rms_m / rms_allowed_m, most_m / most_allowed_m});
  }
  return out;
}

/// All points against a set of three or more: the greatest share and movement of the recordings.
std::vector<Against> all_against(const std::vector<TrackedPoints>& recordings, const Indices& set,
                                 double give_m) {
  std::vector<Against> out(recordings.front().jitter_m.size());
  for (const TrackedPoints& points : recordings) {
    const RigidResiduals residuals = rigid_residuals(points, set);
    const auto own = own_displacements(residuals.shape, points.jitter_m, set);
    for (std::size_t p = 0; p < out.size(); ++p) {
      Eigen::MatrixXd off(Eigen::Index(residuals.off.size()), 3);
      for (std::size_t k = 0; k < residuals.off.size(); ++k)
        off.row(Eigen::Index(k)) = residuals.off[k].row(Eigen::Index(p));
      const Against here =
          against_set(off * own[p].of_residual, own[p].covariance, points.shortest, give_m);
      out[p].share = std::max(out[p].share, here.share);
      out[p].moves_m = std::max(out[p].moves_m, here.moves_m);
    }
  }
  return out;
}

/// How much the distance of each pair changes, as a share of what give and jitter allow.
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
  const Indices columns(rows.begin(), rows.end());
  const std::size_t count = motion.positions.size(),
                    step = std::max<std::size_t>(1, count / kMostRigidSamples);
  for (std::size_t k = 0; k < count; k += step)
    out.positions.push_back(some_rows(motion.positions[k], columns));
  replace_lone_readings(out);
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
    const Eigen::Index worst = *std::ranges::max_element(set, {}, share);
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
    set.insert(std::ranges::upper_bound(set, *std::ranges::min_element(wanted, {}, share)),
               *std::ranges::min_element(wanted, {}, share));
  }
  return out;
}

}  // namespace hyperex::motion
