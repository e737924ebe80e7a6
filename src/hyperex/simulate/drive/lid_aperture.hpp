// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/motion/motion.hpp"
#include "hyperex/simulate/drive/alignment.hpp"

namespace hyperex::simulate {

/// Weights of blend shapes state how far an eye closes as a share of its aperture, not in
/// millimetres. Moves the lids of `aligned` such that the distance between upper and lower lid
/// changes in the same proportion as in `recorded`, the motion that was aligned (same points and
/// samples). A share below 0 counts as 0, a closed eye. Corrects iBUG points 37, 38
/// (right upper lid) with 41, 40 and 43, 44 (left) with 47, 46, along the line between them at
/// rest; upper and lower lid share the correction as they share the motion. Pairs that the motion
/// lacks, or whose aperture at rest is below 2 mm or differs by more than a factor of 2, are left
/// as they are. Where both pairs of an eye are corrected, palpebrale_superius and
/// palpebrale_inferius between them move by the mean of what their lid's two points are moved by.
void match_lid_apertures(AlignedMotion& aligned, const motion::Motion& recorded);

}  // namespace hyperex::simulate
