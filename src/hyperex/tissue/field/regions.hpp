// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "hyperex/anatomy/register_face.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/tissue/field/facial_regions.hpp"
#include "hyperex/tissue/mesh/side_tree.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::tissue {

/// The position of each vertex of a skin on the canonical face registered to it.
class RegionMap {
 public:
  RegionMap(const TissueMesh& mesh, const io::Landmarks& landmarks,
            const anatomy::RegisteredFace& face);

  /// The signed distance of each skin vertex from the region's border, m: positive inside, negative
  /// outside. is_region(`name`) must hold. The border of a region lies between the canonical
  /// vertices inside and outside of it; the border of a half also follows the midline. Skin farther
  /// than 10 mm from the canonical face is outside of all regions.
  Eigen::VectorXd depth(const std::string& name) const;

 private:
  TriMesh open_;  // the registered face, eyes and mouth open
  std::vector<PlaceOnMesh> foot_;
  Eigen::VectorXd lateral_m_;  // per skin vertex: towards the subject's left, on the canonical face
};

/// The signed distance (m) of each vertex from the border of a band of `width_m` around a line,
/// positive inside. The line consists of straight segments between the points, projected onto the
/// nearest skin.
Eigen::VectorXd band_depth(const TriMesh& skin, const std::vector<Vec3>& line, double width_m);

/// The share from 0 (outside) to 1 (inside), smooth (3 s^2 - 2 s^3) over a width of `blend_m`
/// centred on the border.
double region_share(double depth_m, double blend_m);

}  // namespace hyperex::tissue
