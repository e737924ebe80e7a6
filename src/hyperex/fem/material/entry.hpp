// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Checks of the arguments that callers pass to this library, done once at its public functions. A
// mistake gives an InputError that names the entry, its value and what was expected. It never
// aborts the program.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <string_view>
#include <vector>

#include "hyperex/core/error.hpp"
#include "hyperex/fem/material/hyperelastic.hpp"
#include "hyperex/fem/material/linear_viscoelastic.hpp"

namespace hyperex::fem {

/// Throws InputError with the formatted sentence if `holds` is false.
template <class... Values>
void require(bool holds, fmt::format_string<const Values&...> sentence, const Values&... values) {
  if (!holds) [[unlikely]]
    throw InputError(fmt::format(sentence, values...));
}

/// "force has 5 entries: expected 81"
void check_size(std::string_view what, Eigen::Index size, Eigen::Index expected);
void check_rows(std::string_view what, Eigen::Index rows, Eigen::Index expected);

/// Checks a vector of all unknowns, 3 n + axis: it must have `size` finite entries. Allocates
/// nothing if it is correct.
void check_vector(std::string_view what, const Eigen::VectorXd& v, Eigen::Index size,
                  std::string_view unit);
/// The same, but the vector may be empty.
void check_optional(std::string_view what, const Eigen::VectorXd& v, Eigen::Index size,
                    std::string_view unit);
/// Checks that there is one finite number for each of `unknowns`.
void check_values(std::string_view what, const Eigen::VectorXd& v, const std::vector<int>& unknowns,
                  std::string_view unit);
void check_positive(std::string_view what, double value, std::string_view unit = "");

/// Checks lengths and values. The message names the first tetrahedron with inadmissible values.
void check_material(const Material& material, Eigen::Index elements);
/// Checks the bounds of the law's parameters and is_admissible().
void check_law(const Hyperelastic& law);

}  // namespace hyperex::fem
