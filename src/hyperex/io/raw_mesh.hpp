// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What the readers of mesh files have in common: they fill a RawMesh, scan.cpp checks it, cuts
// its polygons into triangles and settles its unit.
#include <cstdint>
#include <filesystem>
#include <vector>

#include "hyperex/io/scan.hpp"

namespace hyperex::io {

/// A mesh as its file has it: the file's unit, polygons, unchecked indices.
struct RawMesh {
  Points points;
  std::vector<std::int64_t> corner;    ///< the vertex at each corner, face after face
  std::vector<std::int64_t> face_end;  ///< where each face's corners end in `corner`
  std::vector<float> corner_uv;        ///< 2 per corner, v as in glTF; empty where there are none
  VertexColours vertex_colour;
  std::optional<Image> texture;
  std::vector<VertexScalar> vertex_scalars;  ///< PLY: properties of vertices that mean nothing here

  /// The corners added since the last call are one face.
  void end_face() { face_end.push_back(static_cast<std::int64_t>(corner.size())); }
};

RawMesh read_ply(const std::filesystem::path& file);
RawMesh read_obj(const std::filesystem::path& file);
RawMesh read_stl(const std::filesystem::path& file);
RawMesh read_gltf(const std::filesystem::path& file);

/// Checks `raw` (vertices there and finite, faces there, at least three corners each, indices in
/// range; InputError otherwise, naming vertex or face, counted from 0) and cuts polygons into
/// triangles: quadrangles along the shorter diagonal, others as fans. Points stay in the file's
/// unit.
Scan triangulated(const std::filesystem::path& file, RawMesh raw);

}  // namespace hyperex::io
