// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/ct/ct_face.hpp"

namespace hyperex::ct {

/// The text of summary.json: values with their units in their names, no times, nothing of the
/// patient. `files`: those that the folder holds.
std::string summary_json(const CtFace& face, const std::vector<std::string>& files);

/// A few lines to print.
std::vector<std::string> summary_lines(const CtFace& face);

struct RegionThickness {
  Region region = Region::none;
  std::size_t count = 0;  ///< vertices with a shortest distance
  double mean_mm = 0, median_mm = 0, low_mm = 0, high_mm = 0;  ///< 5 and 95 %
  double normal_mean_mm = 0;  ///< along the normal, where it meets bone; NaN where none does
};
std::vector<RegionThickness> thickness_by_region(const Thickness& thickness);

}  // namespace hyperex::ct
