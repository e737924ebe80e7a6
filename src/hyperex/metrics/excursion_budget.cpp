// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/excursion_budget.hpp"

#include <cmath>

#include "hyperex/core/within_95.hpp"

namespace hyperex::metrics {

ErrorBudget budget_of_difference(const PairExcursion& pair) {
  const auto add = [](ErrorBudget& to, ErrorPart part, double floor_mm) {
    if (!std::isnan(floor_mm)) to.add(part, std::pow(floor_mm / kWithin95, 2));
  };
  ErrorBudget out;
  add(out, ErrorPart::jitter, pair.jitter_floor_mm);
  add(out, ErrorPart::head_pose, pair.pose_floor_mm);
  add(out, ErrorPart::mesh, pair.mesh_floor_mm);
  add(out, ErrorPart::repetition, pair.repetition_floor_mm);
  return out;
}

std::string largest_part_of(const PairExcursion& pair) {
  const ErrorBudget budget = budget_of_difference(pair);
  return budget.variance() > 0 ? name_of(budget.largest()) : "";
}

}  // namespace hyperex::metrics
