// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::metrics {

/// Per vertex, how far apart two performances of one skin are at the same times (m). `change`
/// says which moves more: |u_b| - |u_a| at the peak, below 0 where b moves less.
struct VariantDifference {
  Eigen::VectorXd greatest_m;  ///< over all frames
  Eigen::VectorXd at_peak_m;   ///< at the given frame
  Eigen::VectorXd rms_m;       ///< root mean square over all frames
  Eigen::VectorXd change_at_peak_m;
  std::vector<double> frame_rms_m, frame_max_m;  ///< over the vertices, a frame
};

/// `a`, `b`: displacements of the same vertices (m), a frame each at the same times. Throws
/// std::invalid_argument where numbers of frames or vertices differ, there is no frame, or
/// `peak_frame` is none.
VariantDifference variant_difference(const std::vector<PointsF>& a, const std::vector<PointsF>& b,
                                     int peak_frame);

/// The greatest displacement of any vertex in any frame, m; 0 where there is none.
double greatest_displacement_m(const std::vector<PointsF>& frames);

/// Share of the summed squared distance that lies within `radius_m` (straight, at rest) of a closed
/// line through `outline`, which one point alone may be:  sum_near w d^2 / sum w d^2. `weight`: a
/// value per vertex, such as vertex_areas(), so that the share does not depend on where the mesh is
/// fine; empty: all vertices alike. NaN where all distances are 0. Throws std::invalid_argument
/// where sizes differ or there is no line.
double share_within(const Eigen::VectorXd& distance, const Points& rest, const Points& outline,
                    double radius_m, const Eigen::VectorXd& weight = {});

/// A third of the area of the triangles around each vertex, m^2.
Eigen::VectorXd vertex_areas(const TriMesh& mesh);

}  // namespace hyperex::metrics
