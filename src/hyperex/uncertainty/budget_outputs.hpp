// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/uncertainty/face_budget.hpp"

namespace hyperex::uncertainty {

/// A row a figure: variant, point, side, figure, value_mm, half_width_95_mm, decided, largest_part,
/// half the width that each part alone would make, known_half_width_95_mm and unknown_part
/// ("jitter", or empty). Where a part is not known, its cell, half_width_95_mm and largest_part are
/// empty, and decided is 0 or empty. Throws InputError where the file cannot be written.
void write_budget_csv(const std::filesystem::path& file, const FaceBudget& budget);

/// For summary.json: what was assumed, the corners of the mouth, and sentences on them.
nlohmann::ordered_json budget_json(const FaceBudget& budget);

/// On the corners of the mouth; empty where they are not measured.
std::vector<std::string> corner_sentences(const FaceBudget& budget);

}  // namespace hyperex::uncertainty
