// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/lowpass.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace hyperex::motion {

namespace {

using Eigen::Index;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

SmoothTrack unsmoothed(const std::vector<double>& time_s, const Points& track) {
  SmoothTrack out{track, Points::Constant(track.rows(), 3, kNan)};
  const Index count = track.rows();
  for (Index k = 0; k < count && count > 1; ++k) {
    if (!track.row(k).allFinite()) continue;
    const Index before = std::max<Index>(k - 1, 0), after = std::min(k + 1, count - 1);
    out.rate.row(k) = (track.row(after) - track.row(before)) /
                      (time_s[std::size_t(after)] - time_s[std::size_t(before)]);
  }
  return out;
}

/// The time interval that each sample represents.
Eigen::VectorXd intervals_of(const Eigen::VectorXd& t) {
  const Index n = t.size();
  const Eigen::VectorXd h = t.tail(n - 1) - t.head(n - 1);
  Eigen::VectorXd weight(n);
  weight(0) = h(0), weight(n - 1) = h(n - 2);
  for (Index i = 1; i + 1 < n; ++i) weight(i) = (h(i - 1) + h(i)) / 2;
  return weight;
}

/// Reinsch's equations for the times t of measured samples y: (R + lambda Q' W^-1 Q) g = Q' y, f =
/// y - lambda W^-1 Q g. g are the second derivatives at the inner samples. The matrix has five
/// diagonals and is factored once (L D L') for all tracks.
class SmoothingSpline {
 public:
  SmoothingSpline(const Eigen::VectorXd& t, double lambda)
      : h_(t.tail(t.size() - 1) - t.head(t.size() - 1)),
        inverse_weight_(intervals_of(t).cwiseInverse()),
        lambda_(lambda),
        diagonal_(t.size() - 2),
        first_(Eigen::VectorXd::Zero(t.size() - 2)),
        second_(Eigen::VectorXd::Zero(t.size() - 2)) {
    for (Index j = 0; j < diagonal_.size(); ++j) {
      double own = (h_(j) + h_(j + 1)) / 3 + lambda * product(j, j), next = 0;
      if (j >= 1) next = h_(j) / 6 + lambda * product(j - 1, j);
      if (j >= 2) {
        second_(j) = lambda * product(j - 2, j) / diagonal_(j - 2);
        next -= second_(j) * diagonal_(j - 2) * first_(j - 1);
        own -= second_(j) * second_(j) * diagonal_(j - 2);
      }
      if (j >= 1) {
        first_(j) = next / diagonal_(j - 1);
        own -= first_(j) * first_(j) * diagonal_(j - 1);
      }
      diagonal_(j) = own;
    }
  }

  SmoothTrack operator()(const Points& y) const {
    const Index n = y.rows(), inner = n - 2;
    Points bend = Points::Zero(n, 3);  // g, and 0 at both ends
    for (Index j = 0; j < inner; ++j) {
      bend.row(j + 1) =
          (y.row(j) - y.row(j + 1)) / h_(j) + (y.row(j + 2) - y.row(j + 1)) / h_(j + 1);
      if (j >= 1) bend.row(j + 1) -= first_(j) * bend.row(j);
      if (j >= 2) bend.row(j + 1) -= second_(j) * bend.row(j - 1);
    }
    for (Index j = inner - 1; j >= 0; --j) {
      bend.row(j + 1) /= diagonal_(j);
      if (j + 1 < inner) bend.row(j + 1) -= first_(j + 1) * bend.row(j + 2);
      if (j + 2 < inner) bend.row(j + 1) -= second_(j + 2) * bend.row(j + 3);
    }
    SmoothTrack out{y, Points(n, 3)};
    for (Index i = 0; i < n; ++i) {
      Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();  // of Q g
      if (i + 1 < n) sum += (bend.row(i + 1) - bend.row(i)) / h_(i);
      if (i >= 1) sum -= (bend.row(i) - bend.row(i - 1)) / h_(i - 1);
      out.value.row(i) -= lambda_ * inverse_weight_(i) * sum;
    }
    for (Index i = 0; i + 1 < n; ++i)
      out.rate.row(i) = (out.value.row(i + 1) - out.value.row(i)) / h_(i) -
                        h_(i) / 6 * (2 * bend.row(i) + bend.row(i + 1));
    out.rate.row(n - 1) = (out.value.row(n - 1) - out.value.row(n - 2)) / h_(n - 2) +
                          h_(n - 2) / 6 * (bend.row(n - 2) + 2 * bend.row(n - 1));
    return out;
  }

 private:
  /// Entry (i, j) of Q' W^-1 Q. Column j of Q is 1 / h_j, -1 / h_j - 1 / h_(j+1), 1 / h_(j+1) in
  /// the rows j, j + 1, j + 2.
  double product(Index i, Index j) const {
    const auto q = [&](Index row, Index column) {
      if (row == column) return 1 / h_(column);
      return row == column + 2 ? 1 / h_(column + 1) : -1 / h_(column) - 1 / h_(column + 1);
    };
    double sum = 0;
    for (Index row = j; row <= i + 2; ++row) sum += q(row, i) * inverse_weight_(row) * q(row, j);
    return sum;
  }

