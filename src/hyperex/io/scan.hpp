// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/core/describe.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::io {

enum class LengthUnit { millimetre, centimetre, metre };
constexpr auto words_of(LengthUnit) {
  return std::array{Word{"mm", LengthUnit::millimetre}, Word{"cm", LengthUnit::centimetre},
                    Word{"m", LengthUnit::metre}};
}
double metres_per(LengthUnit unit);
std::string name_of(LengthUnit unit);                            ///< "mm", "cm" or "m"
std::optional<LengthUnit> length_unit(const std::string& name);  ///< from "mm", "cm" or "m"

/// A picture file as it was in the scan: encoded bytes, not pixels.
struct Image {
  std::vector<std::uint8_t> bytes;
  std::string mime_type;  ///< "image/png" or "image/jpeg"
};

/// |V| x 4 RGBA.
using VertexColours = Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 4, Eigen::RowMajor>;

/// A face scan as read: the file's own vertices in the file's order, scaled to metres.
struct Scan {
  std::filesystem::path file;
  TriMesh mesh;  ///< metres
  LengthUnit unit = LengthUnit::millimetre;
  bool unit_guessed = false;
  /// 3|F| x 2, one row per triangle corner (row 3 f + k), v up as in glTF (0 at the picture's top);
  /// empty (0 rows) where the scan has no texture coordinates.
  Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor> corner_uv;
  /// Empty (0 rows) where the scan has no vertex colours.
  VertexColours vertex_colour;
  std::optional<Image> texture;
};

/// Reads PLY (ascii, binary of both endians), OBJ (with .mtl and texture), STL (ascii, binary;
/// equal corners joined) or glTF/GLB, chosen by the extension. Polygons are cut into triangles.
/// The unit is `stated`, else (glTF is metres by definition) guessed: the middle side of the
/// bounding box of a face is 10 to 30 cm. A stated unit, or glTF's, is believed from 8 to 45 cm.
/// Throws InputError: torn file, NaN, index out of range, no triangles, implausible size. A texture
/// that cannot be had is a warning in the log.
Scan read_scan(const std::filesystem::path& file, std::optional<LengthUnit> stated = std::nullopt);

/// "mm, guessed by its size: 17.7 cm across" and the like: which unit was taken, why, and how
/// large that makes the middle side of the bounding box.
std::string unit_note(const Scan& scan);

/// Middle side of the bounding box: what "across" means in the rule above. In the points' unit.
double across(const Points& points);

/// Same checks, same unit rule, but any length: for meshes that are no whole faces.
TriMesh read_mesh(const std::filesystem::path& file, LengthUnit unit);

/// Binary little-endian PLY of `mesh` (metres) in `unit`; one float property a named scalar
/// (units in the name, no blanks), and colours where given. The file says its unit in a comment.
struct VertexScalar {
  std::string name;
  Eigen::VectorXf values;
};
/// The vertex properties of a PLY that are neither places, colours nor texture, in the file's
/// order. Throws InputError as read_scan does of a torn file.
std::vector<VertexScalar> read_ply_scalars(const std::filesystem::path& file);
void write_ply(const std::filesystem::path& file, const TriMesh& mesh, LengthUnit unit,
               const std::vector<VertexScalar>& scalars = {}, const VertexColours& colours = {});

}  // namespace hyperex::io
