// SPDX-License-Identifier: GPL-3.0-or-later
// The candidates that need more unknowns than the mesh's nodes have.
#include <map>

#include "equations.hpp"

namespace hyperex::study {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

struct Moduli {
  double shear, bulk;
  explicit Moduli(const Problem& p)
      : shear(fem::shear_modulus_pa(p.young, p.poisson)),
        bulk(fem::bulk_modulus_pa(p.young, p.poisson)) {}
};

/// Block (a, b) of the deviatoric stiffness for gradients g_a, g_b and a weight.
Eigen::Matrix3d deviatoric(double shear, const Vec3& a, const Vec3& b, double weight) {
  return weight * shear *
         (b * a.transpose() + a.dot(b) * Eigen::Matrix3d::Identity() - 2.0 / 3 * a * b.transpose());
}

void add(Triplets& triplets, int row, int column, const Eigen::Matrix3d& block) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) triplets.emplace_back(3 * row + i, 3 * column + j, block(i, j));
}

/// The mesh with a node in the middle of each edge.
struct QuadraticMesh {
  Points nodes;
  std::vector<std::array<int, 10>> tets;  // corners, then edges 01 02 03 12 13 23
  std::map<std::pair<int, int>, int> middle;
};
constexpr int kEdge[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

QuadraticMesh quadratic_mesh(const Problem& p) {
  QuadraticMesh mesh;
  std::vector<Vec3> added;
  const auto first = static_cast<int>(p.nodes.rows());
  for (Eigen::Index t = 0; t < p.tets.rows(); ++t) {
    std::array<int, 10> tet{};
    for (int a = 0; a < 4; ++a) tet[a] = p.tets(t, a);
    for (int e = 0; e < 6; ++e) {
      const auto ends = std::minmax(tet[kEdge[e][0]], tet[kEdge[e][1]]);
      const auto [it, fresh] =
          mesh.middle.try_emplace(ends, first + static_cast<int>(added.size()));
      if (fresh) added.push_back((p.nodes.row(ends.first) + p.nodes.row(ends.second)) / 2);
      tet[4 + e] = it->second;
    }
    mesh.tets.push_back(tet);
  }
  mesh.nodes.resize(first + static_cast<int>(added.size()), 3);
  mesh.nodes.topRows(first) = p.nodes;
  for (std::size_t i = 0; i < added.size(); ++i)
    mesh.nodes.row(first + static_cast<int>(i)) = added[i].transpose();
  return mesh;
}

Eigen::VectorXd load_quadratic(const Problem& p, const QuadraticMesh& mesh) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(mesh.nodes.size());
  // Strang and Fix's rule of six points, exact to degree four.
  const double a = 0.445948490915965, b = 0.091576213509771;
  const double wa = 0.223381589678011, wb = 0.109951743655322;
  for (const auto& f : p.loaded) {
    const Vec3 x[3] = {p.nodes.row(f[0]).transpose(), p.nodes.row(f[1]).transpose(),
                       p.nodes.row(f[2]).transpose()};
    const Vec3 area = (x[1] - x[0]).cross(x[2] - x[0]) / 2;
    for (int q = 0; q < 6; ++q) {
      double l[3];
      for (int k = 0; k < 3; ++k) l[k] = q < 3 ? a : b;
      l[q % 3] = 1 - 2 * (q < 3 ? a : b);
      const Vec3 t = p.traction(l[0] * x[0] + l[1] * x[1] + l[2] * x[2], area.normalized()) *
                     area.norm() * (q < 3 ? wa : wb);
      for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        load.segment<3>(3 * f[k]) += l[k] * (2 * l[k] - 1) * t;
        load.segment<3>(3 * mesh.middle.at(std::minmax(f[k], f[next]))) += 4 * l[k] * l[next] * t;
      }
    }
  }
  return load;
}

/// Gradients of the ten shape functions at a point with barycentric coordinates l.
Eigen::Matrix<double, 10, 3> quadratic_gradients(const fem::Tet4& tet, const Eigen::Vector4d& l) {
  Eigen::Matrix<double, 10, 3> g;
  for (int a = 0; a < 4; ++a) g.row(a) = (4 * l[a] - 1) * tet.gradient.row(a);
  for (int e = 0; e < 6; ++e)
    g.row(4 + e) = 4 * (l[kEdge[e][0]] * tet.gradient.row(kEdge[e][1]) +
                        l[kEdge[e][1]] * tet.gradient.row(kEdge[e][0]));
  return g;
}

}  // namespace

