// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/mesh_floor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "hyperex/motion/lowpass.hpp"

namespace hyperex::metrics {
namespace {

constexpr double two_sided_95 = 1.959964;

double half_sum(const Stretches& values) {
  double sum = 0;
  for (const double value : values) sum += std::abs(value);
  return sum / 2;
}

double greatest_mm(const std::vector<double>& distances) {
  double most = 0;
  for (const double d : distances) most = d > most ? d : most;  // NaN is ignored
  return most;
}

}  // namespace

std::vector<Stretches> twin_remainders(const motion::Motion& run, const motion::Motion& twin) {
  const std::vector<Stretches> own = stretches_of(run), other = stretches_of(twin);
  if (own.size() != other.size())
    throw std::invalid_argument("a run and its twin must have the same samples");
  std::vector<Stretches> remainders(own.size());
  for (size_t i = 0; i < own.size(); ++i)
    for (size_t k = 0; k < own[i].size(); ++k)
      remainders[i][k] = own[i][k] - other[i][(k + 4) % own[i].size()];
  return remainders;
}

std::vector<double> xi_mesh_floor(const motion::Motion& run, const motion::Motion& twin,
                                  const std::vector<Stretches>& remainders) {
  // There are two positions per side, as for excursions. So this jitter gives a difference of
  // kResolution_m.
  std::vector<double> floor = symmetry_noise(run, kResolution_m / (2 * two_sided_95));
  if (floor.size() != remainders.size() || twin.positions.size() != remainders.size())
    throw std::invalid_argument("a run and its twin must have the same samples");
  for (size_t i = 0; i < floor.size(); ++i) floor[i] += half_sum(remainders[i]);
  return floor;
}

double excursion_mesh_floor_mm(const motion::Motion& run, const motion::Motion& twin, int left,
                               int right, double lowpass_hz) {
  double most = 0;
  for (const auto& [here, there] : {std::pair{left, right}, {right, left}}) {
    const auto own = smooth_distance_mm(run, here, lowpass_hz),
               other = smooth_distance_mm(twin, there, lowpass_hz);
    for (size_t i = 0; i < own.size() && i < other.size(); ++i)
      if (const double apart = std::abs(own[i] - other[i]); apart > most) most = apart;
  }
  return most + 1e3 * kResolution_m;
}

void add_mesh_floor(SymmetryCurve& curve, Excursions& excursions, const motion::Motion& run,
                    const motion::Motion& twin) {
  curve.mesh_remainder = twin_remainders(run, twin);
  curve.mesh_noise = xi_mesh_floor(run, twin, curve.mesh_remainder);
  add_mesh_floor(excursions, run, twin);
}

void add_mesh_floor(Excursions& excursions, const motion::Motion& run, const motion::Motion& twin) {
  for (PairExcursion& pair : excursions.pairs) {
    const double lowpass_hz = excursions.lowpass_hz;
    pair.mesh_floor_mm = excursion_mesh_floor_mm(run, twin, pair.left, pair.right, lowpass_hz);
    pair.twin_left_mm = greatest_mm(smooth_distance_mm(twin, pair.right, lowpass_hz));
    pair.twin_right_mm = greatest_mm(smooth_distance_mm(twin, pair.left, lowpass_hz));
    pair.judge();
  }
  Commissure& mouth = excursions.commissure;
  if (mouth.left < 0 || mouth.right < 0) return;
  const auto track_mm = [&](int column) {
    return motion::lowpassed(twin.time_s, 1e3 * motion::track_of(twin, column),
                             excursions.lowpass_hz)
        .value;
  };
  mouth.twin_left_track_mm = track_mm(mouth.right);
  mouth.twin_right_track_mm = track_mm(mouth.left);
}

double added_mesh_floor(const SymmetryCurve& variant, const SymmetryCurve& base) {
  const auto &own = variant.mesh_remainder, &other = base.mesh_remainder;
  if (own.empty() || own.size() != other.size()) return std::numeric_limits<double>::quiet_NaN();
  double most = 0;
  for (size_t i = 0; i < own.size(); ++i) {
    Stretches apart;
    for (size_t k = 0; k < apart.size(); ++k) apart[k] = own[i][k] - other[i][k];
    most = std::max(most, 2 * half_sum(apart));
  }
  return most;
}

ExcursionChange change_of(const PairExcursion& from, const PairExcursion& to, Side side) {
  const bool left = side == Side::left;
  const auto excursion = [&](const PairExcursion& pair) {
    return (left ? pair.left_side : pair.right_side).excursion_mm;
  };
  const auto of_twin = [&](const PairExcursion& pair) {
    return left ? pair.twin_left_mm : pair.twin_right_mm;
  };
  return banded_change(excursion(from), excursion(to), of_twin(to) - of_twin(from), from, to);
}

ExcursionChange banded_change(double from_mm, double to_mm, double twin_change_mm,
                              const PairExcursion& from, const PairExcursion& to) {
  ExcursionChange change{from_mm, to_mm};
  const double mesh_mm = change.change_mm() - twin_change_mm;
  const double scaled = change.from_mm > 0 ? std::abs(change.to_mm / change.from_mm - 1) : 0;
  const double jitter_mm = from.jitter_floor_mm / std::sqrt(2.0) * scaled;
  change.known_band_mm = std::hypot(mesh_mm, jitter_mm) + 1e3 * kResolution_m;
  const bool known = scaled == 0 || (from.known.jitter && to.known.jitter);
  change.band_mm = known ? change.known_band_mm : std::numeric_limits<double>::quiet_NaN();
  return change;
}

}  // namespace hyperex::metrics
