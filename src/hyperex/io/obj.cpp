// SPDX-License-Identifier: GPL-3.0-or-later
// Wavefront OBJ through tinyobjloader. That library reads invalid numbers as 0, so every line in
// use is checked first.
#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <sstream>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/named_file.hpp"
#include "hyperex/core/remarks.hpp"
#include "hyperex/io/image.hpp"
#include "hyperex/io/number.hpp"
#include "hyperex/io/raw_mesh.hpp"

namespace hyperex::io {
namespace {
constexpr std::size_t most_corners = 255;  // tinyobjloader stores this number in one byte

class LineChecker {
 public:
  LineChecker(const std::filesystem::path& file, const std::string& text)
      : file_(file), lines_(text) {}

  /// The text without comments at the ends of vertex and face lines, which tinyobjloader cannot
  /// parse.
  std::string check() {
    std::string checked;
    std::string_view line;
    while (lines_.next(line)) {
      if (const auto kind = trimmed(line); kind.starts_with('v') || kind.starts_with("f"))
        line = line.substr(0, line.find('#'));
      checked.append(line).append("\n");
      const auto word = words(line);
      if (word.empty()) continue;
      if (word[0] == "v") {
        check_numbers(word, 3);
        ++vertices_;
      } else if (word[0] == "vt") {
        check_numbers(word, 2);
        ++texcoords_;
      } else if (word[0] == "f") {
        check_face(line, word);
      }
    }
    // A face may precede its vertices, so such references are checked at the end.
    for (const Reference& open : forward_) {
      const long long count = open.is_texcoord ? texcoords_ : vertices_;
      if (open.index > count)
        fail(open.line, std::to_string(open.index), range_text(open.is_texcoord, count));
    }
    return checked;
  }

 private:
  struct Reference {
    int line;
    long long index;
    bool is_texcoord;
  };

  [[noreturn]] void fail(int line, std::string_view found, const std::string& expected) const {
    throw InputError({file_, line, "", quotable(trimmed(found)), expected});
  }

  static std::string range_text(bool is_texcoord, long long count) {
    return fmt::format("the index of a {} from 1 to {}",
                       is_texcoord ? "texture coordinate" : "vertex", count);
  }

  void check_numbers(const std::vector<std::string_view>& word, std::size_t needed) const {
    if (word.size() < 1 + needed)
      fail(lines_.number(), word[0],
           fmt::format("{} numbers behind it, not {}", needed, word.size() - 1));
    for (std::size_t k = 1; k < word.size(); ++k) {
      const auto number = parse_number(word[k]);
      if (!number || !std::isfinite(*number)) fail(lines_.number(), word[k], "a finite number");
    }
  }

  void check_face(std::string_view line, const std::vector<std::string_view>& word) {
    const std::size_t corners = word.size() - 1;
    if (corners < 3 || corners > most_corners)
      fail(lines_.number(), line, fmt::format("a face of 3 to {} corners", most_corners));
    for (std::size_t k = 1; k <= corners; ++k) {
      const auto part = split(word[k], '/');
      if (part.size() > 3) fail(lines_.number(), word[k], "vertex, vertex/texture or v/t/normal");
      check_index(word[k], part[0], false, vertices_);
      if (part.size() > 1 && !part[1].empty()) check_index(word[k], part[1], true, texcoords_);
      if (part.size() > 2 && !parse_integer(part[2]))
        fail(lines_.number(), word[k], "a whole number behind the second \"/\"");
    }
  }

  void check_index(std::string_view corner, std::string_view text, bool is_texcoord,
                   long long count) {
    const auto index = parse_integer(text);
    if (!index || *index == 0 || *index < -count)
      fail(lines_.number(), corner, range_text(is_texcoord, count));
    if (*index > count) forward_.push_back({lines_.number(), *index, is_texcoord});
  }

  const std::filesystem::path& file_;
  Lines lines_;
  long long vertices_ = 0, texcoords_ = 0;
  std::vector<Reference> forward_;
};

/// Reads material files beside the scan only.
class MaterialReader : public tinyobj::MaterialReader {
 public:
  explicit MaterialReader(std::filesystem::path folder) : folder_(std::move(folder)) {}

  bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                  std::map<std::string, int>* numbers, std::string* warning,
                  std::string* error) override {
    std::string text;
    try {
      text = read_regular_file(named_file(folder_, name));
    } catch (const InputError& refusal) {
      *warning += std::string(refusal.what()) + "\n";
      return false;
    }
    std::istringstream stream(text);
    stream.exceptions(std::ios::badbit);
    tinyobj::LoadMtl(numbers, materials, &stream, warning, error);
    return true;
  }

 private:
  std::filesystem::path folder_;
};

std::string one_obj_line(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// The texture of the material of the first textured face.
std::optional<Image> find_texture(const std::filesystem::path& file,
                                  const std::vector<tinyobj::shape_t>& shapes,
                                  const std::vector<tinyobj::material_t>& materials) {
  std::vector<std::string> names;  // distinct, in the order of the faces
  for (const auto& shape : shapes)
    for (const int m : shape.mesh.material_ids)
      if (m >= 0 && m < static_cast<int>(materials.size()) &&
          !materials[m].diffuse_texname.empty() &&
          std::find(names.begin(), names.end(), materials[m].diffuse_texname) == names.end())
        names.push_back(materials[m].diffuse_texname);
  if (names.empty()) return std::nullopt;
  if (names.size() > 1)
    remark(Remark::warning, fmt::format("{}: has {} textures; only the first, {}, is kept",
                                        file.string(), names.size(), names[0]));
  return load_texture(file, names[0]);
}

void take_vertices(const tinyobj::attrib_t& attributes, RawMesh& raw) {
  const auto count = static_cast<Eigen::Index>(attributes.vertices.size() / 3);
  raw.points = Eigen::Map<const Points>(attributes.vertices.data(), count, 3);
  if (count == 0 || attributes.colors.size() != attributes.vertices.size()) return;
  const Eigen::Map<const Points> colours(attributes.colors.data(), count, 3);
  // By convention 0 to 1; some programs write 0 to 255.
  const double scale = colours.maxCoeff() > 1 ? 1 : 255;
  raw.vertex_colour.resize(count, 4);
  raw.vertex_colour.col(3).setConstant(255);
  raw.vertex_colour.leftCols<3>() =
      (colours * scale).array().round().max(0).min(255).cast<std::uint8_t>().matrix();
}

}  // namespace

RawMesh read_obj(const std::filesystem::path& file) {
  const std::string text = LineChecker(file, read_file(file)).check();

  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning, error;
  std::istringstream stream(text);
  stream.exceptions(std::ios::badbit);  // else a lack of memory reads like the end of the file
  MaterialReader material_reader(file.parent_path());
  const bool sound = tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &stream,
                                      &material_reader, false, false);
  if (!sound) throw InputError(file, "is no sound OBJ file: " + one_obj_line(error));
  if (!warning.empty())
    remark(Remark::warning, fmt::format("{}: {}", file.string(), one_obj_line(warning)));

  RawMesh raw;
  take_vertices(attributes, raw);
  const bool textured = !attributes.texcoords.empty();
  for (const auto& shape : shapes) {
    std::size_t at = 0;
    for (const auto corners : shape.mesh.num_face_vertices) {
      for (std::size_t k = 0; k < corners; ++k, ++at) {
        const tinyobj::index_t& index = shape.mesh.indices[at];
        raw.corner.push_back(index.vertex_index);
        if (!textured) continue;
        const int t = index.texcoord_index;  // -1 where the corner has none
        raw.corner_uv.push_back(t < 0 ? 0.f : static_cast<float>(attributes.texcoords[2 * t]));
        raw.corner_uv.push_back(t < 0 ? 0.f
                                      : static_cast<float>(1 - attributes.texcoords[2 * t + 1]));
      }
      raw.end_face();
    }
  }
  if (textured) raw.texture = find_texture(file, shapes, materials);
  return raw;
}

}  // namespace hyperex::io
