// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::report {

/// The skin in the form that graphics hardware needs: one texture coordinate per vertex, so
/// vertices on a seam of the texture are split. Without texture coordinates it is the skin itself.
struct SkinView {
  std::vector<int> skin_vertex;  ///< per view vertex, its vertex of skin_rest
  Triangles triangles;           ///< over view vertices, in the order of skin_rest.triangles
  Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor> uv;  ///< per view vertex; may be empty
};

/// Splits vertices if `scan` has both texture coordinates and a texture. Texture coordinates at
/// vertices added by the cut are interpolated in the scan's triangle. Throws std::invalid_argument
/// where performance and scan do not belong together (other triangles).
SkinView skin_view(const simulate::Performance& performance, const io::Scan& scan);

/// RGBA (sRGB) of each vertex of skin_rest, interpolated along the scan's edges at vertices added
/// by the cut; 0 rows if the scan has no colours.
Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 4, Eigen::RowMajor> skin_colour(
    const simulate::Performance& performance, const io::Scan& scan);

/// Unit vertex normals weighted by area; +z where a vertex has no triangle.
PointsF vertex_normals(const PointsF& points, const Triangles& triangles);

}  // namespace hyperex::report
