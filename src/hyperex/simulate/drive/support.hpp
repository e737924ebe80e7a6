// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::simulate {

using anatomy::Bone;

/// The bone to which the tissue is attached under each inner node.
///
/// Where TissueMesh::bones are known, it is the bone at most 1.5 mm from the node, save where
/// tissue slides freely over bone and teeth:
///  * over the skull below the line from the base of the nose back to below the ears;
///  * over the mandible less than 16 mm below the lower lip's edge, and over its ramus, where it
///    glides on the masseter: less than 35 mm in front of the condyles, or 15 mm in front of the
///    estimated ones;
///  * within 8 mm (skull) or 6 mm (mandible) of the lips.
/// Tissue over the cartilage of the nose counts as over the skull, to which it belongs: below the
/// middle of the bridge (ibug68_28 and 29), in front of and between the wings (ibug68_31 and 35).
///
/// Otherwise it is estimated from landmarks:
///  * skull: above the line from the base of the nose (ibug68_33) back to below the ears (mean of
///    ibug68_2 and 14), save within 8 mm of the lips;
///  * mandible: within 15 mm of the line of the jaw over the chin (ibug68_5 to 11), from 10 mm
///  below
///    its edge up to 16 mm below the lower lip's edge (ibug68_57), save within 6 mm of the lips;
///  * none elsewhere: cheeks, the floor of the mouth and the neck.
std::vector<Bone> bones_under(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks);

/// One flag per inner node: whether bone lies within 5 mm of it, or it belongs to the neck, below
/// the edge of the jaw, behind which there is further tissue. Elsewhere the layer lies over a
/// cavity. All true where no bones are known.
std::vector<char> backed_by_bone(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks);

/// Distance of each outer node to the nearest of ibug68_48 to 67, m.
std::vector<double> distances_to_lips(const tissue::TissueMesh& mesh,
                                      const io::Landmarks& landmarks);

/// One flag per outer node: within 35 mm of the jaw's line (ibug68_4 to 12). The border of a scan
/// that ends just under the chin moves with the jaw and cannot be held.
std::vector<char> near_jaw(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks);

/// One flag per outer node: above the brows (ibug68_17 to 26) and within 35 mm of them, where the
/// frontalis moves the skin over the skull. The border of a scan that ends at the hairline slides.
std::vector<char> over_frontalis(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks);

/// The place of an inner node relative to the edge of the mandible (ibug68_5 to 11).
struct EdgeOfJaw {
  bool below = false;  ///< below the edge or beyond its two ends: the floor of the mouth
  Vec3 nearest;        ///< the closest place on the edge
  double distance_m;   ///< from the skin over the node to that place
};
std::vector<EdgeOfJaw> edge_of_jaw(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks);

}  // namespace hyperex::simulate
