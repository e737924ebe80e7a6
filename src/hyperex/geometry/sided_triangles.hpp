// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// Which triangles of a surface a place may be matched with: a place on one lip must not be matched
/// with the other lip, even where the two are in contact.
class SidedTriangles {
 public:
  /// `side` has one number per vertex: 1 on one lip, -1 on the other, 0 elsewhere. Where it is
  /// empty, a place may be matched with any triangle.
  SidedTriangles(const TriMesh& mesh, const std::vector<int>& side);

  /// Per triangle, 1 where a place of that side may be matched with it: it has no vertex of the
  /// other side. All are 1 where every triangle has such a vertex.
  const std::vector<char>& open_to(int side) const;

 private:
  std::vector<char> all_;
  std::vector<char> without_first_, without_second_;  ///< empty: no such triangle, or no sides
};

}  // namespace hyperex
