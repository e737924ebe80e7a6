// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/thinned_scan.hpp"

#include <limits>
#include <numeric>

#include "hyperex/report/skin_view.hpp"
#include "hyperex/simulate/performance.hpp"

namespace hyperex::session {
namespace {

using Eigen::Index;

/// The skin before thinning as outputs expect it.
simulate::Performance at_rest(const tissue::FullSkin& full) {
  simulate::Performance rest;
  rest.skin_rest = full.skin;
  rest.scan_vertices = full.scan_vertices;
  rest.appended = full.appended;
  rest.source_triangle = full.source_triangle;
  return rest;
}

bool is_textured(const io::Scan& scan) {
  return scan.corner_uv.rows() > 0 && scan.texture.has_value();
}

/// Finds those texture coordinates of a vertex that are nearest to `old`, so that a moved corner of
/// a triangle stays in its part of the texture.
class CornerUv {
 public:
  explicit CornerUv(const report::SkinView& view) : view_(view) {
    for (std::size_t i = 0; i < view.skin_vertex.size(); ++i) {
      const auto v = std::size_t(view.skin_vertex[i]);
      if (v >= of_vertex_.size()) of_vertex_.resize(v + 1);
      of_vertex_[v].push_back(Index(i));
    }
  }
  Eigen::RowVector2f nearest(int vertex, const Eigen::RowVector2f& old) const {
    Eigen::RowVector2f best = old;
    float least = std::numeric_limits<float>::infinity();
    if (std::size_t(vertex) < of_vertex_.size())
      for (const Index i : of_vertex_[std::size_t(vertex)])
        if (const float d = (view_.uv.row(i) - old).squaredNorm(); d < least) {
          least = d;
          best = view_.uv.row(i);
        }
    return best;
  }

 private:
  const report::SkinView& view_;
  std::vector<std::vector<Index>> of_vertex_;
};

}  // namespace

std::vector<char> on_seams(const io::Scan& scan) {
  if (!is_textured(scan)) return {};
  // Files repeat the vertices of a seam, some repeat every vertex for each of its triangles.
  const std::vector<int> place = first_at_same_place(scan.mesh.points);
  std::vector<Index> first_corner(place.size(), -1);
  std::vector<char> seam(place.size(), 0);
  for (Index f = 0; f < scan.mesh.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto v = std::size_t(place[std::size_t(scan.mesh.triangles(f, k))]);
      if (first_corner[v] < 0) first_corner[v] = 3 * f + k;
      if (scan.corner_uv.row(first_corner[v]) != scan.corner_uv.row(3 * f + k)) seam[v] = 1;
    }
  for (std::size_t v = 0; v < place.size(); ++v) seam[v] = seam[std::size_t(place[v])];
  return seam;
}

tissue::FullSkin skin_before_thinning(const io::Scan& scan, const CleanMesh& clean,
                                      const ThinMesh& thin) {
  tissue::FullSkin full;
  full.skin = scan.mesh;
  // Files repeat vertices, on seams or everywhere. Triangles have to name those that are kept.
  for (Index f = 0; f < clean.mesh.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      full.skin.triangles(clean.source_triangle[std::size_t(f)], k) =
          clean.source_vertex[std::size_t(clean.mesh.triangles(f, k))];
  full.scan_vertices = scan.mesh.points.rows();
  full.source_triangle.resize(std::size_t(scan.mesh.triangles.rows()));
  std::iota(full.source_triangle.begin(), full.source_triangle.end(), 0);
  for (const int v : thin.source_vertex) full.kept.push_back(clean.source_vertex[std::size_t(v)]);
  for (const int f : thin.source_triangle)
    full.kept_triangle.push_back(clean.source_triangle[std::size_t(f)]);
  return full;
}

io::Scan thinned_scan(const io::Scan& scan, const tissue::FullSkin& full, const TriMesh& thinned) {
  io::Scan out;
  out.file = scan.file;
  out.unit = scan.unit;
  out.unit_guessed = scan.unit_guessed;
  out.texture = scan.texture;
  out.mesh = thinned;
  const simulate::Performance rest = at_rest(full);
  if (const auto colour = report::skin_colour(rest, scan); colour.rows() > 0) {
    out.vertex_colour.resize(thinned.points.rows(), 4);
    for (std::size_t v = 0; v < full.kept.size(); ++v)
      out.vertex_colour.row(Index(v)) = colour.row(full.kept[v]);
  }
  if (!is_textured(scan)) return out;
  const report::SkinView view = report::skin_view(rest, scan);
  const CornerUv corners(view);
  out.corner_uv.resize(3 * thinned.triangles.rows(), 2);
  for (Index f = 0; f < thinned.triangles.rows(); ++f) {
    const int old = full.kept_triangle[std::size_t(f)];
    for (int k = 0; k < 3; ++k)
      out.corner_uv.row(3 * f + k) = corners.nearest(
          full.kept[std::size_t(thinned.triangles(f, k))], view.uv.row(view.triangles(old, k)));
  }
  return out;
}

void keep_thinned(tissue::TissueField& field, const tissue::FullSkin& full) {
  const auto keep = [&](tissue::SkinField& of_skin) {
    for (Eigen::VectorXd& values : of_skin)
      if (values.size() > 0) values = Eigen::VectorXd(values(full.kept));
  };
  keep(field.skin);
  for (tissue::SkinField& under : field.deeper) keep(under);
  if (field.skin_volume_ratio.size() > 0)
    field.skin_volume_ratio = Eigen::VectorXd(field.skin_volume_ratio(full.kept));
}

Eigen::MatrixXf on_full_skin(const tissue::FullSkin& full, const Eigen::MatrixXf& thinned) {
  Eigen::MatrixXf out(Index(full.places.size()), thinned.cols());
  for (std::size_t v = 0; v < full.places.size(); ++v) {
    const MeshPlace& place = full.places[v];
    out.row(Index(v)).setZero();
    for (int k = 0; k < 3; ++k)
      out.row(Index(v)) += float(place.weight[k]) * thinned.row(place.vertex[std::size_t(k)]);
  }
  return out;
}

}  // namespace hyperex::session
