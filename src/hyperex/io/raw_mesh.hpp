// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Common interface of the mesh readers. They fill a RawMesh; raw_mesh.cpp then checks it and
// triangulates its polygons, and scan.cpp determines its unit.
#include <cstdint>
#include <filesystem>
#include <vector>

#include "hyperex/io/scan.hpp"

namespace hyperex::io {

/// A mesh as stored in the file: in the file's unit, with polygons and unchecked indices.
struct RawMesh {
  Points points;
  std::vector<std::int64_t> corner;    ///< vertex at each corner, face by face
  std::vector<std::int64_t> face_end;  ///< end of each face's corners in `corner`
  std::vector<float> corner_uv;        ///< 2 per corner, v as in glTF; empty where there are none
  VertexColours vertex_colour;
  std::optional<Image> texture;
  /// PLY only: vertex properties without a meaning to this program.
  std::vector<VertexScalar> vertex_scalars;

  /// Makes the corners added since the last call one face.
  void end_face() { face_end.push_back(static_cast<std::int64_t>(corner.size())); }
};

RawMesh read_ply(const std::filesystem::path& file);
RawMesh read_obj(const std::filesystem::path& file);
RawMesh read_stl(const std::filesystem::path& file);
RawMesh read_gltf(const std::filesystem::path& file);

/// Checks `raw` and splits its polygons into triangles: quadrilaterals along the shorter diagonal,
/// others as fans. Points stay in the file's unit. Throws InputError, naming vertex or face counted
/// from 0, unless there are vertices with finite coordinates and faces with at least three corners
/// and valid indices.
Scan triangulated(const std::filesystem::path& file, RawMesh raw);

}  // namespace hyperex::io
