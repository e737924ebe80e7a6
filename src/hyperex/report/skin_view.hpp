// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::report {

/// The skin as graphics hardware wants it: one texture coordinate a vertex, so that vertices on a
/// seam of the texture are split. Without texture coordinates it is the skin itself.
struct SkinView {
  std::vector<int> skin_vertex;  ///< per view vertex, its vertex of skin_rest
  Triangles triangles;           ///< over view vertices, in the order of skin_rest.triangles
  Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor> uv;  ///< per view vertex; may be empty
};

/// Splits where `scan` has both texture coordinates and a texture; those of vertices on the cut lie
/// between those of the scan triangle's corners. Throws std::invalid_argument
/// where performance and scan do not belong together (other triangles).
SkinView skin_view(const simulate::Performance& performance, const io::Scan& scan);

/// RGBA (sRGB) of each vertex of skin_rest, on the cut between those of the scan's edge; 0 rows
/// where the scan has none.
Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 4, Eigen::RowMajor> skin_colour(
    const simulate::Performance& performance, const io::Scan& scan);

/// Unit vertex normals weighted by area; +z where a vertex has no triangle.
PointsF vertex_normals(const PointsF& points, const Triangles& triangles);

}  // namespace hyperex::report
