// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace hyperex {

/// A number of bytes (>= 0) for a sentence, in the units of the options (1 GB = 1e9 bytes): "12
/// GB", "1.25 GB", "0.25 GB", "84 MB", "less than 1 MB". Never "0.0 GB".
std::string size_text(double bytes);

}  // namespace hyperex
