// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/options.hpp"

#include <cmath>

namespace hyperex::tissue {

OptionDetails parameter_details(int parameter) {
  static constexpr OptionDetails table[parameter_count] = {
      {.unit = kKilopascals, .bounds = {1, 1e9}, .name = "young_pa"},
      {.unit = kPascalSeconds, .bounds = {0, 1e7}, .name = "viscosity_pa_s"},
      {.bounds = {-0.99, 0.4999}, .name = "poisson"},
      {.unit = kKilogramsPerCubicMetre, .bounds = {0.001, 20000}, .name = "density_kg_m3"}};
  return table[parameter];
}

const ParameterInfo& parameter_info(int parameter) {
  static const std::vector<ParameterInfo> table = [] {
    std::vector<ParameterInfo> all;
    for (const char* title :
         {"Young's modulus (kPa)", "Viscosity (Pa s)", "Poisson's ratio", "Density (kg/m^3)"}) {
      const OptionDetails details = parameter_details(int(all.size()));
      const Unit& unit = details.unit;
      const Bounds& bounds = details.bounds;
      const auto words = [](const Bounds& of, const char* in) {
        return "from " + of.text() + (*in ? std::string(" ") + in : "");
      };
      all.push_back({key_of("", details), title, unit.to_si(1), bounds.least, bounds.most,
                     words(unit.from_si(bounds), unit.name), python_name("", details),
                     words(bounds, unit.si_name)});
    }
    return all;
  }();
  return table[std::size_t(parameter)];
}

bool is_allowed(int parameter, double value) {
  const ParameterInfo& info = parameter_info(parameter);
  // Multiplied and divided by its unit a limit may come back a rounding away.
  const double slack = 1e-12;
  return std::isfinite(value) && value <= info.most * (1 + slack) &&
         value >= info.least - slack * std::abs(info.least);
}

std::string factor_key(int parameter) {
  const std::string& key = parameter_info(parameter).key;
  return key.substr(0, key.find('_')) + "_factor";
}

}  // namespace hyperex::tissue