  Eigen::VectorXd h_, inverse_weight_;
  double lambda_;
  Eigen::VectorXd diagonal_, first_, second_;  // D, and the diagonals of L below its own
};

}  // namespace

struct LowpassFilter::Impl {
  std::vector<double> time_s;
  double cutoff_hz;
  std::optional<SmoothingSpline> whole;  ///< of all times

  SmoothingSpline spline_of(const Eigen::VectorXd& t) const {
    return {t, std::pow(2 * std::numbers::pi * cutoff_hz, -4)};
  }
  SmoothTrack with_gaps(const Points& track) const;
};

LowpassFilter::LowpassFilter(std::vector<double> time_s, double cutoff_hz)
    : impl_(std::make_unique<Impl>(Impl{std::move(time_s), cutoff_hz, {}})) {
  const std::vector<double>& t = impl_->time_s;
  if (cutoff_hz > 0 && t.size() >= 3)
    impl_->whole.emplace(
        impl_->spline_of(Eigen::Map<const Eigen::VectorXd>(t.data(), Index(t.size()))));
}
LowpassFilter::~LowpassFilter() = default;

SmoothTrack LowpassFilter::operator()(const Points& track) const {
  if (!impl_->whole) return unsmoothed(impl_->time_s, track);
  return track.allFinite() ? (*impl_->whole)(track) : impl_->with_gaps(track);
}

SmoothTrack LowpassFilter::Impl::with_gaps(const Points& track) const {
  std::vector<Index> measured;
  for (Index k = 0; k < track.rows(); ++k)
    if (track.row(k).allFinite()) measured.push_back(k);
  if (measured.size() < 3) return unsmoothed(time_s, track);
  Eigen::VectorXd t(Index(measured.size()));
  Points y(t.size(), 3);
  for (Index i = 0; i < t.size(); ++i) {
    const Index k = measured[std::size_t(i)];
    t(i) = time_s[std::size_t(k)];
    y.row(i) = track.row(k);
  }
  const SmoothTrack smooth = spline_of(t)(y);
  SmoothTrack out{Points::Constant(track.rows(), 3, kNan), Points::Constant(track.rows(), 3, kNan)};
  for (Index i = 0; i < t.size(); ++i) {
    out.value.row(measured[std::size_t(i)]) = smooth.value.row(i);
    out.rate.row(measured[std::size_t(i)]) = smooth.rate.row(i);
  }
  return out;
}

SmoothTrack lowpassed(const std::vector<double>& time_s, const Points& track, double cutoff_hz) {
  return LowpassFilter(time_s, cutoff_hz)(track);
}

Points track_of(const Motion& motion, int column) {
  Points track(Index(motion.positions.size()), 3);
  for (Index k = 0; k < track.rows(); ++k)
    track.row(k) = motion.positions[std::size_t(k)].row(column);
  return track;
}

Motion lowpassed(Motion motion, double cutoff_hz) {
  if (!(cutoff_hz > 0)) return motion;
  const LowpassFilter filter(motion.time_s, cutoff_hz);
  for (int p = 0; p < int(motion.names.size()); ++p) {
    const Points track = filter(track_of(motion, p)).value;
    for (Index k = 0; k < track.rows(); ++k) motion.positions[std::size_t(k)].row(p) = track.row(k);
  }
  return motion;
}

double lowpassed_noise(const std::vector<double>& time_s, std::size_t sample, double cutoff_hz) {
  if (!(cutoff_hz > 0) || time_s.size() < 3) return 1;
  const double reach_s = 2 / cutoff_hz;
  const auto from = std::ranges::lower_bound(time_s, time_s[sample] - reach_s),
             to = std::ranges::upper_bound(time_s, time_s[sample] + reach_s);
  const std::vector<double> near(from, to);
  const auto count = Index(near.size()), at = Index(sample) - Index(from - time_s.begin());
  if (count < 3) return 1;
  Points impulse = Points::Zero(count, 3);
  impulse(at, 0) = 1;
  const Eigen::VectorXd response = lowpassed(near, impulse, cutoff_hz).value.col(0);
  const Eigen::VectorXd weight =
      intervals_of(Eigen::Map<const Eigen::VectorXd>(near.data(), count));
  return response.cwiseProduct(weight).norm() / weight(at);
}

double end_margin_s(double cutoff_hz) {
  return cutoff_hz > 0 ? 0.5 / cutoff_hz : 0;
}

double greatest_inside(const std::vector<double>& time_s, const std::vector<double>& values,
                       double cutoff_hz) {
  double inside = kNan, all = kNan;
  const double margin_s = end_margin_s(cutoff_hz);
  for (std::size_t k = 0; k < values.size(); ++k) {
    all = std::fmax(all, values[k]);
    if (time_s[k] - time_s.front() >= margin_s && time_s.back() - time_s[k] >= margin_s)
      inside = std::fmax(inside, values[k]);
  }
  return std::isnan(inside) ? all : inside;
}

}  // namespace hyperex::motion
