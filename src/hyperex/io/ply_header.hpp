// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The header of a PLY file: which elements follow and how their values are stored.
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
  PlyType count_type = PlyType::uint8;  ///< of a list's length
};

struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;
  /// What a row takes at least, its lists empty: bytes in binary, characters in ascii.
  std::size_t smallest_row(bool ascii) const;
};

struct PlyHeader {
  enum class Format { ascii, binary_little_endian, binary_big_endian };
  Format format = Format::ascii;
  std::vector<PlyElement> elements;
  std::string texture_file;  ///< of `comment TextureFile NAME`, the first
  std::size_t bytes = 0;     ///< the body begins here
  int lines = 0;
};

/// Throws InputError: no PLY file, no end of the header, an unknown format or type, a count that is
/// negative or promises more than the file holds.
PlyHeader read_ply_header(const std::filesystem::path& file, const std::string& bytes);

}  // namespace hyperex::io
