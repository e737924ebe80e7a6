// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/render/render.hpp"

namespace hyperex::sample {

struct ScanFlaws {
  double edge_m = 0.0016;   ///< edges of the scan's triangles
  double noise_m = 0.0002;  ///< standard deviation of each vertex along its normal
  double hole_radius_m = 0.005;
  int holes = 3;              ///< forehead, right cheek, left jaw; at most 3
  double ragged_share = 0.3;  ///< of the border's vertices, whose triangles break off; four rounds
};

/// A scan with the faults of a real scanner, and its true position.
struct FlawedScan {
  TriMesh mesh;  ///< metres, in the scanner's frame
  render::VertexColours colours;
  Eigen::Isometry3d scan_from_face;
  io::Landmarks landmarks;  ///< their true positions, in the scanner's frame
};

/// A scan of `face` with faults: triangles join the lips across the slit, the border is ragged,
/// there are holes and noise. Its triangles are not those of the face, and its axes are the
/// scanner's (z up, 0.4 m off). The result is always the same.
FlawedScan flawed_scan(const anatomy::EmbeddedFace& face, const ScanFlaws& flaws = {});

}  // namespace hyperex::sample
