// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <functional>
#include <vector>

namespace hyperex::motion {

// Readings at a wrong value for a short time, of a point or of anything else that is measured again
// and again.

/// The value of reading k; NaN where it is missing. Of a single number the other two are 0.
using Path = std::function<Eigen::RowVector3d(std::size_t)>;

/// A path that jumps away, stays there for some readings and jumps back.
struct Stay {
  std::size_t before = 0;  ///< the last reading before it jumps away
  std::size_t after = 0;   ///< the first reading after it has jumped back, at least before + 2
  double step = 0;         ///< the shorter one of both jumps, in the path's unit
};

/// A stay takes at most this long (s), from `before` to `after`.
inline constexpr double kLongestStay_s = 0.3;
/// The longest stay that is mended, s: as long as GapOptions fills a gap by default.
inline constexpr double kLongestMended_s = 0.2;
/// Times in a file are rounded.
inline constexpr double kStaySlack_s = 1e-3;

/// Whether a stay is to be mended.
bool is_mended(const Stay& stay, const std::vector<double>& time_s);

/// What counts as a stay.
struct StayRule {
  double least_step = 0;      ///< both jumps are longer, in the path's unit
  double longest_step_s = 0;  ///< the readings of a jump are at most this far apart
  /// Whether a stay that the path alone looks like is one.
  std::function<bool(const Stay&)> accepts;
};

/// The stays of a path, in the order of time; none overlaps another. In each
/// - the jumps away and back cancel each other to within half of the shorter one, the step,
/// - the step is more than three times as long as any step just before, between and after,
/// - all readings between are off the line in time from `before` to `after` by more than half the
///   step.
std::vector<Stay> stays_of(const Path& at, const std::vector<double>& time_s, const StayRule& rule);

/// How far reading k, before < k < after, is off that line, in the path's unit.
double off_line(const Path& at, const std::vector<double>& time_s, const Stay& stay, std::size_t k);

}  // namespace hyperex::motion
