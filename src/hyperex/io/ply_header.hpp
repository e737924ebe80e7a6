// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The header of a PLY file: the elements that follow and the types of their values.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hyperex::io {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
std::size_t bytes_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< type of a list's length
};

struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;
  /// The least size of a row, with empty lists: bytes if binary, characters if ascii.
  std::size_t smallest_row(bool ascii) const;
};

struct PlyHeader {
  enum class Format { ascii, binary_little_endian, binary_big_endian };
  Format format = Format::ascii;
  std::vector<PlyElement> elements;
  std::string texture_file;  ///< from the first `comment TextureFile NAME`
  std::size_t bytes = 0;     ///< size of the header; the body begins here
  int lines = 0;
};

/// Throws InputError if it is not a PLY file, if the header has no end, if a format or type is
/// unknown, or if a count is negative or exceeds what the file can contain.
PlyHeader read_ply_header(const std::filesystem::path& file, const std::string& bytes);

}  // namespace hyperex::io
