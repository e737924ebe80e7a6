// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>

namespace hyperex::studio {

/// 128 random bits of the system's generator, as 32 hexadecimal digits. Throws NumericalError.
std::string new_token();

/// Compares in a time that does not depend on where the texts differ.
bool same_token(std::string_view given, std::string_view own);

}  // namespace hyperex::studio
