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

/// An image file as it was in the scan: encoded bytes, not pixels.
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
  /// 3|F| x 2, one row per triangle corner (row 3 f + k). As in glTF, v is 0 at the top of the
  /// image and increases downwards. Empty (0 rows) if the scan has no texture coordinates.
  Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor> corner_uv;
  /// Empty (0 rows) where the scan has no vertex colours.
  VertexColours vertex_colour;
  std::optional<Image> texture;
};

/// Reads PLY (ascii, binary of both endians), OBJ (with .mtl and texture), STL (ascii, binary;
/// equal corners are joined) or glTF/GLB, depending on the extension. Polygons are split into
/// triangles. The unit is `stated`; glTF is in metres by definition. Otherwise the unit is guessed
/// such that the middle side of the bounding box is 10 to 30 cm, as for a face. With a stated unit
/// or glTF's, 8 to 45 cm are accepted. Throws InputError if the file is damaged, if it contains
/// NaN, an index out of range or no triangles, or if its size is implausible. A texture that cannot
/// be read gives a warning in the log.
Scan read_scan(const std::filesystem::path& file, std::optional<LengthUnit> stated = std::nullopt);

/// A text such as "mm, guessed by its size: 17.7 cm across": which unit was used and why, and the
/// resulting middle side of the bounding box.
std::string unit_note(const Scan& scan);

/// Middle side of the bounding box, in the unit of the points. Messages call it "across".
double across(const Points& points);

/// Reads a mesh with the same checks and the same unit rule, but accepts any size. For meshes that
/// are not whole faces.
TriMesh read_mesh(const std::filesystem::path& file, LengthUnit unit);

/// A named number per vertex. The name includes the unit and contains no blanks.
struct VertexScalar {
  std::string name;
  Eigen::VectorXf values;
};
/// The vertex properties of a PLY that are not position, colour or texture, in the order of the
/// file. Throws InputError as read_scan() does if the file is damaged.
std::vector<VertexScalar> read_ply_scalars(const std::filesystem::path& file);
/// Writes `mesh` (metres) as binary little-endian PLY in `unit`, with one float property per
/// scalar, and with colours if given. A comment in the file states the unit.
void write_ply(const std::filesystem::path& file, const TriMesh& mesh, LengthUnit unit,
               const std::vector<VertexScalar>& scalars = {}, const VertexColours& colours = {});

}  // namespace hyperex::io
