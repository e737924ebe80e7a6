// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/triangulate.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <map>
#include <set>

#include "hyperex/anatomy/lips.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"

namespace hyperex::simulate {
namespace {
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
struct PointRow {
  int row = -1;  // of the points; below 0 where two contours cross
};
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<PointRow, Kernel>;
using Data =
    CGAL::Triangulation_data_structure_2<Vertex,
                                         CGAL::Constrained_triangulation_face_base_2<Kernel>>;
// Crossing contours (points of bad tracking) are resolved rather than refused: triangles at a
// crossing, which is no tracked point, are left out.
using Delaunay =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Data, CGAL::Exact_predicates_tag>;

/// Closed contours by iBUG-68 number; the bool says that its inside is an opening.
const std::vector<std::pair<std::vector<int>, bool>>& contours() {
  static const std::vector<std::pair<std::vector<int>, bool>> list = {
      {{36, 37, 38, 39, 40, 41}, true},
      {{42, 43, 44, 45, 46, 47}, true},
      {{60, 61, 62, 63, 64, 65, 66, 67}, true},
      {{48, 49, 50, 51, 52, 53, 54, 55, 56, 57, 58, 59}, false}};
  return list;
}
}  // namespace

Triangles triangulate_points(const std::vector<std::string>& names, const Points& rest,
                             const face::FaceFrame& frame) {
  Delaunay plane;
  std::map<std::string, Delaunay::Vertex_handle> by_name;
  // The lower face is drawn 10 mm further down, so that touching or crossing lips come apart.
  constexpr double apart_m = 0.010;
  for (Eigen::Index i = 0; i < rest.rows(); ++i) {
    const Vec3 q = frame.local(rest.row(i));
    const int lip = anatomy::lip_of(names[i]);
    const bool lower = lip < 0 || (lip == 0 && q.y() < -0.012);
    const auto v = plane.insert({q.x(), q.y() - (lower ? apart_m : 0)});
    v->info().row = static_cast<int>(i);
    by_name[names[i]] = v;
  }
  std::vector<std::set<int>> openings;
  for (const auto& [numbers, is_opening] : contours()) {
    std::vector<Delaunay::Vertex_handle> ring;
    for (int k : numbers)
      if (const auto it = by_name.find(face::ibug(k)); it != by_name.end())
        ring.push_back(it->second);
    if (ring.size() != numbers.size()) continue;
    for (std::size_t i = 0; i < ring.size(); ++i)
      plane.insert_constraint(ring[i], ring[(i + 1) % ring.size()]);
    if (!is_opening) continue;
    openings.emplace_back();
    for (const auto v : ring) openings.back().insert(v->info().row);
  }
  std::vector<std::array<int, 3>> kept;
  for (auto f = plane.finite_faces_begin(); f != plane.finite_faces_end(); ++f) {
    const std::array<int, 3> t{f->vertex(0)->info().row, f->vertex(1)->info().row,
                               f->vertex(2)->info().row};
    bool inside = t[0] < 0 || t[1] < 0 || t[2] < 0;
    for (const auto& ring : openings)
      inside |= ring.count(t[0]) && ring.count(t[1]) && ring.count(t[2]);
    if (!inside) kept.push_back(t);
  }
  Triangles out(kept.size(), 3);
  for (std::size_t i = 0; i < kept.size(); ++i) out.row(i) << kept[i][0], kept[i][1], kept[i][2];
  return out;
}

}  // namespace hyperex::simulate
