// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/fem/element/element_kind.hpp"
#include "hyperex/fem/form/lists.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::fem {

/// Groups of tetrahedra whose common change of volume is resisted, instead of that of each
/// tetrahedron. An element in m groups contributes the volume V_e / m to each of them, so that the
/// sum of the group volumes V_g is the volume of the body. theta_g is the mean dilatation of the
/// elements of group g with these weights; kappa_g is the mean of their bulk moduli with the same
/// weights. The strain energy is
///   sum_e V_e (mu |dev e|^2 + kappa'_e / 2 tr(e)^2)
///     + sum_g V_g / 2 (kappa - kappa')_g theta_g^2,
/// where kappa'_e = min(kappa_e, kept mu_e) is the part of the bulk modulus that remains with the
/// element. Constant strain is represented exactly for any groups, and the energy is never
/// negative. Without groups, this is the plain element.
struct DilatationGroups {
  Lists tets;  ///< tetrahedra of each group, increasing; every tetrahedron is in at least one group
  double kept = 0;  ///< upper bound of kappa'_e / mu_e
};

/// The groups of an element kind on a mesh.
DilatationGroups dilatation_groups(ElementKind kind, Eigen::Index node_count,
                                   const Tetrahedra& tets);

/// Partitions the mesh into disjoint patches. First, disjoint stars of nodes are packed densely
/// until no further star fits. The star of a node is the set of all tetrahedra around it; stars of
/// fewer than eight tetrahedra are not used. Then each remaining tetrahedron joins the patch with
/// which it shares most corners. In a star, the central node can move in response to the constant
/// pressure of the patch. The patches are therefore stable, while patches of the same size that are
/// formed by other rules are not. The same mesh always gives the same patches.
DilatationGroups disjoint_stars(Eigen::Index node_count, const Tetrahedra& tets);

/// For each tetrahedron, the list of its corners.
Lists corner_lists(const Tetrahedra& tets);

}  // namespace hyperex::fem
