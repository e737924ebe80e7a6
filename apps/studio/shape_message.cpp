// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_message.hpp"

#include <algorithm>
#include <cmath>

namespace hyperex::studio {

void add_shape(const PointsF& displacement_m, report::BinaryBlock& block, nlohmann::json& head) {
  const float largest = displacement_m.size() > 0 ? displacement_m.cwiseAbs().maxCoeff() : 0;
  const float step_m = largest > 0 ? largest / 32767 : 1;
  std::vector<std::int16_t> steps(static_cast<std::size_t>(displacement_m.size()));
  std::transform(
      displacement_m.data(), displacement_m.data() + displacement_m.size(), steps.begin(),
      [&](float value) { return static_cast<std::int16_t>(std::lround(value / step_m)); });
  head["step_m"] = step_m;
  head["values"] = block.add(steps);
}

}  // namespace hyperex::studio
