// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string_view>

namespace hyperex::tracking {

/// data/openface_arkit.csv, carried inside the program: lines "action_unit,blend_shape,share".
std::string_view openface_arkit_table();

}  // namespace hyperex::tracking
