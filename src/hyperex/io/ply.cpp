// SPDX-License-Identifier: GPL-3.0-or-later
// PLY: reads elements and properties in any order, ascii and binary of both endians; writes binary.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/io/image.hpp"
#include "hyperex/io/number.hpp"
#include "hyperex/io/ply_header.hpp"
#include "hyperex/io/raw_mesh.hpp"

namespace hyperex::io {
namespace {
static_assert(std::endian::native == std::endian::little);

struct Torn {};
struct BadWord {
  std::string word;
  int line;
};

class BinarySource {
 public:
  BinarySource(std::string_view body, bool swapped) : rest_(body), swapped_(swapped) {}

  double next(PlyType type) {
    switch (type) {
      case PlyType::int8:
        return take<std::int8_t>();
      case PlyType::uint8:
        return take<std::uint8_t>();
      case PlyType::int16:
        return take<std::int16_t>();
      case PlyType::uint16:
        return take<std::uint16_t>();
      case PlyType::int32:
        return take<std::int32_t>();
      case PlyType::uint32:
        return take<std::uint32_t>();
      case PlyType::float32:
        return take<float>();
      case PlyType::float64:
        return take<double>();
    }
    throw std::logic_error("PlyType");
  }

 private:
  template <class T>
  T take() {
    if (rest_.size() < sizeof(T)) throw Torn{};
    std::array<char, sizeof(T)> bytes;
    std::copy_n(rest_.data(), sizeof(T), bytes.data());
    rest_.remove_prefix(sizeof(T));
    if (swapped_) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
  }
  std::string_view rest_;
  bool swapped_;
};

class AsciiSource {
 public:
  AsciiSource(std::string_view body, int line) : rest_(body), line_(line + 1) {}

  double next(PlyType) {
    std::size_t begin = 0;
    while (begin < rest_.size() && is_blank(rest_[begin])) line_ += rest_[begin++] == '\n';
    std::size_t end = begin;
    while (end < rest_.size() && !is_blank(rest_[end])) ++end;
    if (begin == end) throw Torn{};
    const std::string_view word = rest_.substr(begin, end - begin);
    const auto number = parse_number(word);
    if (!number) throw BadWord{quotable(word), line_};
    rest_.remove_prefix(end);
    return *number;
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  std::string_view rest_;
  int line_;
};

/// The meaning of a vertex property; -1: none.
enum Role { x, y, z, red, green, blue, alpha, u, v, roles };

int role_of(const std::string& name) {
  constexpr std::array<std::array<std::string_view, 4>, roles> names{
      {{"x"},
       {"y"},
       {"z"},
       {"red", "r", "diffuse_red"},
       {"green", "g", "diffuse_green"},
       {"blue", "b", "diffuse_blue"},
       {"alpha", "a", "diffuse_alpha"},
       {"s", "u", "texture_u", "texture_s"},
       {"t", "v", "texture_v", "texture_t"}}};
  for (int role = 0; role < roles; ++role)
    for (const auto known : names[role])
      if (!known.empty() && name == known) return role;
  return -1;
}

/// Converts a colour channel to 0 to 255. Real numbers range from 0 to 1, integers over the range
/// of their type.
std::uint8_t channel(double value, PlyType type) {
  if (type >= PlyType::float32) value *= 255;
  if (type == PlyType::int16 || type == PlyType::uint16) value /= 257;
  if (!(value > 0)) return 0;
  return static_cast<std::uint8_t>(std::lround(std::min(value, 255.0)));
}

template <class Source>
class BodyReader {
 public:
  BodyReader(const std::filesystem::path& file, const PlyHeader& header, Source source)
      : file_(file), header_(header), source_(source) {}

  RawMesh read() {
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex") read_vertices(element);
      for (row_ = 0; element.name != "vertex" && row_ < element.count; ++row_) {
        if (element.properties.empty()) break;
        guarded(element, [&] { read_row(element); });
      }
    }
    if (!vertex_uv_.empty() && raw_.corner_uv.empty()) spread_vertex_uv();
    return std::move(raw_);
  }

