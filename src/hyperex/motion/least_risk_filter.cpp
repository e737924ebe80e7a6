// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/least_risk_filter.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/motion/lowpass.hpp"

namespace hyperex::motion {
namespace {

using Eigen::Index;

constexpr std::size_t kFewestTimes = 20;  // as jitter_of_motion()
constexpr double kFiner = 1.25;           // ratio of one cut-off to the next

/// `tracks` (a multiple of 3 rows) through the filter.
Eigen::MatrixXd through(const LowpassFilter& filter, const Eigen::MatrixXd& tracks) {
  Eigen::MatrixXd out(tracks.rows(), tracks.cols());
  for (Index row = 0; row < tracks.rows(); row += 3)
    out.middleRows<3>(row) = filter(tracks.middleRows<3>(row).transpose()).value.transpose();
  return out;
}

/// trace(S) / n: how much of a sample's own value the filter keeps, away from the ends.
double kept_share(const std::vector<double>& time_s, double cutoff_hz) {
  const auto middle = Index(time_s.size() / 2);
  const Index reach = std::min<Index>(middle, 200);
  const std::vector<double> near(time_s.begin() + (middle - reach),
                                 time_s.begin() + std::min(middle + reach, Index(time_s.size())));
  Points impulse = Points::Zero(Index(near.size()), 3);
  impulse(reach, 0) = 1;
  return lowpassed(near, impulse, cutoff_hz).value(reach, 0);
}

}  // namespace

Eigen::MatrixXd least_risk_filtered(const std::vector<double>& time_s,
                                    const Eigen::MatrixXd& tracks, double noise_m,
                                    double least_hz) {
  if (!(noise_m > 0) || time_s.size() < kFewestTimes || tracks.rows() == 0) return tracks;
  const double rate_hz = double(time_s.size() - 1) / (time_s.back() - time_s.front());
  const double variance = noise_m * noise_m;
  Eigen::MatrixXd best = tracks;
  double least = variance;
  for (double cutoff_hz = rate_hz / 2; cutoff_hz >= least_hz; cutoff_hz /= kFiner) {
    const Eigen::MatrixXd smooth = through(LowpassFilter(time_s, cutoff_hz), tracks);
    const double risk = (tracks - smooth).squaredNorm() / double(tracks.size()) +
                        2 * variance * kept_share(time_s, cutoff_hz) - variance;
    if (risk >= least) continue;
    least = risk;
    best = smooth;
  }
  return best;
}

}  // namespace hyperex::motion
