// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/tissue/tissue_mesh.hpp"

namespace hyperex::reenact {

/// How deep the lips pass through each other. There is no contact in the model, so this is
/// measured.
class LipContact {
 public:
  LipContact(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks);
  /// Greatest depth (m) of a vertex of the lower lip behind the surface of the upper lip, less the
  /// same at rest (the resolution of the scan); 0 where they are apart.
  double depth(const Points& skin) const;

 private:
  double raw_depth(const Points& skin) const;
  std::vector<int> lower_;  // skin vertices
  Triangles upper_;         // triangles of the skin
  double at_rest_ = 0;
};

}  // namespace hyperex::reenact