 private:
  template <class Read>
  void guarded(const PlyElement& element, const Read& read) {
    try {
      read();
    } catch (const Torn&) {
      throw InputError(file_,
                       fmt::format("is torn: it ends within \"{}\" {} of {} (counted from 0)",
                                   quotable(element.name), row_, element.count));
    } catch (const BadWord& bad) {
      throw InputError({file_, bad.line, fmt::format("\"{}\" {}", quotable(element.name), row_),
                        bad.word, "a number"});
    }
  }

  void read_vertices(const PlyElement& element) {
    std::vector<int> role;
    std::array<bool, roles> has{};
    for (const auto& property : element.properties) {
      role.push_back(property.is_list ? -1 : role_of(property.name));
      if (role.back() >= 0) has[role.back()] = true;
    }
    if (!has[x] || !has[y] || !has[z])
      throw InputError(file_, "its vertices have no x, y and z; expected these properties");
    const bool coloured = has[red] && has[green] && has[blue];
    const bool textured = has[u] && has[v];
    raw_.points.resize(element.count, 3);
    if (coloured) raw_.vertex_colour.resize(element.count, 4);
    if (textured) vertex_uv_.reserve(2 * element.count);
    std::vector<int> scalar(role.size(), -1);  // property -> its index among the scalars
    for (std::size_t p = 0; p < role.size(); ++p) {
      const auto& property = element.properties[p];
      if (property.is_list || role[p] >= 0) continue;
      scalar[p] = static_cast<int>(raw_.vertex_scalars.size());
      raw_.vertex_scalars.push_back({property.name, Eigen::VectorXf(element.count)});
    }
    for (row_ = 0; row_ < element.count; ++row_) {
      std::array<double, roles> value{};
      guarded(element, [&] {
        for (std::size_t p = 0; p < role.size(); ++p) {
          const auto& property = element.properties[p];
          if (property.is_list) {
            skip_list(property);
            continue;
          }
          const double number = source_.next(property.type);
          if (role[p] >= red && role[p] <= alpha)
            value[role[p]] = channel(number, property.type);
          else if (role[p] >= 0)
            value[role[p]] = number;
          else
            raw_.vertex_scalars[scalar[p]].values[row_] = static_cast<float>(number);
        }
      });
      raw_.points.row(row_) << value[x], value[y], value[z];
      if (coloured)
        for (int k = 0; k < 4; ++k)
          raw_.vertex_colour(row_, k) =
              k == 3 && !has[alpha] ? 255 : static_cast<std::uint8_t>(value[red + k]);
      if (textured) {
        vertex_uv_.push_back(static_cast<float>(value[u]));
        vertex_uv_.push_back(static_cast<float>(1 - value[v]));
      }
    }
  }

  /// Reads a face, or a row of an element that is ignored.
  void read_row(const PlyElement& element) {
    const bool face = element.name == "face";
    bool has_corners = false;
    texcoord_.clear();
    const std::size_t first = raw_.corner.size();
    for (const auto& property : element.properties) {
      if (!property.is_list) {
        source_.next(property.type);
      } else if (face && (property.name == "vertex_indices" || property.name == "vertex_index")) {
        for (std::int64_t n = length(property); n > 0; --n)
          raw_.corner.push_back(index(source_.next(property.type)));
        has_corners = true;
      } else if (face && property.name == "texcoord") {
        for (std::int64_t n = length(property); n > 0; --n)
          texcoord_.push_back(static_cast<float>(source_.next(property.type)));
        has_face_uv_ = true;
      } else {
        skip_list(property);
      }
    }
    if (!face) return;
    if (!has_corners)
      throw InputError(file_, "its faces have no list \"vertex_indices\"; expected this property");
    raw_.end_face();
    if (has_face_uv_) add_face_uv(raw_.corner.size() - first);
  }

  void add_face_uv(std::size_t corners) {
    if (texcoord_.empty()) texcoord_.assign(2 * corners, 0.f);  // a face without texture
    if (texcoord_.size() != 2 * corners)
      throw InputError(file_, fmt::format("face {} (counted from 0) has {} corners but {} texture "
                                          "coordinates; expected two for each corner",
                                          row_, corners, texcoord_.size()));
    for (std::size_t k = 0; k < texcoord_.size(); ++k)
      raw_.corner_uv.push_back(k % 2 ? 1 - texcoord_[k] : texcoord_[k]);
  }

