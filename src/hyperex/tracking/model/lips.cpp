// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/model/lips.hpp"

#include <set>

#include "hyperex/tracking/model/tables.hpp"

namespace hyperex::tracking {

std::vector<bool> within_lips(const FaceModel& model) {
  std::set<int> inside;
  for (const auto& row : table_rows(network_points_table(), "kind,points"))
    if (row.at(0) == "inside_lip")
      for (const int point : table_indices(row.at(1), 468)) inside.insert(point);
  std::vector<bool> within(std::size_t(model.vertex_count()), false);
  for (const auto& [vertex, network] : model.pairs)
    if (inside.contains(network)) within[std::size_t(vertex)] = true;
  return within;
}

}  // namespace hyperex::tracking
