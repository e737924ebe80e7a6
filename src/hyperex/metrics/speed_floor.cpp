// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/speed_floor.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "hyperex/motion/lowpass.hpp"

namespace hyperex::metrics {

namespace {

// The greatest speed of a long track varies little from draw to draw: fewer are enough.
constexpr std::size_t kMostTracks = 200, kFewestTracks = 20, kSamples = 600'000;

double quantile_95(std::vector<double>& values) {
  const auto at = values.begin() + long(0.95 * double(values.size()));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

SpeedFloor speed_floor(const std::vector<double>& time_s, double jitter_m, double cutoff_hz) {
  if (!(jitter_m > 0) || time_s.size() < 3) return {};
  std::mt19937 engine(1);
  std::normal_distribution<double> normal(0, 1e3 * jitter_m);
  std::vector<double> peaks, paths;
  double squares = 0;
  Points noise_mm(Eigen::Index(time_s.size()), 3);
  const motion::LowpassFilter filter(time_s, cutoff_hz);
  const std::size_t tracks = std::clamp(kSamples / time_s.size(), kFewestTracks, kMostTracks);
  for (std::size_t track = 0; track < tracks; ++track) {
    for (Eigen::Index k = 0; k < noise_mm.rows(); ++k)
      for (Eigen::Index axis = 0; axis < 3; ++axis) noise_mm(k, axis) = normal(engine);
    const motion::SmoothTrack smooth = filter(noise_mm);
    const Eigen::Index steps = noise_mm.rows() - 1;
    std::vector<double> speed;
    for (Eigen::Index k = 0; k <= steps; ++k) speed.push_back(smooth.rate.row(k).norm());
    peaks.push_back(motion::greatest_inside(time_s, speed, cutoff_hz));
    paths.push_back(
        (smooth.value.bottomRows(steps) - smooth.value.topRows(steps)).rowwise().norm().sum());
    squares += smooth.rate.squaredNorm() / double(noise_mm.rows());
  }
  return {quantile_95(peaks), quantile_95(paths), std::sqrt(squares / double(tracks))};
}

}  // namespace hyperex::metrics
