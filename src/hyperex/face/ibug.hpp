// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyperex::face {

/// The name of one of the 68 iBUG points, 0 to 67: "ibug68_48".
std::string ibug(int k);
/// All 68, in order.
const std::vector<std::string>& all_ibug();
/// The number in an iBUG name, 48 for "ibug68_48"; nothing for any other name.
std::optional<int> ibug_number(std::string_view name);
/// "ibug68_48" for the short names "48" and "p48"; other names unchanged.
std::string full_name(const std::string& name);

}  // namespace hyperex::face
