// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace hyperex::study {
namespace {

using Face = std::array<int, 3>;

/// Grid of boxes, each cut into six tetrahedra around its diagonal, then moved by `map` from the
/// unit cube. `faces`: all triangles on x = 1.
struct Grid {
  Points nodes;
  Tetrahedra tets;
  std::vector<Face> right;
};

Grid grid_of(std::array<int, 3> cells, const std::function<Vec3(const Vec3&)>& map) {
  Grid grid;
  const auto node = [&](std::array<int, 3> at) {
    return (at[2] * (cells[1] + 1) + at[1]) * (cells[0] + 1) + at[0];
  };
  grid.nodes.resize((cells[0] + 1) * (cells[1] + 1) * (cells[2] + 1), 3);
  for (int k = 0; k <= cells[2]; ++k)
    for (int j = 0; j <= cells[1]; ++j)
      for (int i = 0; i <= cells[0]; ++i)
        grid.nodes.row(node({i, j, k})) =
            map(Vec3(static_cast<double>(i) / cells[0], static_cast<double>(j) / cells[1],
                     static_cast<double>(k) / cells[2]));
  grid.tets.resize(6 * cells[0] * cells[1] * cells[2], 4);
  constexpr int kPaths[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  int t = 0;
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i)
        for (int p = 0; p < 6; ++p, ++t) {
          std::array<int, 3> at{i, j, k};
          std::vector<int> right;
          for (int corner = 0; corner < 4; ++corner) {
            grid.tets(t, corner) = node(at);
            if (at[0] == cells[0]) right.push_back(node(at));
            if (corner < 3) ++at[kPaths[p][corner]];
          }
          if (p >= 3) std::swap(grid.tets(t, 2), grid.tets(t, 3));
          if (right.size() == 3) grid.right.push_back({right[0], right[1], right[2]});
        }
  return grid;
}

/// Root of the integral of |d - exact|^2 over that of |exact|^2, lumped at the nodes.
double l2_error(const Points& nodes, const Tetrahedra& tets, const Points& d,
                const std::function<Vec3(const Vec3&)>& exact) {
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(nodes.rows());
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    const auto at = [&](int a) -> Vec3 { return nodes.row(tets(t, a)).transpose(); };
    const double volume = (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) / 6;
    for (int a = 0; a < 4; ++a) weight[tets(t, a)] += volume / 4;
  }
  double off = 0, all = 0;
  for (Eigen::Index n = 0; n < nodes.rows(); ++n) {
    const Vec3 u = exact(nodes.row(n).transpose());
    off += weight[n] * (d.row(n).transpose() - u).squaredNorm();
    all += weight[n] * u.squaredNorm();
  }
  return std::sqrt(off / all);
}

void take(Grid grid, Problem& problem) {
  problem.nodes = std::move(grid.nodes);
  problem.tets = std::move(grid.tets);
  problem.loaded = std::move(grid.right);
}

/// Levels of nodes over the triangles of `surface` nodes; each prism cut by the order of its nodes,
/// so that neighbours agree.
Tetrahedra prisms(const std::vector<Face>& triangles, int surface, int levels,
                  const Points& nodes) {
  Tetrahedra tets(3 * static_cast<int>(triangles.size()) * levels, 4);
  int t = 0;
  for (int level = 0; level < levels; ++level)
    for (Face f : triangles) {
      std::sort(f.begin(), f.end());
      for (int k = 0; k < 3; ++k, ++t) {
        int corner = 0;
        for (int i = 0; i <= k; ++i) tets(t, corner++) = level * surface + f[i];
        for (int i = k; i < 3; ++i) tets(t, corner++) = (level + 1) * surface + f[i];
        const auto at = [&](int a) -> Vec3 { return nodes.row(tets(t, a)).transpose(); };
        if ((at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) < 0)
          std::swap(tets(t, 2), tets(t, 3));
      }
    }
  return tets;
}

}  // namespace

Problem cooks_membrane(int cells, double poisson, double reference) {
  Problem p;
  p.name = "cook";
  p.level = cells;
  p.young = 240.565;
  p.poisson = poisson;
  const double depth = 2 * 48.0 / cells;
  take(grid_of({cells, cells, 2},
               [&](const Vec3& x) {
                 const double low = 44 * x[0], high = 44 + 16 * x[0];
                 return Vec3(48 * x[0], low + (high - low) * x[1], depth * x[2]);
               }),
       p);
  p.support = [depth](const Vec3& x) {
    std::array<std::optional<double>, 3> held;
    if (x[0] < 1e-9) held[0] = held[1] = 0;
    if (x[2] < 1e-9 || x[2] > depth - 1e-9) held[2] = 0;
    return held;
  };
  p.traction = [](const Vec3&, const Vec3&) { return Vec3(0, 100.0 / 16, 0); };
  p.error = [cells, reference](const Points& d) {
    double rise = 0;
    for (int k = 0; k < 3; ++k)
      rise += d((k * (cells + 1) + cells / 2) * (cells + 1) + cells, 1) / 3;
    return std::abs(rise / reference - 1);
  };
  return p;
}

