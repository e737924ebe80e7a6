// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/stillness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hyperex/core/quantile.hpp"
#include "hyperex/motion/jitter.hpp"
#include "hyperex/motion/lowpass.hpp"
#include "hyperex/session/recording_jitter.hpp"

namespace hyperex::session {
namespace {

/// A blink of 8 mm in 0.2 s keeps more than 3 mm.
constexpr double kStillness_hz = 3;
constexpr double kSurelyMoves_m = 3e-3;

/// How far the point goes from its first place, m; 0 where it is not measured.
double way_of(const Points& track) {
  double way_m = 0;
  Eigen::Index first = -1;
  for (Eigen::Index k = 0; k < track.rows(); ++k) {
    if (!track.row(k).allFinite()) continue;
    if (first < 0) first = k;
    way_m = std::max(way_m, (track.row(k) - track.row(first)).norm());
  }
  return way_m;
}

/// Of the distance of a smoothed point at rest from its first place, in units of its jitter: in 99
/// of 100 recordings none is farther. Each coordinate of the distance has the noise of two samples.
double farthest_by_jitter(const motion::Motion& m) {
  const double noise =
      std::hypot(motion::lowpassed_noise(m.time_s, 0, kStillness_hz),
                 motion::lowpassed_noise(m.time_s, m.time_s.size() / 2, kStillness_hz));
  // The tail of a normal vector's length: of n lengths none exceeds sqrt(2 ln(n / p)), but for a
  // share of some p.
  const double count = double(m.time_s.size()) * double(m.names.size());
  return noise * std::sqrt(2 * std::log(1e3 * count));
}

struct WithinJitter {
  double way_m = 0;     ///< of the point that goes farthest, smoothed
  double jitter_m = 0;  ///< of the recording
};

/// Nothing where a point moves beyond its jitter, or where that is not known.
std::optional<WithinJitter> within_jitter(const motion::Motion& m) {
  if (median_step(m.time_s) > motion::Motion::kSmoothUpTo_s) return std::nullopt;
  const motion::LowpassFilter filter(m.time_s, kStillness_hz);
  std::vector<double> ways_m;
  WithinJitter found;
  for (int p = 0; p < int(m.names.size()); ++p) {
    ways_m.push_back(way_of(filter(motion::track_of(m, p)).value));
    found.way_m = std::max(found.way_m, ways_m.back());
    if (found.way_m >= kSurelyMoves_m) return std::nullopt;
  }
  found.jitter_m = recorded_jitter(m).jitter_m;
  if (!(found.jitter_m > 0)) return std::nullopt;
  const double farthest = farthest_by_jitter(m);
  for (int p = 0; p < int(m.names.size()); ++p) {
    const double jitter_m = std::fmax(found.jitter_m, motion::jitter_of_motion(m, {p}));
    if (ways_m[std::size_t(p)] > farthest * jitter_m) return std::nullopt;
  }
  return found;
}

}  // namespace

std::optional<Note> stillness_warning(const motion::Motion& stabilised, bool eyes_turn) {
  constexpr double least_m = 0.05e-3;
  double most_m = 0;
  for (const Points& sample : stabilised.positions)
    for (Eigen::Index i = 0; i < sample.rows(); ++i)
      if (const double moved = (sample.row(i) - stabilised.positions.front().row(i)).norm();
          moved > most_m)
        most_m = moved;
  if (stabilised.positions.size() < 2) return std::nullopt;
  if (most_m >= least_m) {
    const auto still = eyes_turn ? std::nullopt : within_jitter(stabilised);
    if (!still) return std::nullopt;
    return make_warning(
        "recording.nothing_moves",
        fmt::format("nothing moves in the recording beyond its jitter of {:.2f} mm: smoothed, no "
                    "point goes farther than {:.2f} mm from its first place; check that it is the "
                    "right one, and that the expression was made",
                    1e3 * still->jitter_m, 1e3 * still->way_m));
  }
  if (eyes_turn)
    return make_warning(
        "recording.nothing_moves",
        "nothing moves in the recording but the eyes, which turn: no other shape of "
        "this face has a weight, and so its skin stays at rest");
  return make_warning(
      "recording.nothing_moves",
      fmt::format(
          "nothing moves in the recording: no point goes farther than {:.3f} mm from its first "
          "place (expected: {:g} mm or more); check its unit, and that it is the right one",
          1e3 * most_m, 1e3 * least_m));
}

}  // namespace hyperex::session
