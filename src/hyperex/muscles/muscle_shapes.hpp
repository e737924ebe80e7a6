// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/muscles/muscle_lines.hpp"

namespace hyperex::muscles {

/// How a muscle is drawn. Scan frame, metres.
struct MuscleShape {
  /// n x 3: the muscle's line. The upper and the lower half of a ring, two muscles of one side, are
  /// led on to the middle between their ends, where these lie apart. So a ring is a closed loop.
  Points line;
  /// The sheet of a muscle that ends in the fold from nose to mouth: a fan. First its tip, the
  /// origin; then points along the part of the fold at which it ends, from the nose on. There the
  /// skin is drawn towards the tip (fold_pull()). No rows for any other muscle.
  Points sheet;
};

/// One for each of `lines`, which are muscle_lines() of `table`.
std::vector<MuscleShape> muscle_shapes(const std::vector<MuscleLine>& lines,
                                       const MuscleTable& table, const tissue::TissueMesh& mesh,
                                       const io::Landmarks& landmarks);

}  // namespace hyperex::muscles
