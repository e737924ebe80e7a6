// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/skin_view.hpp"

#include <map>
#include <numeric>
#include <stdexcept>
#include <tuple>

namespace hyperex::report {
namespace {

/// Texture coordinates of a skin vertex in one scan triangle. Corners are identified by their
/// places: on a seam a scan may hold one vertex several times.
Eigen::RowVector2f uv_in_triangle(const simulate::Performance& performance, const io::Scan& scan,
                                  int triangle, int vertex) {
  const auto uv_at = [&](int scan_vertex) -> Eigen::RowVector2f {
    const Points& points = scan.mesh.points;
    for (int k = 0; k < 3; ++k)
      if (const int corner = scan.mesh.triangles(triangle, k);
          corner == scan_vertex || points.row(corner) == points.row(scan_vertex))
        return scan.corner_uv.row(3 * triangle + k);
    throw std::invalid_argument("skin_view: the performance's triangles are not the scan's");
  };
  if (vertex < performance.scan_vertices) return uv_at(vertex);
  const EdgePoint& on = performance.appended.at(vertex - performance.scan_vertices);
  const Eigen::RowVector2f a = uv_at(on.a);
  return on.t == 0 ? a : a + static_cast<float>(on.t) * (uv_at(on.b) - a);
}

}  // namespace

SkinView skin_view(const simulate::Performance& performance, const io::Scan& scan) {
  const TriMesh& skin = performance.skin_rest;
  SkinView view;
  view.triangles = skin.triangles;
  if (scan.corner_uv.rows() == 0 || !scan.texture) {
    view.skin_vertex.resize(skin.points.rows());
    std::iota(view.skin_vertex.begin(), view.skin_vertex.end(), 0);
    return view;
  }
  if (scan.corner_uv.rows() != 3 * scan.mesh.triangles.rows() ||
      performance.source_triangle.size() != static_cast<std::size_t>(skin.triangles.rows()) ||
      performance.scan_vertices != scan.mesh.points.rows())
    throw std::invalid_argument("skin_view: the performance's triangles are not the scan's");
  std::map<std::tuple<int, float, float>, int> known;
  std::vector<float> uv;
  for (Eigen::Index f = 0; f < skin.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::RowVector2f corner =
          uv_in_triangle(performance, scan, performance.source_triangle[f], skin.triangles(f, k));
      const auto next = static_cast<int>(view.skin_vertex.size());
      const auto [at, fresh] =
          known.try_emplace({skin.triangles(f, k), corner[0], corner[1]}, next);
      if (fresh) {
        view.skin_vertex.push_back(skin.triangles(f, k));
        uv.insert(uv.end(), {corner[0], corner[1]});
      }
      view.triangles(f, k) = at->second;
    }
  }
  view.uv = Eigen::Map<decltype(view.uv)>(uv.data(), static_cast<Eigen::Index>(uv.size() / 2), 2);
  return view;
}

Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 4, Eigen::RowMajor> skin_colour(
    const simulate::Performance& performance, const io::Scan& scan) {
  Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 4, Eigen::RowMajor> colour(0, 4);
  if (scan.vertex_colour.rows() == 0) return colour;
  if (scan.vertex_colour.rows() != performance.scan_vertices)
    throw std::invalid_argument("skin_colour: the performance's vertices are not the scan's");
  colour.resize(performance.skin_rest.points.rows(), 4);
  colour.topRows(performance.scan_vertices) = scan.vertex_colour;
  for (std::size_t i = 0; i < performance.appended.size(); ++i) {
    const EdgePoint& on = performance.appended[i];
    const auto a = scan.vertex_colour.row(on.a).cast<double>();
    const auto b = scan.vertex_colour.row(on.b).cast<double>();
    colour.row(performance.scan_vertices + static_cast<Eigen::Index>(i)) =
        ((1 - on.t) * a + on.t * b).array().round().cast<std::uint8_t>();
  }
  return colour;
}

PointsF vertex_normals(const PointsF& points, const Triangles& triangles) {
  PointsF normals = PointsF::Zero(points.rows(), 3);
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const Eigen::RowVector3f a = points.row(triangles(f, 0));
    const Eigen::RowVector3f b = points.row(triangles(f, 1));
    const Eigen::RowVector3f c = points.row(triangles(f, 2));
    const Eigen::RowVector3f twice_area = (b - a).cross(c - a);
    for (int k = 0; k < 3; ++k) normals.row(triangles(f, k)) += twice_area;
  }
  for (Eigen::Index v = 0; v < normals.rows(); ++v) {
    const float length = normals.row(v).norm();
    if (length > 0)
      normals.row(v) /= length;
    else
      normals.row(v) << 0, 0, 1;
  }
  return normals;
}

}  // namespace hyperex::report
