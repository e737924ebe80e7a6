// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/fem/form/assembler.hpp"
#include "meshes.hpp"

namespace hyperex::study {

struct Candidate {
  enum Family { plain, stars, chosen, disjoint_stars, patches, stabilised_p1p1, quadratic };
  std::string name;
  Family family;
  double kept = 0;  ///< multiple of mu whose volumetric part stays with the element
  int size = 0;     ///< tetrahedra of a patch
};

struct Solution {
  Points d;                  ///< of the mesh's nodes
  Eigen::VectorXd pressure;  ///< per tetrahedron
  double energy = 0;
  int unknowns = 0;
  double assemble_s = 0, analyse_s = 0, factor_s = 0, solve_s = 0;
  double factor_entries = 0;  ///< nonzeros of L
  bool solved = false;
};

/// Groups of the candidates that have some; empty ones for `plain`.
fem::DilatationGroups groups_of(const Candidate& candidate, Eigen::Index nodes,
                                const Tetrahedra& tets);

/// `repeats`: of each timed part; the quickest counts.
Solution solve(const Problem& problem, const Candidate& candidate, int repeats = 1);

}  // namespace hyperex::study
