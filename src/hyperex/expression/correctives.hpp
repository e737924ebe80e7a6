// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>

namespace hyperex::expression {

/// Two of ARKit's blend shapes that a face shows together.
struct ShapePair {
  std::string first, second;  ///< ARKit's names
};

// A corrective is a shape that is added to the sum of two blend shapes, since a face that shows
// both is no sum of both. Its weight is the product of the two weights, and so 0 where only one of
// them acts and 1 where both are 1.

/// The name of a pair's corrective: both names with an underscore between, "jawOpen_mouthClose".
std::string corrective_name(const ShapePair& pair);

/// The pair that a rig's shape of this name corrects. Its parts may be written as rigs do
/// (arkit_name_of()): "JawOpen_MouthClose", "jawOpen_mouthSmile_L". Nothing where the name is none
/// of two different shapes.
std::optional<ShapePair> corrected_pair(const std::string& name);

}  // namespace hyperex::expression
