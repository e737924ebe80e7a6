// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "hyperex/anatomy/register_face.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/tissue/mesh/side_tree.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::tissue {

/// A named part of the face, alike on both sides (data/regions.csv).
struct FacialRegion {
  std::string name, meaning;
  std::vector<int> vertices;  ///< of the canonical face
};
const std::vector<FacialRegion>& facial_regions();
/// Whether `name` is that of a region, alone or with _L or _R.
bool is_region(const std::string& name);

/// Where each vertex of a skin lies on the canonical face laid over it.
class RegionMap {
 public:
  RegionMap(const TissueMesh& mesh, const io::Landmarks& landmarks,
            const anatomy::RegisteredFace& face);

  /// Per skin vertex the distance from the region's border, m: above 0 inside, below 0 outside.
  /// `name` is one that is_region() knows. A region's border runs between canonical vertices inside
  /// and outside, that of a half along the middle of the face; skin farther than 10 mm from the
  /// canonical face is outside of all regions.
  Eigen::VectorXd depth(const std::string& name) const;

 private:
  TriMesh open_;  // the registered face, eyes and mouth open
  std::vector<PlaceOnMesh> foot_;
  Eigen::VectorXd lateral_m_;  // per skin vertex: towards the subject's left, on the canonical face
};

/// Per vertex the distance (m) from the border of a band of `width_m` about a line, above 0 inside.
/// The line is straight between the points and projected onto the nearest skin.
Eigen::VectorXd band_depth(const TriMesh& skin, const std::vector<Vec3>& line, double width_m);

/// 0 outside to 1 inside, smooth (3 s^2 - 2 s^3) over `blend_m` about the border.
double region_share(double depth_m, double blend_m);

}  // namespace hyperex::tissue
