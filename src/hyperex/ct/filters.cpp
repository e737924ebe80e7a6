// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/filters.hpp"

#include <algorithm>

#include "hyperex/ct/itk_library.hpp"

namespace hyperex::ct {
namespace {

ItkGrid for_itk(const Grid& grid) {
  return {grid.size, {1e3 * grid.spacing_m[0], 1e3 * grid.spacing_m[1], 1e3 * grid.spacing_m[2]}};
}

}  // namespace

Grid grid_of(const Volume& volume) {
  return {volume.size, volume.spacing_m()};
}

Pieces pieces_of(const Mask& mask, const Grid& grid, bool corners) {
  Pieces out;
  itk_library().pieces(mask, for_itk(grid), corners, out.number, out.count);
  return out;
}

std::vector<float> distance_to(const Mask& mask, const Grid& grid) {
  std::vector<float> out = itk_library().signed_distance_mm(mask, for_itk(grid));
  // ITK counts from the mask's outermost values, and negative ones within.
  for (float& d : out) d = std::max(0.0F, d) * 1e-3F;
  return out;
}

Mask watershed(const Mask& level, const Mask& markers, const Grid& grid) {
  return itk_library().watershed(level, markers, for_itk(grid));
}

}  // namespace hyperex::ct
