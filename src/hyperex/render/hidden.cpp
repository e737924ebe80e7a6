// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/render/hidden.hpp"

#include <algorithm>

#include "hyperex/render/ray_scene.hpp"

namespace hyperex::render {

namespace {

/// Maps rays through the origin to parallels of z and keeps planes plane:
///   (x, y, z) -> (r x / z, r y / z, r^2 / z).
/// At z = r it keeps lengths.
Points straightened(const Points& points, double r) {
  Points out(points.rows(), 3);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const double share = r / std::max(points(i, 2), 1e-3);
    out.row(i) << share * points(i, 0), share * points(i, 1), share * r;
  }
  return out;
}

}  // namespace

std::vector<bool> hidden_from_origin(const TriMesh& mesh, const Points& points, double bias_m) {
  std::vector<bool> hidden(std::size_t(points.rows()), false);
  if (mesh.triangles.rows() == 0 || points.rows() == 0) return hidden;
  const double r = std::max(mesh.points.col(2).mean(), 1e-3);
  const TriMesh straight{straightened(mesh.points, r), mesh.triangles};
  const RayScene scene({Surface{straight}}, Camera{});
  const Points places = straightened(points, r);
  for (Eigen::Index i = 0; i < places.rows(); ++i)
    hidden[std::size_t(i)] = scene.hides(places.row(i).transpose().cast<float>(), float(bias_m));
  return hidden;
}

}  // namespace hyperex::render
