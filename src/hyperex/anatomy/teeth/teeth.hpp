// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <vector>

#include "hyperex/geometry/signed_distance.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::anatomy {

/// The teeth and the gum of one jaw: one rigid part.
struct JawTeeth {
  /// Closed surfaces that may pass through each other; either may have no triangles.
  TriMesh crowns, gum;
  /// Per triangle of `crowns`: its tooth in FDI's numbers (11 to 47: quadrant and place from the
  /// mid-line); empty where a scan gave them.
  std::vector<int> tooth;

  bool empty() const { return crowns.triangles.rows() + gum.triangles.rows() == 0; }
};

/// Teeth at rest: scan frame, metres. The upper ones do not move, the lower ones move with the jaw
/// (Performance::jaw_now_from_rest).
struct Teeth {
  JawTeeth upper, lower;
  /// Moves with the lower row (tongue_in()) and takes no part in contact. May have no triangles.
  TriMesh tongue = {};
};

/// Distance to crowns and gum of one jaw at rest (GridDistance of cells of 0.5 mm); null where
/// there are none. Takes some 0.1 s.
std::shared_ptr<const SignedDistance> distance_to(const JawTeeth& jaw);

}  // namespace hyperex::anatomy
