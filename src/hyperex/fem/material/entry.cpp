// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/material/entry.hpp"

#include <cmath>

#include "hyperex/core/check_options.hpp"

namespace hyperex::fem {
namespace {

[[noreturn]] void refuse_entry(std::string_view what, Eigen::Index entry, int unknown, double value,
                               std::string_view unit) {
  throw InputError(
      fmt::format("{}: entry {} (node {}, axis {}) is {}: expected a finite number ({})", what,
                  entry, unknown / 3, "xyz"[unknown % 3], value, unit));
}

void check_elements(std::string_view what, const std::vector<double>& values, Eigen::Index elements,
                    const auto& holds, std::string_view expected) {
  require(static_cast<Eigen::Index>(values.size()) == elements,
          "Material::{} has {} values: expected {}, one for each tetrahedron", what, values.size(),
          elements);
  for (std::size_t t = 0; t < values.size(); ++t)
    require(std::isfinite(values[t]) && holds(values[t]),
            "Material::{} of tetrahedron {} is {}: expected {}", what, t, values[t], expected);
}

}  // namespace

void check_size(std::string_view what, Eigen::Index size, Eigen::Index expected) {
  require(size == expected, "{} has {} entries: expected {}", what, size, expected);
}

void check_rows(std::string_view what, Eigen::Index rows, Eigen::Index expected) {
  require(rows == expected, "{} has {} rows: expected {}", what, rows, expected);
}

void check_vector(std::string_view what, const Eigen::VectorXd& v, Eigen::Index size,
                  std::string_view unit) {
  check_size(what, v.size(), size);
  if (v.allFinite()) return;
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (!std::isfinite(v[i])) refuse_entry(what, i, static_cast<int>(i), v[i], unit);
}

void check_optional(std::string_view what, const Eigen::VectorXd& v, Eigen::Index size,
                    std::string_view unit) {
  if (v.size() > 0) check_vector(what, v, size, unit);
}

void check_values(std::string_view what, const Eigen::VectorXd& v, const std::vector<int>& unknowns,
                  std::string_view unit) {
  require(v.size() == static_cast<Eigen::Index>(unknowns.size()),
          "{} has {} entries: expected {}, one for each prescribed unknown", what, v.size(),
          unknowns.size());
  if (v.allFinite()) return;
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (!std::isfinite(v[i]))
      refuse_entry(what, i, unknowns[static_cast<std::size_t>(i)], v[i], unit);
}

void check_positive(std::string_view what, double value, std::string_view unit) {
  require(std::isfinite(value) && value > 0, "{} = {}: expected a finite number above 0{}", what,
          value, unit);
}

void check_material(const Material& m, Eigen::Index elements) {
  const auto above_zero = [](double value) { return value > 0; };
  const auto not_below_zero = [](double value) { return value >= 0; };
  check_elements("young_pa", m.young_pa, elements, above_zero, "a number above 0 (Pa)");
  check_elements(
      "poisson", m.poisson, elements, [](double nu) { return nu > -1 && nu < 0.5; },
      "a number above -1 and below 0.5");
  check_elements("viscosity_pa_s", m.viscosity_pa_s, elements, not_below_zero,
                 "0 or a number above it (Pa s)");
  check_elements("density_kg_m3", m.density_kg_m3, elements, not_below_zero,
                 "0 or a number above it (kg/m^3)");
}

void check_law(const Hyperelastic& law) {
  if (const auto problems = out_of_bounds(law); !problems.empty()) throw InputError(problems);
  require(law.c20 >= least_c20(law),
          "Hyperelastic::c20 = {}: expected at least {:.6g} (-sqrt(3 c30)), below which the law "
          "softens",
          law.c20, least_c20(law));
}

void refuse_modulus(double young_pa, double poisson) {
  throw InputError(
      fmt::format("young_pa = {}, poisson = {}: expected a Young's modulus above 0 and "
                  "a Poisson's ratio above -1 and below 0.5",
                  young_pa, poisson));
}

}  // namespace hyperex::fem
