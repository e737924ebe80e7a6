// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/options.hpp"

#include <cmath>

namespace hyperex::tissue {

const ParameterInfo& parameter_info(int parameter) {
  static const ParameterInfo table[parameter_count] = {
      {"young_kpa", "Young's modulus (kPa)", 1000, 1, 1e9, "from 0.001 to 1e+06 kPa"},
      {"viscosity_pa_s", "Viscosity (Pa s)", 1, 0, 1e7, "from 0 to 1e+07 Pa s"},
      {"poisson", "Poisson's ratio", 1, -0.99, 0.4999, "from -0.99 to 0.4999"},
      {"density_kg_m3", "Density (kg/m^3)", 1, 0.001, 20000, "from 0.001 to 20000 kg/m^3"}};
  return table[parameter];
}

bool is_allowed(int parameter, double value) {
  const ParameterInfo& info = parameter_info(parameter);
  // Multiplied and divided by its unit a limit may come back a rounding away.
  const double slack = 1e-12;
  return std::isfinite(value) && value <= info.most * (1 + slack) &&
         value >= info.least - slack * std::abs(info.least);
}

}  // namespace hyperex::tissue