Problem bent_beam(int cells, double poisson) {
  Problem p;
  p.name = "beam";
  p.level = cells;
  p.young = 1000;
  p.poisson = poisson;
  const double depth = 2 * 2.0 / cells;
  take(grid_of({5 * cells, cells, 2},
               [&](const Vec3& x) { return Vec3(10 * x[0], 2 * x[1] - 1, depth * x[2]); }),
       p);
  const double length = 10, height = 2, inertia = height * height * height / 12, force = 1;
  const double young = p.young / (1 - poisson * poisson), nu = poisson / (1 - poisson);
  const auto exact = [=](const Vec3& x) {
    const double f = force / (6 * young * inertia), y = x[1];
    return Vec3(
        -f * y * ((6 * length - 3 * x[0]) * x[0] + (2 + nu) * (y * y - height * height / 4)),
        f * (3 * nu * y * y * (length - x[0]) + (4 + 5 * nu) * height * height * x[0] / 4 +
             (3 * length - x[0]) * x[0] * x[0]),
        0);
  };
  p.support = [exact, depth](const Vec3& x) {
    std::array<std::optional<double>, 3> held;
    if (x[0] < 1e-9) {
      held[0] = exact(x)[0];
      held[1] = exact(x)[1];
    }
    if (x[2] < 1e-9 || x[2] > depth - 1e-9) held[2] = 0;
    return held;
  };
  p.traction = [=](const Vec3& x, const Vec3&) {
    return Vec3(0, force / (2 * inertia) * (height * height / 4 - x[1] * x[1]), 0);
  };
  p.error = [nodes = p.nodes, tets = p.tets, exact](const Points& d) {
    return l2_error(nodes, tets, d, exact);
  };
  p.pressure = [=](const Vec3& x) {
    return (1 + poisson) / 3 * force * (length - x[0]) * x[1] / inertia;
  };
  return p;
}

Problem inflated_sphere(int cells, double poisson) {
  Problem p;
  p.name = "sphere";
  p.level = cells;
  p.young = 1;
  p.poisson = poisson;
  const int n = cells, surface = (n + 1) * (n + 2) / 2;
  std::vector<Face> triangles;
  const auto index = [n](int i, int j) { return i * (2 * n + 3 - i) / 2 + j; };
  std::vector<Vec3> direction(surface);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j) {
      // By sines, so that the triangles on the sphere are nearly alike.
      const Vec3 flat = Vec3(i, j, n - i - j) / n;
      direction[index(i, j)] = (flat.array() * M_PI / 2).sin().matrix().normalized();
      if (i + j < n) triangles.push_back({index(i, j), index(i + 1, j), index(i, j + 1)});
      if (i + j + 1 < n)
        triangles.push_back({index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  p.nodes.resize(surface * (n + 1), 3);
  for (int level = 0; level <= n; ++level)
    for (int s = 0; s < surface; ++s)
      p.nodes.row(level * surface + s) =
          (1 + static_cast<double>(level) / n) * direction[s].transpose();
  p.tets = prisms(triangles, surface, n, p.nodes);
  p.loaded = triangles;
  p.support = [](const Vec3& x) {
    std::array<std::optional<double>, 3> held;
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(x[axis]) < 1e-9) held[axis] = 0;
    return held;
  };
  p.traction = [](const Vec3& x, const Vec3& normal) -> Vec3 {
    return normal.dot(x) > 0 ? normal : Vec3(-normal);
  };
  const double bulk = 1 / (3 * (1 - 2 * poisson)), shear = 1 / (2 * (1 + poisson));
  const double swell = 1 / (3 * bulk * 7), shift = 8 / (4 * shear * 7);
  p.error = [nodes = p.nodes, tets = p.tets, swell, shift](const Points& d) {
    return l2_error(nodes, tets, d, [&](const Vec3& x) -> Vec3 {
      return (swell + shift / std::pow(x.norm(), 3)) * x;
    });
  };
  p.pressure = [](const Vec3&) { return -1.0 / 7; };
  return p;
}

Problem pulled_layer(int cells, int levels, double poisson) {
  Problem p;
  p.name = "layer";
  p.level = cells;
  p.young = 192.4e3;
  p.poisson = poisson;
  const double edge = 0.066, depth = 0.010;
  const int side = cells + 1, surface = side * side;
  std::vector<Face> triangles;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const int a = j * side + i, b = a + 1, c = a + side, d = c + 1;
      // Alternating diagonals: no direction is preferred.
      if ((i + j) % 2) {
        triangles.push_back({a, b, d});
        triangles.push_back({a, d, c});
      } else {
        triangles.push_back({a, b, c});
        triangles.push_back({b, d, c});
      }
    }
  p.nodes.resize(surface * (levels + 1), 3);
  for (int level = 0; level <= levels; ++level)
    for (int j = 0; j <= cells; ++j)
      for (int i = 0; i <= cells; ++i)
        p.nodes.row(level * surface + j * side + i) << edge * i / cells - edge / 2,
            edge * j / cells - edge / 2, -depth * level / levels;
  p.tets = prisms(triangles, surface, levels, p.nodes);
  p.support = [=](const Vec3& x) {
    std::array<std::optional<double>, 3> held;
    if (x[2] < -depth + 1e-9) held = {0.0, 0.0, 0.0};
    if (x[2] > -1e-9 && std::abs(x[0]) < edge / 10 + 1e-9 && std::abs(x[1]) < edge / 10 + 1e-9)
      held = {0.004, 0.0, 0.003};
    return held;
  };
  return p;
}

