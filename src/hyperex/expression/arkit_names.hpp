// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

namespace hyperex::expression {

/// The names of ARKit's 52 blend shapes, in alphabetical order, left before right.
const std::vector<std::string>& arkit_shapes();

/// The blend shapes that a unit's `arkit` names: for "mouthSmile*", the two with Left and Right;
/// for a name without a star, the name itself; for "", none.
std::vector<std::string> arkit_names(const std::string& pattern);

/// ARKit's name of a shape, in whose place rigs write JawOpen, mouthSmile_L or, where ARKit knows
/// no sides, browInnerUp_L; empty where it is none.
std::string arkit_name_of(std::string written);

}  // namespace hyperex::expression
