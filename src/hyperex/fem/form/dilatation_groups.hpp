// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/fem/element/element_kind.hpp"
#include "hyperex/fem/form/lists.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::fem {

/// Groups of tetrahedra that resist the change of their common volume, instead of each of them that
/// of its own. An element that is in m groups gives each of them V_e / m, so that the groups'
/// volumes V_g sum to the body's; theta_g is the mean of the elements' dilatations with these
/// weights, kappa_g that of their bulk moduli. The strain energy is
///   sum_e V_e (mu |dev e|^2 + kappa'_e / 2 tr(e)^2)  +  sum_g V_g / 2 (kappa - kappa')_g
///   theta_g^2,
/// kappa'_e = min(kappa_e, kept mu_e) being the part of the bulk modulus that stays with the
/// element. Constant strain is reproduced exactly whatever the groups, and the energy is never
/// negative. No groups: the plain element.
struct DilatationGroups {
  Lists tets;       ///< of each group, rising; every tetrahedron in at least one
  double kept = 0;  ///< multiple of the shear modulus
};

/// The groups of an element kind on a mesh.
DilatationGroups dilatation_groups(ElementKind kind, Eigen::Index node_count,
                                   const Tetrahedra& tets);

/// Disjoint patches: the whole stars of nodes (all tetrahedra around one, at least eight) that
/// share no tetrahedron, as many as fit, packed tightly; each tetrahedron between them joins the
/// patch with which it shares most corners. A star has a node that can move as its constant
/// pressure wants, and so the patches are stable where patches of the same size by any other rule
/// are not. The same mesh gives the same patches.
DilatationGroups disjoint_stars(Eigen::Index node_count, const Tetrahedra& tets);

/// The lists of corners of each tetrahedron.
Lists corner_lists(const Tetrahedra& tets);

}  // namespace hyperex::fem
