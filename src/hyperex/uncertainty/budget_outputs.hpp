// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/uncertainty/face_budget.hpp"

namespace hyperex::uncertainty {

/// A row a figure: variant, point, side, figure, value_mm, half_width_95_mm, decided, largest_part,
/// and half the width that each part alone would make. Throws InputError where the file cannot be
/// written.
void write_budget_csv(const std::filesystem::path& file, const FaceBudget& budget);

/// For summary.json: what was assumed, the corners of the mouth, and sentences on them.
nlohmann::ordered_json budget_json(const FaceBudget& budget);

/// On the corners of the mouth; empty where they are not measured.
std::vector<std::string> corner_sentences(const FaceBudget& budget);

}  // namespace hyperex::uncertainty
