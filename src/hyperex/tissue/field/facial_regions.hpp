// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

namespace hyperex::tissue {

/// A named part of the face, symmetric (data/regions.csv).
struct FacialRegion {
  std::string name, meaning;
  std::vector<int> vertices;  ///< of the canonical face
};
const std::vector<FacialRegion>& facial_regions();
/// Whether `name` is that of a region, alone or with _L or _R.
bool is_region(const std::string& name);

}  // namespace hyperex::tissue