Problem unit_cube(int cells) {
  Problem p;
  p.name = "cube";
  p.level = cells;
  std::mt19937 random(1);
  take(grid_of({cells, cells, cells},
               [&](const Vec3& x) -> Vec3 {
                 Vec3 at = x;
                 for (int axis = 0; axis < 3; ++axis) {
                   const double shift = 0.1 / cells * (2.0 * random() / std::mt19937::max() - 1);
                   if ((x.array() > 1e-9).all() && (x.array() < 1 - 1e-9).all()) at[axis] += shift;
                 }
                 return at;
               }),
       p);
  // Nodes are numbered anew: what depends on numbers must not profit from a grid's.
  std::vector<int> number(p.nodes.rows());
  std::iota(number.begin(), number.end(), 0);
  for (std::size_t i = number.size() - 1; i > 0; --i)
    std::swap(number[i], number[random() % (i + 1)]);
  const Points grid = p.nodes;
  for (std::size_t n = 0; n < number.size(); ++n) p.nodes.row(number[n]) = grid.row(n);
  for (int& corner : p.tets.reshaped()) corner = number[corner];
  p.support = [](const Vec3& x) {
    std::array<std::optional<double>, 3> held;
    if ((x.array() < 1e-9).any() || (x.array() > 1 - 1e-9).any()) held = {0.0, 0.0, 0.0};
    return held;
  };
  return p;
}

Problem irregular_cube(int cells) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Base = CGAL::Triangulation_vertex_base_with_info_3<int, Kernel>;
  using Delaunay =
      CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Base>>;
  Problem p = unit_cube(cells);
  p.name = "irregular cube";
  std::mt19937 random(2);
  Delaunay mesh;
  for (Eigen::Index n = 0; n < p.nodes.rows(); ++n) {
    for (double& x : p.nodes.row(n))
      if (x > 1e-9 && x < 1 - 1e-9) x += 0.3 / cells * (2.0 * random() / std::mt19937::max() - 1);
    const auto x = p.nodes.row(n);
    mesh.insert({x[0], x[1], x[2]})->info() = static_cast<int>(n);
  }
  std::vector<std::array<int, 4>> tets;
  for (const auto& cell : mesh.finite_cell_handles()) {
    std::array<int, 4> tet{};
    Eigen::Matrix<double, 4, 3> corner;
    for (int a = 0; a < 4; ++a) {
      tet[a] = cell->vertex(a)->info();
      corner.row(a) = p.nodes.row(tet[a]);
    }
    const Vec3 e[3] = {(corner.row(1) - corner.row(0)).transpose(),
                       (corner.row(2) - corner.row(0)).transpose(),
                       (corner.row(3) - corner.row(0)).transpose()};
    const double volume = e[0].cross(e[1]).dot(e[2]) / 6;
    // Flat ones on the cube's faces are of rounding alone.
    if (std::abs(volume) < 1e-9) continue;
    if (volume < 0) std::swap(tet[2], tet[3]);
    tets.push_back(tet);
  }
  p.tets.resize(static_cast<Eigen::Index>(tets.size()), 4);
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (int a = 0; a < 4; ++a) p.tets(static_cast<Eigen::Index>(t), a) = tets[t][a];
  return p;
}

}  // namespace hyperex::study
