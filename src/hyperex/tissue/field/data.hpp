// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string_view>

namespace hyperex::tissue {

// The files of data/, built into the library.
std::string_view presets_toml();
std::string_view regions_csv();

}  // namespace hyperex::tissue
