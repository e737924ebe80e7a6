// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/against_set.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/geometry/transform.hpp"
#include "hyperex/motion/uncertain_pose.hpp"

namespace hyperex::motion {
namespace {

using Rows = std::vector<Eigen::Index>;

/// A normal variable is above this once in a thousand draws.
constexpr double kRare = 3.0;
/// The relative standard deviation of an estimated jitter is this over the root of the number of
/// samples: measured beyond the bias of a median of few.
constexpr double kJitterSpread = 0.3;
/// A direction in which the pose takes up more than this of a point's own movement shows nothing.
constexpr double kLeastShown = 0.15;
/// The points of every sample less the mean shape, in its frame, where the pose is that of `set`.
struct RigidResiduals {
  Points shape;
  std::vector<Points> off;
};

RigidResiduals rigid_residuals(const TrackedPoints& points, const Rows& set) {
  RigidResiduals out{points.positions.front(), points.positions};
  constexpr int rounds = 3;
  for (int round = 0; round < rounds; ++round) {
    const Points held = out.shape(set, Eigen::all);
    Points sum = Points::Zero(out.shape.rows(), 3);
    for (std::size_t k = 0; k < points.positions.size(); ++k) {
      const Points& at = points.positions[k];
      const Eigen::Isometry3d back = fit_rigid(at(set, Eigen::all), held);
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
  Eigen::VectorXd shown;        ///< m: the share of it that the residual shows there
  Eigen::MatrixXd covariance;   ///< m x m, square metres, of one sample
};

/// Computed for all points. Points of the set also determine the pose, so that their residuals show
/// only a part of their own displacement.
std::vector<OwnDisplacement> own_displacements(const Points& shape,
                                               const std::vector<double>& jitter_m,
                                               const Rows& set) {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  const Eigen::RowVector3d centre = shape(set, Eigen::all).colwise().mean();
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
      out.push_back({identity, Vec3::Ones(), variance * identity + pose});
      continue;
    }
    const Eigen::Matrix3d taken_up = arms[p] * inverse * arms[p].transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> shown(identity - taken_up);
    Eigen::MatrixXd directions(3, 0);
    Eigen::VectorXd shares(0);
    for (Eigen::Index i = 0; i < 3; ++i)
      if (shown.eigenvalues()[i] > kLeastShown) {
        directions.conservativeResize(3, directions.cols() + 1);
        directions.rightCols<1>() = shown.eigenvectors().col(i) / shown.eigenvalues()[i];
        shares.conservativeResize(directions.cols());
        shares[directions.cols() - 1] = shown.eigenvalues()[i];
      }
    const Eigen::Matrix3d residual = variance * (identity - 2 * taken_up) + pose;
    out.push_back({directions, shares, directions.transpose() * residual * directions});
  }
  return out;
}

Against against_set(const Eigen::MatrixXd& displacement, const OwnDisplacement& own,
                    std::size_t shortest, double give_m) {
  Against out;
  if (displacement.cols() == 0) return out;
  const auto count = std::size_t(displacement.rows());
  const double widened = std::pow(1 + kRare * kJitterSpread / std::sqrt(double(count)), 2);
  const double total = widened * own.covariance.trace();
  const double largest =
      widened *
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(own.covariance).eigenvalues().maxCoeff();
  for (std::size_t width = shortest; width == shortest || width <= count / 4;
       width = 2 * width + 1) {
    Eigen::MatrixXd means = window_means(displacement, width);
    if (width == shortest)
      out.moves_m = (means.rowwise() - means.row(0)).rowwise().norm().maxCoeff();
    means.rowwise() -= means.colwise().mean().eval();
    if (width == shortest) out.relief_m2 = (means.array().square().matrix() * own.shown).mean();
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

}  // namespace

double rare_chi_square(double freedom) {
  const double variance = 2 / (9 * freedom);
  return std::pow(1 - variance + kRare * std::sqrt(variance), 3);
}

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

std::vector<Against> all_against(const std::vector<TrackedPoints>& recordings, const Rows& set,
                                 double give_m) {
  std::vector<Against> out(recordings.front().jitter_m.size());
  for (const TrackedPoints& points : recordings) {
    const RigidResiduals residuals = rigid_residuals(points, set);
    const auto own = own_displacements(residuals.shape, points.jitter_m, set);
    for (std::size_t p = 0; p < out.size(); ++p) {
      Eigen::MatrixXd off(Eigen::Index(residuals.off.size()), 3);
      for (std::size_t k = 0; k < residuals.off.size(); ++k)
        off.row(Eigen::Index(k)) = residuals.off[k].row(Eigen::Index(p));
      const Against here = against_set(off * own[p].of_residual, own[p], points.shortest, give_m);
      out[p].share = std::max(out[p].share, here.share);
      out[p].moves_m = std::max(out[p].moves_m, here.moves_m);
      out[p].relief_m2 += here.relief_m2;
    }
  }
  return out;
}

}  // namespace hyperex::motion
