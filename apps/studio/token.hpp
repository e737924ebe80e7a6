// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>

namespace hyperex::studio {

/// 128 random bits of the system's generator as 32 hexadecimal digits.
std::string new_token();

/// Takes as long for a guess that is nearly right as for one that is wrong from the start.
bool same_token(std::string_view given, std::string_view own);

}  // namespace hyperex::studio
