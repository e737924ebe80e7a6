// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/field/frontal.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <utility>

namespace hyperex::tissue {
namespace {
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using Delaunay =
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase>>;
using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

struct FrontalField::Plane {
  Eigen::MatrixX2d points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> edges;  // of the hull; all, where the points lie on a line

  explicit Plane(const Eigen::MatrixX2d& given) : points(given) {
    std::vector<std::pair<Kernel::Point_2, int>> list;
    for (Eigen::Index i = 0; i < points.rows(); ++i)
      list.emplace_back(Kernel::Point_2(points(i, 0), points(i, 1)), int(i));
    const Delaunay delaunay(list.begin(), list.end());
    for (auto f = delaunay.finite_faces_begin(); f != delaunay.finite_faces_end(); ++f)
      triangles.push_back({f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()});
    for (auto e = delaunay.finite_edges_begin(); e != delaunay.finite_edges_end(); ++e) {
      const bool inner = delaunay.dimension() == 2 && !delaunay.is_infinite(e->first) &&
                         !delaunay.is_infinite(e->first->neighbor(e->second));
      if (!inner)
        edges.push_back({e->first->vertex(Delaunay::cw(e->second))->info(),
                         e->first->vertex(Delaunay::ccw(e->second))->info()});
    }
  }

  Vector2d point(int i) const { return points.row(i); }

  double at(const Vector2d& p, const Eigen::VectorXd& values) const {
    for (const auto& [a, b, c] : triangles) {
      const double area = cross(point(b) - point(a), point(c) - point(a));
      const double wb = cross(p - point(a), point(c) - point(a)) / area;
      const double wc = cross(point(b) - point(a), p - point(a)) / area;
      constexpr double slack = -1e-12;
      if (wb >= slack && wc >= slack && wb + wc <= 1 - slack)
        return (1 - wb - wc) * values[a] + wb * values[b] + wc * values[c];
    }
    double best = std::numeric_limits<double>::infinity(), value = values[0];
    for (const auto& [a, b] : edges) {
      const Vector2d along = point(b) - point(a);
      const double t = std::clamp((p - point(a)).dot(along) / along.squaredNorm(), 0.0, 1.0);
      const double d = (p - point(a) - t * along).squaredNorm();
      if (d < best) {
        best = d;
        value = (1 - t) * values[a] + t * values[b];
      }
    }
    return value;
  }
};

FrontalField::FrontalField(const Eigen::MatrixX2d& points) {
  planes_.push_back(std::make_unique<Plane>(points));
  Eigen::MatrixX2d mirrored = points;
  mirrored.col(0) *= -1;
  planes_.push_back(std::make_unique<Plane>(mirrored));
}

FrontalField::~FrontalField() = default;

Eigen::VectorXd FrontalField::at(const Eigen::MatrixX2d& places,
                                 const Eigen::VectorXd& values) const {
  const double low = values.minCoeff(), high = values.maxCoeff();
  Eigen::VectorXd out(places.rows());
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const Vector2d p = places.row(i), mirrored(-p.x(), p.y());
    const double mean = (planes_[0]->at(p, values) + planes_[1]->at(mirrored, values)) / 2;
    out[i] = std::clamp(mean, low, high);
  }
  return out;
}

}  // namespace hyperex::tissue
