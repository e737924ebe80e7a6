// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What callers of this room hand in is checked once, where it enters. A mistake is an InputError
// that names the entry, its value and what was expected; never the end of the caller's program.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <string_view>
#include <vector>

#include "hyperex/core/error.hpp"
#include "hyperex/fem/material/hyperelastic.hpp"
#include "hyperex/fem/material/linear_viscoelastic.hpp"

namespace hyperex::fem {

/// Throws InputError with the sentence where `holds` is false.
template <class... Values>
void require(bool holds, fmt::format_string<const Values&...> sentence, const Values&... values) {
  if (!holds) [[unlikely]]
    throw InputError(fmt::format(sentence, values...));
}

/// "force has 5 entries: expected 81"
void check_size(std::string_view what, Eigen::Index size, Eigen::Index expected);
void check_rows(std::string_view what, Eigen::Index rows, Eigen::Index expected);

/// All unknowns, 3 n + axis: `size` finite numbers. Allocates nothing where they are.
void check_vector(std::string_view what, const Eigen::VectorXd& v, Eigen::Index size,
                  std::string_view unit);
/// The same, or none at all.
void check_optional(std::string_view what, const Eigen::VectorXd& v, Eigen::Index size,
                    std::string_view unit);
/// One finite number for each of `unknowns`.
void check_values(std::string_view what, const Eigen::VectorXd& v, const std::vector<int>& unknowns,
                  std::string_view unit);
void check_positive(std::string_view what, double value, std::string_view unit = "");

/// Lengths and values; the message names the first tetrahedron whose values no material has.
void check_material(const Material& material, Eigen::Index elements);
/// Bounds, and what is_admissible() says.
void check_law(const Hyperelastic& law);

}  // namespace hyperex::fem
