// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::metrics {

/// Distance (m) between the positions of each vertex in two performances of the same skin at the
/// same times. `change_at_peak_m` is |u_b| - |u_a| at the peak, negative if the vertex moves less
/// in b.
struct VariantDifference {
  Eigen::VectorXd greatest_m;  ///< maximum over all frames
  Eigen::VectorXd at_peak_m;   ///< at the given frame
  Eigen::VectorXd rms_m;       ///< root mean square over all frames
  Eigen::VectorXd change_at_peak_m;
  std::vector<double> frame_rms_m, frame_max_m;  ///< over all vertices, one value per frame
};

/// `a`, `b`: displacements of the same vertices (m), one entry per frame, at the same times. Throws
/// std::invalid_argument if the numbers of frames or vertices differ, if there is no frame, or if
/// `peak_frame` is out of range.
VariantDifference variant_difference(const std::vector<PointsF>& a, const std::vector<PointsF>& b,
                                     int peak_frame);

/// The greatest displacement of any vertex in any frame, m; 0 where there is none.
double greatest_displacement_m(const std::vector<PointsF>& frames);

/// Share of the sum of squared distances that lies near a line: sum_near w d^2 / sum w d^2. Near
/// means within `radius_m` (straight-line distance at rest) of the closed line through `outline`,
/// which may be a single point. `weight`: one value per vertex, such as vertex_areas(), which makes
/// the share independent of the local mesh density; empty: equal weights. NaN if all distances are
/// 0. Throws std::invalid_argument if sizes differ or if there is no line.
double share_within(const Eigen::VectorXd& distance, const Points& rest, const Points& outline,
                    double radius_m, const Eigen::VectorXd& weight = {});

/// Area associated with each vertex, m^2: a third of the area of the triangles around it.
Eigen::VectorXd vertex_areas(const TriMesh& mesh);

}  // namespace hyperex::metrics
