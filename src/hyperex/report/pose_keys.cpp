// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/pose_keys.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "hyperex/report/frame_products.hpp"

namespace hyperex::report {
namespace {
using Eigen::Index;

constexpr int kSweeps = 200;
constexpr double kSettled = 1e-6;  // of a weight, between sweeps

/// Minimises |target - keys^T w| over 0 <= w <= 1, starting from the given w: `gram` of the keys,
/// `along` their products with the target.
void settle(const Eigen::MatrixXd& gram, const Eigen::VectorXd& along, Eigen::VectorXd& w) {
  Eigen::VectorXd slope = along - gram * w;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double most = 0;
    for (Index i = 0; i < w.size(); ++i) {
      const double better = std::clamp(w[i] + slope[i] / gram(i, i), 0.0, 1.0);
      const double step = better - w[i];
      if (step == 0) continue;
      slope -= step * gram.col(i);
      w[i] = better;
      most = std::max(most, std::abs(step));
    }
    if (most < kSettled) return;
  }
}

class Chooser {
 public:
  Chooser(const std::vector<PointsF>& displacements, double tolerance_m)
      : displacements_(displacements),
        least_m_(least_move_m(tolerance_m)),
        coordinates_(frame_coordinates(displacements, 0.01 * tolerance_m)),
        weights_(coordinates_.rows(), 0) {}

  void add(int frame) {
    frames_.push_back(frame);
    poses_.push_back(pose_of(displacements_[std::size_t(frame)], least_m_));
    const auto k = static_cast<Index>(frames_.size());
    weights_.conservativeResize(Eigen::NoChange, k);
    weights_.col(k - 1).setZero();
    Eigen::MatrixXd keys(k, coordinates_.cols());
    for (Index i = 0; i < k; ++i) keys.row(i) = coordinates_.row(frames_[std::size_t(i)]);
    const Eigen::MatrixXd gram = keys * keys.transpose();
    tbb::parallel_for(Index{0}, coordinates_.rows(), [&](Index f) {
      const auto own = std::find(frames_.begin(), frames_.end(), int(f));
      Eigen::VectorXd w = weights_.row(f);
      if (own != frames_.end())
        w = Eigen::VectorXd::Unit(k, own - frames_.begin());
      else
        settle(gram, keys * coordinates_.row(f).transpose(), w);
      weights_.row(f) = w;
    });
    keys_ = std::move(keys);
  }

  /// Nothing moves in any frame.
  bool still() const { return coordinates_.isZero(0); }

  /// Largest distance of any vertex in a frame.
  double error_m(int frame) const {
    PointsF rest = displacements_[std::size_t(frame)];
    for (std::size_t i = 0; i < frames_.size(); ++i)
      if (const auto w = float(weights_(frame, Index(i))); w != 0) rest -= w * poses_[i];
    return std::sqrt(double(rest.rowwise().squaredNorm().maxCoeff()));
  }

  /// The frame that is shown worst. Of all frames where `exactly`, else of those that are farthest
  /// off over all vertices together, which is quicker.
  std::pair<int, double> worst(bool exactly) const {
    std::vector<int> order(std::size_t(coordinates_.rows()));
    std::iota(order.begin(), order.end(), 0);
    if (!exactly) {
      constexpr std::size_t looked_at = 8;
      const Eigen::VectorXd off = (frames_.empty() ? coordinates_ : residual()).rowwise().norm();
      std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return off[a] > off[b]; });
      order.resize(std::min(order.size(), looked_at));
    }
    std::vector<double> errors(order.size());
    tbb::parallel_for(std::size_t(0), order.size(),
                      [&](std::size_t i) { errors[i] = error_m(order[i]); });
    const auto at = std::max_element(errors.begin(), errors.end()) - errors.begin();
    return {order[std::size_t(at)], errors[std::size_t(at)]};
  }

  PoseKeys result() const {
    PoseKeys keys;
    std::vector<std::size_t> order(frames_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return frames_[a] < frames_[b]; });
    keys.weights.resize(weights_.rows(), weights_.cols());
    for (std::size_t i = 0; i < order.size(); ++i) {
      keys.frames.push_back(frames_[order[i]]);
      keys.weights.col(Index(i)) = weights_.col(Index(order[i])).cast<float>();
    }
    keys.max_error_m = worst(true).second;
    return keys;
  }

 private:
  Eigen::MatrixXd residual() const { return coordinates_ - weights_ * keys_; }

  const std::vector<PointsF>& displacements_;
  float least_m_;
  Eigen::MatrixXd coordinates_, weights_, keys_;
  std::vector<int> frames_;
  std::vector<PointsF> poses_;  // of these frames, as they are stored
};

}  // namespace

float least_move_m(double tolerance_m) {
  return float(tolerance_m / 20);
}

PointsF pose_of(const PointsF& displacement, float least_m) {
  return (displacement.rowwise().norm().array() >= least_m).cast<float>().matrix().asDiagonal() *
         displacement;
}

PoseKeys pose_keys(const std::vector<PointsF>& displacements, double tolerance_m,
                   const std::function<bool(int)>& take) {
  PoseKeys none;
  none.weights.resize(static_cast<Index>(displacements.size()), 0);
  if (displacements.empty()) return none;
  Chooser chooser(displacements, tolerance_m);
  if (chooser.still()) return none;
  for (;;) {
    auto [frame, error_m] = chooser.worst(false);
    if (error_m <= tolerance_m) std::tie(frame, error_m) = chooser.worst(true);
    if (error_m <= tolerance_m || !take(frame)) break;
    chooser.add(frame);
  }
  return chooser.result();
}

std::vector<std::string> pose_names(const PoseKeys& keys, const std::vector<double>& time_s) {
  std::vector<std::string> names;
  for (int digits = 3; digits <= 9; ++digits) {
    names.clear();
    for (const int f : keys.frames)
      names.push_back(
          fmt::format("pose_{:.{}f}s", time_s[std::size_t(f)] - time_s.front(), digits));
    if (std::set<std::string>(names.begin(), names.end()).size() == names.size()) break;
  }
  return names;
}

}  // namespace hyperex::report
