// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace hyperex::expression {

/// The tables of the folder data, which are embedded in the program.
std::string_view canonical_units_table();
std::string_view canonical_landmarks_table();
std::string_view network_points_table();
std::string_view candide_pairs_table();
std::string_view candide_landmarks_table();
std::string_view candide_units_table();
std::string_view openface_arkit_table();
std::string_view expression_shapes_table();
std::string_view expression_couplings_table();

/// The rows of such a table as cells, without comments, blank lines and the line `header`. The
/// tables are part of the program, so an error in them is a programming error, not an InputError.
std::vector<std::vector<std::string>> table_rows(std::string_view text, std::string_view header);
/// A cell as a number; throws std::logic_error if it is not a number.
double table_number(const std::string& cell);
/// A cell of integers separated by blanks, each from 0 to end - 1; throws std::logic_error
/// otherwise.
std::vector<int> table_indices(const std::string& cell, int end);

}  // namespace hyperex::expression
