// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace hyperex::fuzz {

/// The `number`-th mutated input of `seeds`: one to four changes of bytes, numbers, words or lines,
/// or two seeds joined. The same for the same arguments on every machine.
std::string mutated(const std::vector<std::string>& seeds, std::uint64_t number);

}  // namespace hyperex::fuzz
