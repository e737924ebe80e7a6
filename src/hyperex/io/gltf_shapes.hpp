// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::io {

/// A morph target.
struct MorphShape {
  std::string name;
  PointsF displacement_m;  ///< at weight 1; a row per vertex of ShapedMesh::mesh
};

/// A surface with its morph targets ("shape keys" in Blender, "blend shapes" elsewhere).
struct ShapedMesh {
  TriMesh mesh;  ///< metres, where its node places it
  std::vector<MorphShape> shapes;
  Landmarks landmarks;  ///< metres; none where the file lists none
};

/// Reads the morph targets of a glTF file, text or binary, by the names that
/// mesh.extras.targetNames lists, and the landmarks of mesh.extras.landmarks_m: {"pronasale": [x,
/// y, z], ...}, in the mesh's own frame. A face may consist of skin, teeth, eyes and lining; the
/// primitive with targets that has the most triangles is taken for the skin. Sparse accessors are
/// read; targets of normals are not. Throws InputError if the file is damaged, or if no mesh has
/// named targets.
ShapedMesh read_gltf_shapes(const std::filesystem::path& file);

}  // namespace hyperex::io
