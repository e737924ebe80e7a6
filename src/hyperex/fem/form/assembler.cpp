// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/form/assembler.hpp"

#include <fmt/format.h>

#include <limits>

#include "hyperex/core/error.hpp"
#include "hyperex/fem/form/for_each_index.hpp"
#include "hyperex/fem/form/mesh_entry.hpp"
#include "hyperex/fem/material/entry.hpp"

namespace hyperex::fem {
namespace {

std::vector<Tet4> shapes_of(const Points& nodes, const Tetrahedra& tets) {
  check_mesh(nodes, tets);
  std::vector<Tet4> shapes(tets.rows());
  for_each_index(tets.rows(),
                 [&](Eigen::Index t) { shapes[t] = make_tet4(corners_of(nodes, tets, t)); });
  for (Eigen::Index t = 0; t < tets.rows(); ++t)
    if (!(shapes[t].volume > 0))
      throw NumericalError(fmt::format(
          "tetrahedron {} (nodes {}, {}, {}, {}) has volume {:.3g} m^3: the mesh must have only "
          "positive volumes",
          t, tets(t, 0), tets(t, 1), tets(t, 2), tets(t, 3), shapes[t].volume));
  return shapes;
}

int place_of(int node, std::span<const int> rising) {
  return static_cast<int>(std::lower_bound(rising.begin(), rising.end(), node) - rising.begin());
}

}  // namespace

Assembler::Assembler(const Points& nodes, const Tetrahedra& tets, ElementKind kind)
    : Assembler(nodes, tets, dilatation_groups(kind, nodes.rows(), tets)) {}

Assembler::Assembler(const Points& nodes, const Tetrahedra& tets, const DilatationGroups& groups)
    : nodes_(nodes), shapes_(shapes_of(nodes, tets)), corners_(tets.rows()) {
  check_groups(groups, tets.rows());
  for (Eigen::Index t = 0; t < tets.rows(); ++t)
    for (int a = 0; a < 4; ++a) corners_[t][a] = tets(t, a);
  const Lists corner = corner_lists(tets);
  tets_around_ = transposed(corner, static_cast<int>(nodes.rows()));
  narrow_ = joined(tets_around_, corner);
  if (groups.tets.size() > 0) {
    group_nodes_ = joined(groups.tets, corner);
    take_groups(groups);
  }
  find_slots();
}

void Assembler::take_groups(const DilatationGroups& groups) {
  kept_ = groups.kept;
  groups_ = groups.tets;
  groups_of_ = transposed(groups_, static_cast<int>(element_count()));
  measure_groups();

  const Lists around = transposed(group_nodes_, static_cast<int>(node_count()));
  wide_ = joined(around, group_nodes_);
  member_start_ = around.start;
  memberships_.reserve(around.item.size());
  std::size_t slots = 0;
  for (int n = 0; n < around.size(); ++n)
    for (const int g : around[n]) {
      memberships_.push_back({g, group_nodes_.start[g] + place_of(n, group_nodes_[g]), slots});
      slots += group_nodes_[g].size();
    }
  group_slots_.resize(slots);
}

void Assembler::measure_groups() {
  group_volume_.assign(groups_.size(), 0);
  group_gradient_.assign(group_nodes_.item.size(), Vec3::Zero());
  for_each_index(groups_.size(), [&](Eigen::Index at) {
    const int g = static_cast<int>(at);
    Vec3* const gradient = group_gradient_.data() + group_nodes_.start[g];
    const auto nodes = group_nodes_[g];
    for (const int t : groups_[g]) {
      const double weight = shapes_[t].volume / static_cast<double>(groups_of_[t].size());
      group_volume_[g] += weight;
      for (int a = 0; a < 4; ++a)
        gradient[place_of(corners_[t][a], nodes)] +=
            weight * shapes_[t].gradient.row(a).transpose();
    }
    for (std::size_t k = 0; k < nodes.size(); ++k) gradient[k] /= group_volume_[g];
  });
}

void Assembler::find_slots() {
  const auto slots_in = [&](const Lists& neighbours) {
    std::vector<std::array<int, 4>> slots(tets_around_.item.size());
    for_each_index(node_count(), [&](Eigen::Index at) {
      const int n = static_cast<int>(at);
      for (int k = tets_around_.start[n]; k < tets_around_.start[n + 1]; ++k)
        for (int a = 0; a < 4; ++a)
          slots[k][a] = place_of(corners_[tets_around_.item[k]][a], neighbours[n]);
    });
    return slots;
  };
  narrow_slots_ = slots_in(narrow_);
  if (groups_.size() == 0) return;
  for (int n = 0; n < wide_.size(); ++n)
    if (wide_[n].size() > std::numeric_limits<std::uint16_t>::max())
      throw NumericalError(fmt::format("node {} has {} neighbours: too many", n, wide_[n].size()));
  wide_slots_ = slots_in(wide_);
  for_each_index(node_count(), [&](Eigen::Index at) {
    const int n = static_cast<int>(at);
    for (int k = member_start_[n]; k < member_start_[n + 1]; ++k) {
      // Both lists are increasing, so that one pass finds all slots.
      std::uint16_t slot = 0;
      std::uint16_t* out = group_slots_.data() + memberships_[k].slots_from;
      for (const int node : group_nodes_[memberships_[k].group]) {
        while (wide_[n][slot] != node) ++slot;
        *out++ = slot;
      }
    }
  });
}

SparseMatrix Assembler::stiffness_pattern() const {
  SparseMatrix m = pattern(stiffness_neighbours());
  std::fill_n(m.valuePtr(), m.nonZeros(), 0.0);
  return m;
}

/// The values are not initialised.
SparseMatrix Assembler::pattern(const Lists& neighbours) const {
  const int nodes = neighbours.size();
  const std::size_t count = 9 * neighbours.item.size();
  if (count > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw NumericalError(
        fmt::format("{} nodes make a matrix of {} entries: too many", nodes, count));
  SparseMatrix m(3 * nodes, 3 * nodes);
  m.resizeNonZeros(static_cast<Eigen::Index>(count));
  int* outer = m.outerIndexPtr();
  int* inner = m.innerIndexPtr();
  int filled = 0;
  for (int n = 0; n < nodes; ++n)
    for (int axis = 0; axis < 3; ++axis) {
      outer[3 * n + axis] = filled;
      for (const int node : neighbours[n])
        for (int row = 0; row < 3; ++row) inner[filled++] = 3 * node + row;
    }
  outer[3 * nodes] = filled;
  return m;
}

std::vector<Assembler::Moduli> Assembler::moduli(const Material& material) const {
  std::vector<Moduli> out(element_count());
  for_each_index(element_count(), [&](Eigen::Index t) {
    const double shear = shear_modulus_pa(material.young_pa[t], material.poisson[t]);
    const double bulk = bulk_modulus_pa(material.young_pa[t], material.poisson[t]);
    const double kept = groups_.size() ? std::min(bulk, kept_ * shear) : bulk;
    out[t] = {kept - 2 * shear / 3, shear, bulk - kept};
  });
  return out;
}

std::vector<double> Assembler::group_stiffness(const std::vector<Moduli>& moduli) const {
  std::vector<double> stiffness(groups_.size(), 0);
  for_each_index(groups_.size(), [&](Eigen::Index at) {
    const int g = static_cast<int>(at);
    for (const int t : groups_[g])
      stiffness[g] +=
          moduli[t].averaged * shapes_[t].volume / static_cast<double>(groups_of_[t].size());
  });
  return stiffness;
}

/// Adds the contributions of the plain element to the three columns of node n, from the tetrahedra
/// around it. With G = V g_a g_b^T, the block (a, b) of V B^T T B is first G + shear (G^T + tr(G)
/// I) for isotropic T; the printed viscous form subtracts eta G_ii from its diagonal.
void Assembler::fill_elements(int n, const Material& material, const std::vector<Moduli>& moduli,
                              System& system) const {
  const bool printed = material.viscous_form == ViscousForm::printed;
  const auto& k_slots = groups_.size() ? wide_slots_ : narrow_slots_;
  double* const k_values = system.stiffness.valuePtr() + system.stiffness.outerIndexPtr()[3 * n];
  const auto narrow_from = system.damping.outerIndexPtr()[3 * n];
  double* const c_values = system.damping.valuePtr() + narrow_from;
  double* const m_values = system.mass.valuePtr() + narrow_from;
  const auto k_height = 3 * stiffness_neighbours()[n].size(), c_height = 3 * narrow_[n].size();

  for (int k = tets_around_.start[n]; k < tets_around_.start[n + 1]; ++k) {
    const int t = tets_around_.item[k];
    const Tet4& shape = shapes_[t];
    const Moduli& elastic = moduli[t];
    const double eta = material.viscosity_pa_s[t];
    const double viscous_first = -eta * (printed ? 1.0 : 2.0) / 3, off = printed ? eta : 0;
    const double mass = mass_entry(shape, material.density_kg_m3[t], 0, 1);
    int b = 0;
    while (corners_[t][b] != n) ++b;
    for (int a = 0; a < 4; ++a) {
      const Eigen::Matrix3d g =
          shape.gradient.row(a).transpose() * (shape.volume * shape.gradient.row(b));
      const double trace = g.trace();
      double* const k_block = k_values + 3 * k_slots[k][a];
      double* const c_block = c_values + 3 * narrow_slots_[k][a];
      for (int axis = 0; axis < 3; ++axis) {
        double* const k_at = k_block + axis * k_height;
        double* const c_at = c_block + axis * c_height;
        for (int row = 0; row < 3; ++row) {
          k_at[row] += elastic.first * g(row, axis) + elastic.shear * g(axis, row);
          c_at[row] += viscous_first * g(row, axis) + eta * g(axis, row);
        }
        k_at[axis] += elastic.shear * trace;
        c_at[axis] += eta * trace - off * g(axis, axis);
        m_values[3 * narrow_slots_[k][a] + axis * c_height + axis] += a == b ? 2 * mass : mass;
      }
    }
  }
}

void Assembler::add_groups(int n, const std::vector<double>& stiffness,
                           const std::vector<Vec3>& gradient, SparseMatrix& matrix) const {
  const auto height = 3 * wide_[n].size();
  double* const x = matrix.valuePtr() + matrix.outerIndexPtr()[3 * n];
  double* const y = x + height;
  double* const z = y + height;
  for (int k = member_start_[n]; k < member_start_[n + 1]; ++k) {
    const Membership& member = memberships_[k];
    const Vec3 own = stiffness[member.group] * gradient[member.place];
    const std::uint16_t* slot = group_slots_.data() + member.slots_from;
    const Vec3* other = gradient.data() + group_nodes_.start[member.group];
    const Vec3* const end = gradient.data() + group_nodes_.start[member.group + 1];
    for (; other != end; ++other, ++slot)
      for (int row = 0; row < 3; ++row) {
        const double value = (*other)[row];
        x[3 * *slot + row] += own[0] * value;
        y[3 * *slot + row] += own[1] * value;
        z[3 * *slot + row] += own[2] * value;
      }
  }
}

void Assembler::assemble(const Material& material, System& system) const {
  check_material(material, element_count());
  const Lists& wide = stiffness_neighbours();
  const auto fits = [&](const SparseMatrix& m, const Lists& neighbours) {
    return m.cols() == 3 * node_count() && m.isCompressed() &&
           m.nonZeros() == 9 * static_cast<Eigen::Index>(neighbours.item.size());
  };
  if (!fits(system.stiffness, wide)) system.stiffness = pattern(wide);
  if (!fits(system.damping, narrow_)) system.damping = pattern(narrow_);
  if (!fits(system.mass, narrow_)) system.mass = pattern(narrow_);

  const std::vector<Moduli> of_element = moduli(material);
  const std::vector<double> of_group = group_stiffness(of_element);
  for_each_index(node_count(), [&](Eigen::Index at) {
    const int n = static_cast<int>(at);
    for (SparseMatrix* m : {&system.stiffness, &system.damping, &system.mass})
      std::fill(m->valuePtr() + m->outerIndexPtr()[3 * n],
                m->valuePtr() + m->outerIndexPtr()[3 * n + 3], 0.0);
    fill_elements(n, material, of_element, system);
    if (groups_.size() > 0) add_groups(n, of_group, group_gradient_, system.stiffness);
  });
}

}  // namespace hyperex::fem
