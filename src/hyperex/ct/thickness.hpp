// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/ct/find_points.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::ct {

/// Parts of the face, by heights and widths around nose tip and chin.
enum class Region : std::uint8_t { none, forehead, nose, cheek_right, cheek_left, lips, chin };
const char* name_of(Region region);

/// Where on the skin a thickness of the face is meant.
struct FaceBounds {
  double back_z_m = 0;  ///< no skin behind this: the mandible's back, at the ears
  double low_y_m = 0;   ///< no skin below this: 5 mm under the chin's bone
};

/// One value per vertex of the skin; NaN where there is none.
struct Thickness {
  Eigen::VectorXd shortest_m;      ///< to the nearest place of a bone
  Eigen::VectorXd along_normal_m;  ///< from the vertex inwards along its normal, to the first bone
  std::vector<Region> region;
};

constexpr double kMostThickness_m = 0.05;

/// Distances from the skin to `bone`, up to kMostThickness_m. Normals are area-weighted means of
/// the triangles around a vertex.
Thickness measure_thickness(const TriMesh& skin, const TriMesh& bone, const FaceBounds& bounds,
                            const FoundPoints& points);

/// Behind the mandible and below it there is none to measure; where there is no mandible, behind
/// the middle of the skull.
FaceBounds face_bounds(const TriMesh& skull, const TriMesh& mandible);

}  // namespace hyperex::ct
