// SPDX-License-Identifier: GPL-3.0-or-later
#include "candidates.hpp"

#include <metis.h>

#include <stdexcept>

#include "equations.hpp"

namespace hyperex::study {
namespace {

fem::DilatationGroups grouped_by(const std::vector<idx_t>& part, int parts, double kept) {
  fem::Lists elements;
  elements.start.resize(part.size() + 1);
  for (std::size_t t = 0; t <= part.size(); ++t) elements.start[t] = static_cast<int>(t);
  elements.item.assign(part.begin(), part.end());
  const fem::Lists tets = fem::transposed(elements, parts);
  fem::DilatationGroups groups;
  groups.kept = kept;
  for (int g = 0; g < parts; ++g)
    if (!tets[g].empty()) groups.tets.append(tets[g]);
  return groups;
}

/// Parts of about `size` tetrahedra that share faces, by METIS on the dual graph.
fem::DilatationGroups metis_patches(Eigen::Index node_count, const Tetrahedra& tets, int size,
                                    double kept) {
  idx_t elements = tets.rows(), nodes = node_count, common = 3, numbering = 0, one = 1, cut = 0;
  idx_t parts = std::max<idx_t>(2, elements / size);
  std::vector<idx_t> start(elements + 1), corner(tets.data(), tets.data() + tets.size());
  for (idx_t t = 0; t <= elements; ++t) start[t] = 4 * t;
  idx_t *dual_start = nullptr, *dual = nullptr;
  std::vector<idx_t> part(elements);
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  if (METIS_MeshToDual(&elements, &nodes, start.data(), corner.data(), &common, &numbering,
                       &dual_start, &dual) != METIS_OK ||
      METIS_PartGraphKway(&elements, &one, dual_start, dual, nullptr, nullptr, nullptr, &parts,
                          nullptr, nullptr, options, &cut, part.data()) != METIS_OK)
    throw std::runtime_error("METIS failed");
  METIS_Free(dual_start);
  METIS_Free(dual);
  return grouped_by(part, static_cast<int>(parts), kept);
}

/// Whole stars of nodes that share no tetrahedron, in the nodes' order instead of packed; each
/// tetrahedron left over joins the patch with which it shares most corners.
fem::DilatationGroups star_patches(Eigen::Index node_count, const Tetrahedra& tets) {
  const fem::Lists around = fem::transposed(fem::corner_lists(tets), static_cast<int>(node_count));
  std::vector<idx_t> part(tets.rows(), -1);
  int parts = 0;
  for (int n = 0; n < around.size(); ++n) {
    bool free = !around[n].empty();
    for (const int t : around[n]) free = free && part[t] < 0;
    if (!free) continue;
    for (const int t : around[n]) part[t] = parts;
    ++parts;
  }
  const std::vector<idx_t> stars = part;
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    if (stars[t] >= 0) continue;
    int most = 0;
    for (int a = 0; a < 4; ++a)
      for (const int other : around[tets(t, a)]) {
        if (stars[other] < 0) continue;
        int shared = 0;
        for (int i = 0; i < 4; ++i)
          for (int j = 0; j < 4; ++j) shared += tets(t, i) == tets(other, j);
        if (shared > most) {
          most = shared;
          part[t] = stars[other];
        }
      }
    if (part[t] < 0) part[t] = parts++;
  }
  return grouped_by(part, parts, 0);
}

}  // namespace

fem::DilatationGroups groups_of(const Candidate& candidate, Eigen::Index nodes,
                                const Tetrahedra& tets) {
  switch (candidate.family) {
    case Candidate::stars:
      return {fem::transposed(fem::corner_lists(tets), static_cast<int>(nodes)), candidate.kept};
    case Candidate::chosen:
      return fem::dilatation_groups(fem::ElementKind::tet4_star, nodes, tets);
    case Candidate::disjoint_stars:
      return star_patches(nodes, tets);
    case Candidate::patches:
      return metis_patches(nodes, tets, candidate.size, candidate.kept);
    default:
      return {};
  }
}

namespace {

Solution solve_grouped(const Problem& p, const Candidate& candidate, int repeats) {
  const fem::Assembler assembler(p.nodes, p.tets, groups_of(candidate, p.nodes.rows(), p.tets));
  fem::Material material;
  const auto count = static_cast<std::size_t>(p.tets.rows());
  material.young_pa.assign(count, p.young);
  material.poisson.assign(count, p.poisson);
  material.viscosity_pa_s.assign(count, 0);
  material.density_kg_m3.assign(count, 1);
  fem::System system;
  assembler.assemble(material, system);
  Solution s;
  s.assemble_s = quickest(repeats, [&] { assembler.assemble(material, system); });
  Eigen::VectorXd x = load_linear(p);
  solve_definite(system.stiffness, Constraints(p.nodes, p.support), x, repeats, s);
  s.energy = x.dot(system.stiffness * x) / 2;
  s.d = Eigen::Map<const Points>(x.data(), p.nodes.rows(), 3);
  s.pressure = assembler.pressure_pa(material, s.d);
  return s;
}

}  // namespace

Solution solve(const Problem& problem, const Candidate& candidate, int repeats) {
  if (candidate.family == Candidate::stabilised_p1p1) return solve_p1p1(problem, repeats);
  if (candidate.family == Candidate::quadratic) return solve_p2p0(problem, repeats);
  return solve_grouped(problem, candidate, repeats);
}

}  // namespace hyperex::study
