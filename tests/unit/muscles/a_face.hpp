// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::muscles::test {

/// The embedded face on a layer of 8 mm, with a coarse mesh.
struct AFace {
  io::Landmarks landmarks;
  tissue::TissueMesh mesh;

  explicit AFace(double element_size_m = 0.005) {
    const anatomy::EmbeddedFace face = anatomy::embedded_face();
    landmarks = face.landmarks;
    tissue::TissueMeshOptions options;
    options.element_size_m = element_size_m;
    options.thickness_m = 0.008;
    mesh = tissue::build_tissue_mesh(face.mesh, landmarks, options, "embedded");
  }
  /// The surface on the bone.
  TriMesh inner() const {
    TriMesh out = mesh.volume.outer;
    out.points = mesh.volume.nodes.bottomRows(mesh.volume.surface_nodes());
    return out;
  }
};

/// Made once for all tests.
inline const AFace& a_face() {
  static const AFace face;
  return face;
}

}  // namespace hyperex::muscles::test
