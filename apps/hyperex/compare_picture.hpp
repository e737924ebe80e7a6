// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/render/image.hpp"

namespace hyperex::cli {

/// A surface coloured by distance, drawn from the front and in three-quarter view.
struct ComparePicture {
  const TriMesh& surface;
  /// Distances of the first vertices of the surface. Every other vertex gets the mean of those of
  /// its neighbours that have one.
  const Eigen::VectorXd& distance_m;
  std::vector<int> framed = {};  ///< vertices that fill the picture; empty: all
  Eigen::Matrix3d face_from_scan = Eigen::Matrix3d::Identity();  ///< rows: left, up, forward
  std::string title = {}, note = {};
  double top_mm = 1;  ///< the colour bar ends near this value (rounded up)
};

render::Image draw(const ComparePicture& picture);

}  // namespace hyperex::cli
