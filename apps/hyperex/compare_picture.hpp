// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/render/image.hpp"

namespace hyperex::cli {

/// A surface coloured by distance, from the front and three-quarter.
struct ComparePicture {
  const TriMesh& surface;
  const Eigen::VectorXd&
      distance_m;                ///< of its first vertices; those beyond take their neighbours'
  std::vector<int> framed = {};  ///< vertices to fill the picture with; all where empty
  Eigen::Matrix3d face_from_scan = Eigen::Matrix3d::Identity();  ///< rows: left, up, forward
  std::string title = {}, note = {};
  double top_mm = 1;  ///< about where the colour bar ends (rounded up)
};

render::Image draw(const ComparePicture& picture);

}  // namespace hyperex::cli