  void spread_vertex_uv() {
    raw_.corner_uv.reserve(2 * raw_.corner.size());
    for (const std::int64_t i : raw_.corner)
      for (int k = 0; k < 2; ++k)  // an index out of range is reported later, with its face
        raw_.corner_uv.push_back(i >= 0 && i < raw_.points.rows() ? vertex_uv_[2 * i + k] : 0.f);
  }

  std::int64_t length(const PlyProperty& property) {
    const double n = source_.next(property.count_type);
    if (!(n >= 0 && n <= 1e9) || n != std::floor(n))
      throw InputError(file_, fmt::format("row {} (counted from 0) of \"{}\" says {} values; "
                                          "expected a whole number, 0 or more",
                                          row_, quotable(property.name), n));
    return static_cast<std::int64_t>(n);
  }

  std::int64_t index(double value) const {
    if (!(std::abs(value) < 1e15) || value != std::floor(value))
      throw InputError(file_, fmt::format("face {} (counted from 0) names vertex {}; expected a "
                                          "whole number",
                                          row_, value));
    return static_cast<std::int64_t>(value);
  }

  void skip_list(const PlyProperty& property) {
    for (std::int64_t n = length(property); n > 0; --n) source_.next(property.type);
  }

  const std::filesystem::path& file_;
  const PlyHeader& header_;
  Source source_;
  RawMesh raw_;
  std::int64_t row_ = 0;
  std::vector<float> vertex_uv_, texcoord_;
  bool has_face_uv_ = false;
};

template <class T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void check_scalars(const TriMesh& mesh, const std::vector<VertexScalar>& scalars) {
  for (const auto& scalar : scalars)
    if (scalar.values.size() != mesh.points.rows() || scalar.name.empty() ||
        scalar.name.find_first_of(" \t\r\n") != std::string::npos)
      throw std::invalid_argument(
          "write_ply: a scalar needs a name without blanks and a value a "
          "vertex: " +
          scalar.name);
}

}  // namespace

RawMesh read_ply(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  const PlyHeader header = read_ply_header(file, bytes);
  const std::string_view body = std::string_view(bytes).substr(header.bytes);
  RawMesh raw;
  if (header.format == PlyHeader::Format::ascii) {
    raw = BodyReader(file, header, AsciiSource(body, header.lines)).read();
  } else {
    const bool swapped = header.format == PlyHeader::Format::binary_big_endian;
    raw = BodyReader(file, header, BinarySource(body, swapped)).read();
  }
  if (!header.texture_file.empty() && !raw.corner_uv.empty())
    raw.texture = load_texture(file, header.texture_file);
  return raw;
}

std::vector<VertexScalar> read_ply_scalars(const std::filesystem::path& file) {
  return read_ply(file).vertex_scalars;
}

void write_ply(const std::filesystem::path& file, const TriMesh& mesh, LengthUnit unit,
               const std::vector<VertexScalar>& scalars, const VertexColours& colours) {
  check_scalars(mesh, scalars);
  const bool coloured = colours.rows() > 0;
  if (coloured && colours.rows() != mesh.points.rows())
    throw std::invalid_argument("write_ply: colours need one row per vertex");
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment unit {}\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n",
      name_of(unit), mesh.points.rows());
  if (coloured)
    for (const char* name : {"red", "green", "blue", "alpha"})
      bytes += fmt::format("property uchar {}\n", name);
  for (const auto& scalar : scalars) bytes += fmt::format("property float {}\n", scalar.name);
  bytes += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                       mesh.triangles.rows());
  const double scale = 1 / metres_per(unit);
  for (Eigen::Index i = 0; i < mesh.points.rows(); ++i) {
    for (int k = 0; k < 3; ++k) append(bytes, static_cast<float>(mesh.points(i, k) * scale));
    if (coloured) bytes.append(reinterpret_cast<const char*>(&colours(i, 0)), 4);
    for (const auto& scalar : scalars) append(bytes, scalar.values[i]);
  }
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    append(bytes, std::uint8_t{3});
    for (int k = 0; k < 3; ++k) append(bytes, static_cast<std::int32_t>(mesh.triangles(f, k)));
  }
  write_file_atomically(file, [&](std::ostream& stream) {
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  });
}

}  // namespace hyperex::io
