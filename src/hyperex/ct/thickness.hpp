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

/// Where on the skin a thickness of the face is meant: in front of the mandible's back, and above a
/// line in profile, 5 mm under the lower edge of the jaw from its angles to the chin.
struct FaceBounds {
  double back_z_m = 0;
  double chin_z_m = 0, chin_y_m = 0;  ///< the line's front end
  double rise = 0;                    ///< of the line towards the back, m per m
  bool holds(const Vec3& p) const {
    return p.z() >= back_z_m && p.y() >= chin_y_m + rise * (chin_z_m - p.z());
  }
};

/// One value per vertex of the skin; NaN where there is none.
struct Thickness {
  Eigen::VectorXd shortest_m;      ///< to the nearest place of a bone
  Eigen::VectorXd along_normal_m;  ///< from the vertex inwards along its normal, to the first bone
  std::vector<Region> region;
};

constexpr double kMostThickness_m = 0.05;

/// Distances from the skin to `bone`, up to kMostThickness_m. Normals are area-weighted means of
/// the triangles around a vertex, three times averaged with their neighbours.
Thickness measure_thickness(const TriMesh& skin, const TriMesh& bone, const FaceBounds& bounds,
                            const FoundPoints& points);

/// The bounds by the back of the mandible, the lowest place of its front 30 mm and that of its back
/// 30 mm. Without a mandible: by the middle of the skull and its lowest place.
FaceBounds face_bounds(const TriMesh& skull, const TriMesh& mandible);

}  // namespace hyperex::ct
