// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The skin of the eyelids, which closes an eye along its whole length.
#include <string>
#include <vector>

#include "hyperex/io/landmarks.hpp"
#include "hyperex/simulate/drive/matching.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::simulate {

/// `rim` (RimVertex of `mesh`) with lids whose aperture changes in the same proportion everywhere.
/// Recordings move two points of each lid. The simulated surface is too coarse to follow them to
/// the corners of the eye, and knows nothing of how wide the eye is between them, so that a blink
/// would leave it open there by up to 2 mm.
///
/// The edges of the lids are those seen from the front, every half millimetre along the eye. Where
/// they are h apart at rest, the upper edge moves relative to the lower one by
///   h / a (d_upper - d_lower),
/// where d are the displacements of a lid's point and of that below it (iBUG 37, 41 and 38, 40; 43,
/// 47 and 44, 46), and a is their distance at rest; linear between the two pairs, and constant
/// beyond. The displacement that is missing for this is the correction. The upper lid moves by six
/// sevenths of it and the lower lid by one seventh the other way, as in a blink. The correction has
/// full weight within 2 mm of an edge, along the skin, and falls smoothly to zero at 7 mm.
/// Displacements are weighted sums of the nodes' displacements, as before.
///
/// `names`, `places`: the driven points and their places on the skin. `landmarks`: the 68 iBUG
/// points. Returns `rim` with the lids' vertices changed or added, rising. An eye is left as it is
/// if one of its four points does not drive, if it is closed or its ball was scanned, or if two of
/// its points are less than 2 mm or half of h apart.
std::vector<tissue::RimVertex> share_lid_apertures(const tissue::TissueMesh& mesh,
                                                   const io::Landmarks& landmarks,
                                                   const std::vector<std::string>& names,
                                                   const std::vector<Match>& places,
                                                   std::vector<tissue::RimVertex> rim);

}  // namespace hyperex::simulate
