// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// The triangles of a surface that a place may be matched with where lips touch: a place of one lip
/// must not find the other.
class SidedTriangles {
 public:
  /// `side` has one number per vertex: 1 on one lip, -1 on the other, 0 elsewhere. Where it is
  /// empty, a place may be matched with any triangle.
  SidedTriangles(const TriMesh& mesh, const std::vector<int>& side);

  /// Per triangle, 1 where it is open to a place of that side: where it has no vertex of the other
  /// one. All of them where every triangle has.
  const std::vector<char>& open_to(int side) const;

 private:
  std::vector<char> all_, without_first_, without_second_;  ///< the latter two empty where none
};

}  // namespace hyperex
