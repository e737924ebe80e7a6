// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/clean_mesh.hpp"
#include "hyperex/geometry/thin_mesh.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"
#include "hyperex/tissue/mesh/on_skin.hpp"

namespace hyperex::session {

/// Per vertex: the texture has a seam there, so that thinning keeps it. Vertices at exactly the
/// same place count as one. Empty without a texture.
std::vector<char> on_seams(const io::Scan& scan);

/// The skin of a scan that was thinned without cuts, as thinned_scan() takes it: `clean` was made
/// of the scan, and `thin` of that. Its `places` are empty.
tissue::FullSkin skin_before_thinning(const io::Scan& scan, const CleanMesh& clean,
                                      const ThinMesh& thin);

/// The scan with the vertices of the thinned skin, their colours, and texture coordinates in the
/// same part of the texture.
io::Scan thinned_scan(const io::Scan& scan, const tissue::FullSkin& full, const TriMesh& thinned);

/// Reduces a field on the full skin to the vertices of the thinned skin.
void keep_thinned(tissue::TissueField& field, const tissue::FullSkin& full);

/// Values of the thinned skin's vertices, one row each, at every vertex of the full skin.
Eigen::MatrixXf on_full_skin(const tissue::FullSkin& full, const Eigen::MatrixXf& thinned);

}  // namespace hyperex::session
