// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// The share (0 to 1) of the edges between two triangles along which both run the same way, so that
/// one of the two is turned inside out. Vertices at exactly the same place count as one. Edges with
/// three triangles or more are left out; 0 where no edge joins two.
double turned_edge_share(const TriMesh& mesh);

/// "some of its triangles are turned inside out: ...", where that share is above 2 %; else empty.
/// Scans have a few such triangles, which clean_mesh() drops.
std::string turned_triangles_doubt(const TriMesh& mesh);

}  // namespace hyperex
