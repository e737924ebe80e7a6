// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"

namespace hyperex::rig {

struct ThinnedScan {
  io::Scan scan;
  double off_m = 0;  ///< greatest distance of a removed vertex from the thinned surface
};

/// The scan with at most about `most` vertices, with its colours and its texture: edges are
/// collapsed, short ones first (thin_mesh), until that many are left. Repeated vertices and islands
/// are dropped. Borders, seams of the texture, and the skin beside the lids and the lips
/// (`landmarks`, the iBUG points of both; without them none) stay, so more may be left. A scan that
/// has no more stays as it is. Throws std::invalid_argument where the mesh cannot be cleaned
/// (clean_mesh).
ThinnedScan with_fewer_vertices(const io::Scan& scan, const io::Landmarks& landmarks,
                                Eigen::Index most);

}  // namespace hyperex::rig