Solution solve_p1p1(const Problem& p, int repeats) {
  const Moduli m(p);
  const auto nodes = static_cast<int>(p.nodes.rows());
  Triplets triplets;
  triplets.reserve(p.tets.rows() * 16 * 16);
  for (Eigen::Index t = 0; t < p.tets.rows(); ++t) {
    const fem::Tet4 tet = fem::make_tet4(fem::corners_of(p.nodes, p.tets, t));
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) {
        const int na = p.tets(t, a), nb = p.tets(t, b);
        const Vec3 ga = tet.gradient.row(a).transpose(), gb = tet.gradient.row(b).transpose();
        add(triplets, na, nb, deviatoric(m.shear, ga, gb, tet.volume));
        for (int i = 0; i < 3; ++i) {
          triplets.emplace_back(3 * na + i, 3 * nodes + nb, -tet.volume / 4 * ga[i]);
          triplets.emplace_back(3 * nodes + nb, 3 * na + i, -tet.volume / 4 * ga[i]);
        }
        const double mass = tet.volume / 20 * (a == b ? 2 : 1);
        triplets.emplace_back(3 * nodes + na, 3 * nodes + nb,
                              -mass / m.bulk - (mass - tet.volume / 16) / m.shear);
      }
  }
  fem::SparseMatrix a(4 * nodes, 4 * nodes);
  a.setFromTriplets(triplets.begin(), triplets.end());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(4 * nodes);
  x.head(3 * nodes) = load_linear(p);
  Solution s;
  solve_quasidefinite(a, Constraints(p.nodes, p.support, nodes), x, repeats, s);
  s.d = Eigen::Map<const Points>(x.data(), nodes, 3);
  s.pressure.resize(p.tets.rows());
  for (Eigen::Index t = 0; t < p.tets.rows(); ++t) {
    s.pressure[t] = 0;
    for (int k = 0; k < 4; ++k) s.pressure[t] += x[3 * nodes + p.tets(t, k)] / 4;
  }
  return s;
}

Solution solve_p2p0(const Problem& p, int repeats) {
  const Moduli m(p);
  const QuadraticMesh mesh = quadratic_mesh(p);
  Triplets triplets;
  triplets.reserve(p.tets.rows() * 900);
  const double near = (5 + 3 * std::sqrt(5.0)) / 20, far = (5 - std::sqrt(5.0)) / 20;
  std::vector<Eigen::Matrix<double, 10, 3>> mean(p.tets.rows());
  for (Eigen::Index t = 0; t < p.tets.rows(); ++t) {
    const fem::Tet4 tet = fem::make_tet4(fem::corners_of(p.nodes, p.tets, t));
    Eigen::Matrix<double, 10, 3> g[4];
    mean[t].setZero();
    for (int q = 0; q < 4; ++q) {
      Eigen::Vector4d l = Eigen::Vector4d::Constant(far);
      l[q] = near;
      g[q] = quadratic_gradients(tet, l);
      mean[t] += g[q] / 4;
    }
    for (int a = 0; a < 10; ++a)
      for (int b = 0; b < 10; ++b) {
        Eigen::Matrix3d block = m.bulk * tet.volume * mean[t].row(a).transpose() * mean[t].row(b);
        for (int q = 0; q < 4; ++q)
          block +=
              deviatoric(m.shear, g[q].row(a).transpose(), g[q].row(b).transpose(), tet.volume / 4);
        add(triplets, mesh.tets[t][a], mesh.tets[t][b], block);
      }
  }
  fem::SparseMatrix k(mesh.nodes.size(), mesh.nodes.size());
  k.setFromTriplets(triplets.begin(), triplets.end());
  Eigen::VectorXd x = load_quadratic(p, mesh);
  Solution s;
  solve_definite(k, Constraints(mesh.nodes, p.support), x, repeats, s);
  s.energy = x.dot(k * x) / 2;
  const Points all = Eigen::Map<const Points>(x.data(), mesh.nodes.rows(), 3);
  s.d = all.topRows(p.nodes.rows());
  s.pressure.setZero(p.tets.rows());
  for (Eigen::Index t = 0; t < p.tets.rows(); ++t)
    for (int a = 0; a < 10; ++a)
      s.pressure[t] -= m.bulk * mean[t].row(a).dot(all.row(mesh.tets[t][a]));
  return s;
}

}  // namespace hyperex::study
