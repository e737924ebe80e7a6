// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/lowpass.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "hyperex/metrics/nan.hpp"

namespace hyperex::metrics {

namespace {

using Eigen::Index;

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

/// Solves Reinsch's equations for the measured samples t and y: (R + lambda Q' W^-1 Q) g = Q' y, f
/// = y - lambda W^-1 Q g. g are the second derivatives at the inner samples.
SmoothTrack spline(const Eigen::VectorXd& t, const Points& y, double lambda) {
  const Index n = t.size(), inner = n - 2;
  const Eigen::VectorXd h = t.tail(n - 1) - t.head(n - 1);
  const Eigen::VectorXd weight = intervals_of(t);
  std::vector<Eigen::Triplet<double>> q, r;
  for (Index j = 0; j < inner; ++j) {
    q.emplace_back(j, j, 1 / h(j));
    q.emplace_back(j + 1, j, -1 / h(j) - 1 / h(j + 1));
    q.emplace_back(j + 2, j, 1 / h(j + 1));
    r.emplace_back(j, j, (h(j) + h(j + 1)) / 3);
    if (j + 1 < inner) {
      r.emplace_back(j, j + 1, h(j + 1) / 6);
      r.emplace_back(j + 1, j, h(j + 1) / 6);
    }
  }
  Eigen::SparseMatrix<double> Q(n, inner), R(inner, inner);
  Q.setFromTriplets(q.begin(), q.end());
  R.setFromTriplets(r.begin(), r.end());
  const Eigen::SparseMatrix<double> system =
      R + lambda * (Q.transpose() * weight.cwiseInverse().asDiagonal() * Q);
  // The system is banded. The natural order keeps the band, and no other order is better.
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower,
                              Eigen::NaturalOrdering<int>>
      factor(system);
  const Eigen::MatrixXd bend = factor.solve(Q.transpose() * y);
  SmoothTrack out{y - lambda * (weight.cwiseInverse().asDiagonal() * (Q * bend)), Points(n, 3)};
  Points second = Points::Zero(n, 3);
  second.middleRows(1, inner) = bend;
  for (Index i = 0; i + 1 < n; ++i)
    out.rate.row(i) = (out.value.row(i + 1) - out.value.row(i)) / h(i) -
                      h(i) / 6 * (2 * second.row(i) + second.row(i + 1));
  out.rate.row(n - 1) = (out.value.row(n - 1) - out.value.row(n - 2)) / h(n - 2) +
                        h(n - 2) / 6 * (second.row(n - 2) + 2 * second.row(n - 1));
  return out;
}

}  // namespace

SmoothTrack lowpassed(const std::vector<double>& time_s, const Points& track, double cutoff_hz) {
  std::vector<Index> measured;
  for (Index k = 0; k < track.rows(); ++k)
    if (track.row(k).allFinite()) measured.push_back(k);
  if (!(cutoff_hz > 0) || measured.size() < 3) return unsmoothed(time_s, track);
  Eigen::VectorXd t(Index(measured.size()));
  Points y(t.size(), 3);
  for (Index i = 0; i < t.size(); ++i) {
    const Index k = measured[std::size_t(i)];
    t(i) = time_s[std::size_t(k)];
    y.row(i) = track.row(k);
  }
  const SmoothTrack smooth = spline(t, y, std::pow(2 * std::numbers::pi * cutoff_hz, -4));
  SmoothTrack out{Points::Constant(track.rows(), 3, kNan), Points::Constant(track.rows(), 3, kNan)};
  for (Index i = 0; i < t.size(); ++i) {
    out.value.row(measured[std::size_t(i)]) = smooth.value.row(i);
    out.rate.row(measured[std::size_t(i)]) = smooth.rate.row(i);
  }
  return out;
}

Points track_of(const motion::Motion& motion, int column) {
  Points track(Index(motion.positions.size()), 3);
  for (Index k = 0; k < track.rows(); ++k)
    track.row(k) = motion.positions[std::size_t(k)].row(column);
  return track;
}

motion::Motion lowpassed(motion::Motion motion, double cutoff_hz) {
  if (!(cutoff_hz > 0)) return motion;
  for (int p = 0; p < int(motion.names.size()); ++p) {
    const Points track = lowpassed(motion.time_s, track_of(motion, p), cutoff_hz).value;
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

}  // namespace hyperex::metrics
