// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/estimate/estimate.hpp"

namespace hyperex::estimate {

/// The answers, one sentence or more each: "cheek_L / cheek_R: 1.8 (95 %: 1.4 to 2.3): ...".
/// Where the interval is too wide to be an answer but excludes 1: "zygomatic_L: acts less strongly
/// than its counterpart, but by how much cannot be determined (95 %: 0.00 to 0.94)."
std::vector<std::string> sentences(const Estimate& estimate);

/// Everything as JSON text, units in the names of its keys.
std::string as_json(const Estimate& estimate);

}  // namespace hyperex::estimate
