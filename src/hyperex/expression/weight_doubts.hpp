// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <limits>
#include <optional>
#include <string>

#include "hyperex/expression/blend_shapes.hpp"

namespace hyperex::expression {

/// The shapes whose weight exceeds 0.3 but which the model does not have, as in "tongueOut up to
/// 0.65 at 83.2 s; ..."; empty if there are none. Gaze is excluded, because it turns the
/// eyes. Only what lies from `from_s` to `to_s` counts, in seconds from the first sample.
std::string lost_shapes(const BlendShapes& shapes, const FaceModel& model, double from_s = 0,
                        double to_s = std::numeric_limits<double>::infinity());

/// Shapes of one side of the face without a column, whose counterparts exceed 0.05. They count as
/// 0, so left and right differ.
struct MissingSides {
  std::string text;  ///< one sentence; empty where there are none
  /// Whether some other shape has columns for both sides. Otherwise the recording may well be meant
  /// to be of one side.
  bool doubtful = false;
};

/// Looks at shapes that exist on either side. Those of gaze and those that shift the jaw or the
/// mouth to one side are left out: they are directions.
MissingSides missing_sides(const BlendShapes& shapes);

/// An interval of 0.3 s in which the weights are nearer to rest (all weights 0) than at the start.
struct RestInWeights {
  double from_s = 0, to_s = 0;                  ///< from the first sample
  std::string shape;                            ///< the shape whose weight decreases most
  double weight_at_start = 0, weight_then = 0;  ///< means of its weight
};

/// The interval of 0.3 s with the least sum of weights, gaze excluded, among intervals that start
/// at least 0.1 s apart. Returns nothing if no weight is lower there by 0.3 than in the first 0.1
/// s, if any weight exceeds 0.3 there, or if the recording is shorter than two such intervals.
std::optional<RestInWeights> rest_in_weights(const BlendShapes& shapes);

}  // namespace hyperex::expression
