// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/variant_difference.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hyperex/geometry/closed_line.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::metrics {
VariantDifference variant_difference(const std::vector<PointsF>& a, const std::vector<PointsF>& b,
                                     int peak_frame) {
  if (a.size() != b.size() || a.empty())
    throw std::invalid_argument("variant_difference: as many frames of both are needed");
  if (peak_frame < 0 || static_cast<size_t>(peak_frame) >= a.size())
    throw std::invalid_argument("variant_difference: no such frame for the peak");
  const Eigen::Index vertices = a.front().rows();
  VariantDifference out;
  out.greatest_m = out.rms_m = Eigen::VectorXd::Zero(vertices);
  for (size_t f = 0; f < a.size(); ++f) {
    if (a[f].rows() != vertices || b[f].rows() != vertices)
      throw std::invalid_argument("variant_difference: as many vertices of both are needed");
    const Eigen::VectorXd apart = (b[f].cast<double>() - a[f].cast<double>()).rowwise().norm();
    out.greatest_m = out.greatest_m.cwiseMax(apart);
    out.rms_m += apart.cwiseAbs2();
    out.frame_rms_m.push_back(std::sqrt(apart.squaredNorm() / double(vertices)));
    out.frame_max_m.push_back(vertices > 0 ? apart.maxCoeff() : 0);
    if (static_cast<int>(f) != peak_frame) continue;
    out.at_peak_m = apart;
    out.change_at_peak_m =
        b[f].cast<double>().rowwise().norm() - a[f].cast<double>().rowwise().norm();
  }
  out.rms_m = (out.rms_m / double(a.size())).cwiseSqrt();
  return out;
}

double greatest_displacement_m(const std::vector<PointsF>& frames) {
  float most = 0;
  for (const PointsF& frame : frames)
    if (frame.rows() > 0) most = std::max(most, frame.rowwise().norm().maxCoeff());
  return double(most);
}

double share_within(const Eigen::VectorXd& distance, const Points& rest, const Points& outline,
                    double radius_m, const Eigen::VectorXd& weight) {
  if (distance.size() != rest.rows() || (weight.size() != 0 && weight.size() != rest.rows()))
    throw std::invalid_argument("share_within: a distance and a weight a vertex are needed");
  if (outline.rows() == 0) throw std::invalid_argument("share_within: a line is needed");
  double near = 0, all = 0;
  for (Eigen::Index i = 0; i < distance.size(); ++i) {
    const double part = (weight.size() ? weight[i] : 1) * distance[i] * distance[i];
    all += part;
    if (distance_to_closed_line(rest.row(i), outline) <= radius_m) near += part;
  }
  return near / all;
}

Eigen::VectorXd vertex_areas(const TriMesh& mesh) {
  const Eigen::VectorXd area = triangle_areas(mesh);
  Eigen::VectorXd out = Eigen::VectorXd::Zero(mesh.points.rows());
  for (Eigen::Index f = 0; f < area.size(); ++f)
    for (int k = 0; k < 3; ++k) out[mesh.triangles(f, k)] += area[f] / 3;
  return out;
}

}  // namespace hyperex::metrics
