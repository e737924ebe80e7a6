// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/expression/blend_shapes.hpp"

namespace hyperex::expression {

// Readings of a weight that no face shows: frames in which the tracker was wrong, or a number that
// was mistyped.

/// A reading of one weight that jumps away and comes back.
struct WildWeight {
  std::size_t sample = 0, shape = 0;  ///< its row and column in the weights
  double off = 0;                     ///< from the median of the readings around it
};

struct MendedShapes {
  BlendShapes shapes;            ///< wild weights interpolated
  std::vector<WildWeight> wild;  ///< in the order of time, then of the shapes
  /// Readings that jump as far but may be real, in the same order; `shapes` has them as recorded.
  std::vector<WildWeight> doubtful;
};

/// A jump counts if it exceeds this weight. In a take of Live Link Face with a brisk range of
/// motion (30 Hz, 4030 samples) the largest jump of a lone reading is 0.06.
inline constexpr double kWildWeight = 0.3;
/// Readings that are farther apart than this (s) may jump farther, in proportion. That take,
/// thinned to 15, 10 and 7.5 Hz, has jumps of up to 0.19, 0.36 and 0.43. They count from 0.47, 0.71
/// and 0.94.
inline constexpr double kWildWeight_s = 1.0 / 24;

/// Finds each reading that differs by more than kWildWeight from the median of the five readings of
/// its weight around it, and is alone: within a third of the jump, the readings before and after
/// agree with that median and with the readings next to them. A lone reading is replaced by linear
/// interpolation in time between the two beside it. It is kept, and is in `doubtful`, where it may
/// be real:
/// - where the reading before or after is more than about 1/24 s away, as a face can be that fast;
/// - at the first or last reading, as a movement may be cut off there. All others of the five must
///   then agree with the median.
/// Several readings are wild where the weight jumps away and, within motion::kLongestStay_s, back
/// by a step of about the same size. Both steps exceed kWildWeight between readings at most 1/24 s
/// apart, and are three times as large as the steps beside and between them. All readings between
/// are farther than half a step from the line from the reading before to the one after. Up to
/// motion::kLongestMended_s they are interpolated; longer ones are in `doubtful`.
/// Measured: that take has none, nor has it with a step of 0.1 that is twice as large as those
/// beside it. Played at twice its speed it has none, at three times its speed thirteen. Of stays of
/// 2 to 8 readings put in there and into talks, 93 % are found from 0.35 and 98 % from 0.5.
/// Empty cells are passed over. A weight with fewer than five readings is not searched. Nor are the
/// weights of eyes and lids (eyeBlink, eyeSquint, eyeWide, eyeLook) and of the tongue, which really
/// change that fast.
MendedShapes without_wild_weights(BlendShapes shapes);

/// A sentence that says how many wild readings there are and names the first three by file, line,
/// column, time and jump; empty if there are none. Weights of one column, as those of left and
/// right that an action unit gives, count as one reading.
std::string wild_weights_sentence(const MendedShapes& mended);
/// The same for the doubtful ones.
std::string doubtful_weights_sentence(const MendedShapes& mended);

}  // namespace hyperex::expression
