// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string_view>

namespace hyperex::report {

/// The replay page as Vite built it from web/, with scripts and styles inside and no data.
std::string_view page_template();

/// Where in it the data belong.
inline constexpr std::string_view data_mark = "<!--HYPEREX_DATA-->";

}  // namespace hyperex::report
