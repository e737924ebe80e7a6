// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Filters of ITK on the values of a Volume. They see the lengths of its steps, not the angles
// between them.
#include <array>
#include <vector>

#include "hyperex/ct/volume.hpp"

namespace hyperex::ct {

/// Size and spacing of a grid.
struct Grid {
  std::array<int, 3> size{};
  Vec3 spacing_m = Vec3::Ones();
};
Grid grid_of(const Volume& volume);

/// Connected pieces of a mask: a number per value, 0 outside; 1 is the largest piece, and so on.
struct Pieces {
  std::vector<int> number;
  std::vector<std::size_t> count;  ///< values in each piece; count[0] is 0
};
/// `corners`: values that share only an edge or a corner are connected too.
Pieces pieces_of(const Mask& mask, const Grid& grid, bool corners = false);

/// Distance (m) of each value from the nearest value of the mask; 0 on it. Exact (C. Maurer, R. Qi,
/// V. Raghavan, IEEE PAMI 25, 2003, 265). The mask must not be empty.
std::vector<float> distance_to(const Mask& mask, const Grid& grid);

/// Watershed from markers (S. Beucher and F. Meyer, 1993): each value gets the marker whose flood
/// reaches it at the lowest level. `markers`: 0 where there is none.
Mask watershed(const Mask& level, const Mask& markers, const Grid& grid);

}  // namespace hyperex::ct
