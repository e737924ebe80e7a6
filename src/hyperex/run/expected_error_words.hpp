// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace hyperex::run {

/// One line from a run's summary: how far the skin is expected to be from the true face, by region,
/// mm, and how much of its motion the recording itself determines, %. Empty where the summary has
/// no `uncertainty`.
std::string expected_error_line(const nlohmann::ordered_json& summary);

}  // namespace hyperex::run
