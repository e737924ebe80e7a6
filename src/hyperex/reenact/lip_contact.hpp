// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/tissue/tissue_mesh.hpp"

namespace hyperex::reenact {

/// How deep the lips pass through each other where nothing keeps them apart (ContactOptions): a
/// measure that looks at the scan's skin alone and takes the greatest depth at rest off.
class LipContact {
 public:
  LipContact(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks);
  /// Greatest depth (m) of a vertex of the lower lip behind the surface of the upper lip, less the
  /// same at rest (the resolution of the scan); 0 where they are apart.
  /// `displacement`: of the skin, |skin| x 3, m. May be called from several threads.
  double depth(const PointsF& displacement) const;

 private:
  double raw_depth(const Points& lower, const TriMesh& upper) const;
  std::vector<int> lower_, upper_;  // vertices of the skin
  Points lower_rest_;
  TriMesh upper_rest_;
  double at_rest_ = 0;
};

}  // namespace hyperex::reenact
