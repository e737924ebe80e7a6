// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>

#include "hyperex/expression/blend_shapes.hpp"

namespace hyperex::expression {

/// Shapes with a weight above 0.3 that the model does not have: "mouthClose up to 0.65 at 83.2 s;
/// ..."; empty where there are none. Gaze moves no skin and is left out.
std::string lost_shapes(const BlendShapes& shapes, const FaceModel& model);

/// An interval of 0.3 s in which the weights are nearer to rest, where all are 0, than at the
/// start.
struct RestInWeights {
  double from_s = 0, to_s = 0;                  ///< from the first sample
  std::string shape;                            ///< whose weight falls most
  double weight_at_start = 0, weight_then = 0;  ///< its means
};

/// Of all intervals of 0.3 s the one with the least sum of weights, gaze left out. Nothing where no
/// weight is 0.3 less in it than in the first 0.1 s, where one is above 0.3 in it, and where the
/// recording is shorter than two of them.
std::optional<RestInWeights> rest_in_weights(const BlendShapes& shapes);

}  // namespace hyperex::expression
