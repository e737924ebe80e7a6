// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/form/system.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <numeric>
#include <vector>

#include "hyperex/core/error.hpp"
#include "hyperex/fem/element/tet4.hpp"

namespace hyperex::fem {
namespace {

/// The tetrahedra around each node and its neighbours (itself included), both rising.
struct Adjacency {
  std::vector<int> tet_start, tet;
  std::vector<int> neighbour_start, neighbour;
};

Adjacency adjacency_of(Eigen::Index node_count, const Tetrahedra& tets) {
  Adjacency adj;
  adj.tet_start.assign(node_count + 1, 0);
  for (Eigen::Index t = 0; t < tets.rows(); ++t)
    for (int a = 0; a < 4; ++a) ++adj.tet_start[tets(t, a) + 1];
  std::partial_sum(adj.tet_start.begin(), adj.tet_start.end(), adj.tet_start.begin());
  adj.tet.resize(adj.tet_start.back());
  std::vector<int> next(adj.tet_start.begin(), adj.tet_start.end() - 1);
  for (Eigen::Index t = 0; t < tets.rows(); ++t)
    for (int a = 0; a < 4; ++a) adj.tet[next[tets(t, a)]++] = static_cast<int>(t);

  adj.neighbour_start.assign(1, 0);
  std::vector<int> around;
  for (Eigen::Index n = 0; n < node_count; ++n) {
    around.clear();
    for (int k = adj.tet_start[n]; k < adj.tet_start[n + 1]; ++k)
      for (int a = 0; a < 4; ++a) around.push_back(tets(adj.tet[k], a));
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    adj.neighbour.insert(adj.neighbour.end(), around.begin(), around.end());
    adj.neighbour_start.push_back(static_cast<int>(adj.neighbour.size()));
  }
  return adj;
}

/// Three columns a node, three rows a neighbour, all values zero.
SparseMatrix zero_pattern(const Adjacency& adj) {
  const int nodes = static_cast<int>(adj.neighbour_start.size()) - 1;
  SparseMatrix m(3 * nodes, 3 * nodes);
  m.resizeNonZeros(9 * static_cast<Eigen::Index>(adj.neighbour.size()));
  int* outer = m.outerIndexPtr();
  int* inner = m.innerIndexPtr();
  int filled = 0;
  for (int n = 0; n < nodes; ++n)
    for (int axis = 0; axis < 3; ++axis) {
      outer[3 * n + axis] = filled;
      for (int k = adj.neighbour_start[n]; k < adj.neighbour_start[n + 1]; ++k)
        for (int row = 0; row < 3; ++row) inner[filled++] = 3 * adj.neighbour[k] + row;
    }
  outer[3 * nodes] = filled;
  std::fill_n(m.valuePtr(), filled, 0.0);
  return m;
}

struct Element {
  Tet4 shape;
  Voigt elastic, viscous;
};

std::vector<Element> elements_of(const Points& nodes, const Tetrahedra& tets,
                                 const Material& material) {
  std::vector<Element> elements(tets.rows());
  tbb::parallel_for(Eigen::Index{0}, tets.rows(), [&](Eigen::Index t) {
    elements[t] = {make_tet4(corners_of(nodes, tets, t)),
                   elastic_tensor(material.young_pa[t], material.poisson[t]),
                   viscous_tensor(material.viscosity_pa_s[t], material.viscous_form)};
  });
  for (Eigen::Index t = 0; t < tets.rows(); ++t)
    if (!(elements[t].shape.volume > 0))
      throw NumericalError(fmt::format(
          "tetrahedron {} (nodes {}, {}, {}, {}) has volume {:.3g} m^3: the mesh must have only "
          "positive volumes",
          t, tets(t, 0), tets(t, 1), tets(t, 2), tets(t, 3), elements[t].shape.volume));
  return elements;
}

/// Fills the three columns of node n from the tetrahedra around it, in their order, so that the
/// sums are the same however the nodes are shared among threads.
void fill_columns(int n, const Adjacency& adj, const Tetrahedra& tets,
                  const std::vector<Element>& elements, const Material& material, System& system) {
  const int* first = adj.neighbour.data() + adj.neighbour_start[n];
  const int* last = adj.neighbour.data() + adj.neighbour_start[n + 1];
  for (int k = adj.tet_start[n]; k < adj.tet_start[n + 1]; ++k) {
    const int t = adj.tet[k];
    const Element& e = elements[t];
    int b = 0;
    while (tets(t, b) != n) ++b;
    for (int a = 0; a < 4; ++a) {
      const auto slot = 3 * (std::lower_bound(first, last, tets(t, a)) - first);
      const Eigen::Matrix3d stiffness = tensor_block(e.shape, e.elastic, a, b);
      const Eigen::Matrix3d damping = tensor_block(e.shape, e.viscous, a, b);
      const double mass = mass_entry(e.shape, material.density_kg_m3[t], a, b);
      for (int axis = 0; axis < 3; ++axis) {
        const auto at = system.stiffness.outerIndexPtr()[3 * n + axis] + slot;
        for (int row = 0; row < 3; ++row) {
          system.stiffness.valuePtr()[at + row] += stiffness(row, axis);
          system.damping.valuePtr()[at + row] += damping(row, axis);
        }
        system.mass.valuePtr()[at + axis] += mass;
      }
    }
  }
}

}  // namespace

System assemble(const Points& nodes, const Tetrahedra& tets, const Material& material) {
  [[maybe_unused]] const auto count = static_cast<std::size_t>(tets.rows());
  assert(material.young_pa.size() == count && material.poisson.size() == count);
  assert(material.viscosity_pa_s.size() == count && material.density_kg_m3.size() == count);
  assert(count == 0 || (tets.minCoeff() >= 0 && tets.maxCoeff() < nodes.rows()));

  const std::vector<Element> elements = elements_of(nodes, tets, material);
  const Adjacency adj = adjacency_of(nodes.rows(), tets);
  System system;
  system.stiffness = zero_pattern(adj);
  system.damping = system.stiffness;
  system.mass = system.stiffness;
  tbb::parallel_for(0, static_cast<int>(nodes.rows()),
                    [&](int n) { fill_columns(n, adj, tets, elements, material, system); });
  return system;
}

}  // namespace hyperex::fem
