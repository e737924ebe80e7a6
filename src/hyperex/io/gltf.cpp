// SPDX-License-Identifier: GPL-3.0-or-later
// glTF 2.0 in, text or binary, through tinygltf: all triangles of the scene, placed by their
// nodes. Written files are made by the report room.
#include <fmt/format.h>
#include <tiny_gltf.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cstring>
#include <map>
#include <set>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/named_file.hpp"
#include "hyperex/core/remarks.hpp"
#include "hyperex/io/image.hpp"
#include "hyperex/io/nesting.hpp"
#include "hyperex/io/number.hpp"
#include "hyperex/io/raw_mesh.hpp"

namespace hyperex::io {
namespace {
static_assert(std::endian::native == std::endian::little);

/// Keeps pictures as encoded bytes. Those in a buffer are taken later, with a check of the range.
bool keep_encoded(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                  const unsigned char* bytes, int size, void*) {
  if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
  image->as_is = true;
  return true;
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return std::string(trimmed(text).substr(0, 200));
}

/// What tinygltf may see of the disk: files in the scan's folder or below.
struct Folder {
  std::filesystem::path path;
  std::string refusals;

  static bool holds(const std::string& name, void* self) {
    auto& folder = *static_cast<Folder*>(self);
    try {
      named_file(folder.path, std::filesystem::absolute(name).string());
      return true;
    } catch (const std::exception& refusal) {
      // It asks for a file beside the scan, then for one in the current folder.
      if (folder.refusals.empty()) folder.refusals = std::string("; ") + refusal.what();
      return false;
    }
  }
  static std::string as_it_is(const std::string& name, void*) { return name; }
  static bool read(std::vector<unsigned char>* bytes, std::string* error, const std::string& name,
                   void* self) {
    if (!holds(name, self)) return false;
    try {
      const std::string text = read_regular_file(name);
      bytes->assign(text.begin(), text.end());
      return true;
    } catch (const InputError& refusal) {
      *error += refusal.what();
      return false;
    }
  }
  static bool write_nothing(std::string*, const std::string&, const std::vector<unsigned char>&,
                            void*) {
    return false;
  }
};

/// The JSON of a file that begins as a binary one does; the file itself otherwise.
std::string_view json_of(const std::string& bytes, bool binary) {
  if (!binary) return bytes;
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data() + 12, 4);
  return std::string_view(bytes).substr(20, length);
}

tinygltf::Model load_model(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  const bool binary = bytes.starts_with("glTF");
  if (binary) {
    std::uint32_t length = 0;
    if (bytes.size() >= 12) std::memcpy(&length, bytes.data() + 8, 4);
    if (bytes.size() < 20 || bytes.size() < length)
      throw InputError(
          file, fmt::format("is torn: it has {} bytes; its header says {}", bytes.size(), length));
  }
  check_nesting_json(file, json_of(bytes, binary));
  Folder beside{file.parent_path(), {}};
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks(
      {&Folder::holds, &Folder::as_it_is, &Folder::read, &Folder::write_nothing, &beside});
  loader.SetImageLoader(&keep_encoded, nullptr);
  tinygltf::Model model;
  std::string error, warning;
  const auto size = static_cast<unsigned>(bytes.size());
  const std::string folder = file.parent_path().string();
  bool sound = false;
  try {
    sound = binary
                ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                              reinterpret_cast<const unsigned char*>(bytes.data()),
                                              size, folder)
                : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, folder);
  } catch (const std::exception& exception) {
    error = exception.what();
  }
  if (!sound) throw InputError(file, "is no sound glTF file: " + one_line(error) + beside.refusals);
  if (!warning.empty())
    remark(Remark::warning,
           fmt::format("{}: {}{}", file.string(), one_line(warning), beside.refusals));
  // Those that say how surfaces look leave the shape as it is; quantised values are read below.
  for (const auto& extension : model.extensionsRequired)
    if (!extension.starts_with("KHR_materials_") && extension != "KHR_mesh_quantization")
      throw InputError(file, fmt::format("requires the extension {}, which is not supported; "
                                         "expected plain triangles (export without compression)",
                                         quotable(extension)));
  return model;
}

/// Reads accessors, each checked against the bytes that are there.
class Accessors {
 public:
  Accessors(const std::filesystem::path& file, const tinygltf::Model& model)
      : file_(file), model_(model) {}

  std::size_t count(int id, const char* what) const { return accessor(id, what).count; }

  /// `columns` numbers an item, row-major; integers that stand for fractions are scaled.
  std::vector<double> read(int id, int columns, const char* what) const {
    const tinygltf::Accessor& a = accessor(id, what);
    const int stored = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(a.type));
    const int width =
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(a.componentType));
    if (a.sparse.isSparse || a.bufferView < 0)
      fail(id, what, "is sparse or empty; expected its values in a buffer view");
    if (stored < columns || stored > 4 || width <= 0)
      fail(id, what, fmt::format("has another type; expected {} numbers an item", columns));
    const auto [bytes, available] = view(a.bufferView, what);
    const std::size_t item = static_cast<std::size_t>(stored) * width;
    const std::size_t stride = model_.bufferViews[a.bufferView].byteStride
                                   ? model_.bufferViews[a.bufferView].byteStride
                                   : item;
    // count is checked by division: a torn or false file must not make us allocate.
    if (a.byteOffset > available || stride < item || available - a.byteOffset < item ||
        (a.count - 1) > (available - a.byteOffset - item) / stride)
      fail(id, what,
           fmt::format("needs {} items of {} bytes; its buffer view is too short", a.count, item));
    std::vector<double> values;
    values.reserve(a.count * columns);
    for (std::size_t i = 0; i < a.count; ++i)
      for (int k = 0; k < columns; ++k)
        values.push_back(
            number(bytes + a.byteOffset + i * stride + k * width, a.componentType, a.normalized));
    return values;
  }

  int columns(int id, const char* what) const {
    return tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor(id, what).type));
  }

  /// The bytes of a buffer view.
  std::pair<const unsigned char*, std::size_t> view(int id, const char* what) const {
    if (id < 0 || id >= static_cast<int>(model_.bufferViews.size()))
      throw InputError(file_, fmt::format("{}: there is no buffer view {}", what, id));
    const tinygltf::BufferView& v = model_.bufferViews[id];
    if (v.buffer < 0 || v.buffer >= static_cast<int>(model_.buffers.size()))
      throw InputError(file_, fmt::format("{}: there is no buffer {}", what, v.buffer));
    const auto& data = model_.buffers[v.buffer].data;
    if (v.byteOffset > data.size() || v.byteLength > data.size() - v.byteOffset)
      throw InputError(file_,
                       fmt::format("{}: buffer {} is too short: it has {} bytes, buffer view "
                                   "{} needs {} from {} on",
                                   what, v.buffer, data.size(), id, v.byteLength, v.byteOffset));
    return {data.data() + v.byteOffset, v.byteLength};
  }

 private:
  const tinygltf::Accessor& accessor(int id, const char* what) const {
    if (id < 0 || id >= static_cast<int>(model_.accessors.size()))
      throw InputError(file_, fmt::format("{}: there is no accessor {}", what, id));
    if (model_.accessors[id].count == 0) fail(id, what, "is empty; expected at least one item");
    return model_.accessors[id];
  }

  [[noreturn]] void fail(int id, const char* what, const std::string& why) const {
    throw InputError(file_, fmt::format("{}: accessor {} {}", what, id, why));
  }

  template <class T>
  static double load(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
  }

  static double number(const unsigned char* bytes, int type, bool normalized) {
    switch (type) {
      case TINYGLTF_COMPONENT_TYPE_BYTE:
        return normalized ? std::max(load<std::int8_t>(bytes) / 127, -1.)
                          : load<std::int8_t>(bytes);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return load<std::uint8_t>(bytes) / (normalized ? 255 : 1);
      case TINYGLTF_COMPONENT_TYPE_SHORT:
        return normalized ? std::max(load<std::int16_t>(bytes) / 32767, -1.)
                          : load<std::int16_t>(bytes);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return load<std::uint16_t>(bytes) / (normalized ? 65535 : 1);
      case TINYGLTF_COMPONENT_TYPE_INT:
        return load<std::int32_t>(bytes);
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return load<std::uint32_t>(bytes);
      case TINYGLTF_COMPONENT_TYPE_DOUBLE:
        return load<double>(bytes);
      default:
        return load<float>(bytes);
    }
  }

  const std::filesystem::path& file_;
  const tinygltf::Model& model_;
};

/// Walks the scene and joins what its nodes hold.
class SceneReader {
 public:
  SceneReader(const std::filesystem::path& file, const tinygltf::Model& model)
      : file_(file), model_(model), accessors_(file, model) {}

  RawMesh read() {
    for (const int root : roots()) visit(root, Eigen::Affine3d::Identity(), 1);
    raw_.points = Eigen::Map<const Points>(xyz_.data(), xyz_.size() / 3, 3);
    if (coloured_)
      raw_.vertex_colour = Eigen::Map<const VertexColours>(rgba_.data(), rgba_.size() / 4, 4);
    if (!textured_) raw_.corner_uv.clear();
    if (textured_ && texture_ >= 0) raw_.texture = picture();
    return std::move(raw_);
  }

 private:
  std::vector<int> roots() const {
    const int scene = std::max(model_.defaultScene, 0);
    if (scene < static_cast<int>(model_.scenes.size())) return model_.scenes[scene].nodes;
    // A file without scenes: every node that is no other's child.
    std::set<int> children;
    for (const auto& node : model_.nodes)
      children.insert(node.children.begin(), node.children.end());
    std::vector<int> found;
    for (int n = 0; n < static_cast<int>(model_.nodes.size()); ++n)
      if (!children.contains(n)) found.push_back(n);
    return found;
  }

  static Eigen::Affine3d parent_from_node(const tinygltf::Node& node) {
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    if (node.matrix.size() == 16) {
      transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
      return transform;
    }
    if (node.translation.size() == 3)
      transform.translate(Vec3(node.translation[0], node.translation[1], node.translation[2]));
    if (node.rotation.size() == 4)
      transform.rotate(
          Eigen::Quaterniond(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2])
              .normalized());
    if (node.scale.size() == 3) transform.scale(Vec3(node.scale[0], node.scale[1], node.scale[2]));
    return transform;
  }

  void visit(int id, const Eigen::Affine3d& scene_from_parent, int depth) {
    constexpr int deepest = 256;
    if (depth > deepest)
      throw InputError(file_, fmt::format("its nodes are nested deeper than {} levels", deepest));
    if (id < 0 || id >= static_cast<int>(model_.nodes.size()))
      throw InputError(file_, fmt::format("its scene names node {}; expected 0 to {}", id,
                                          int(model_.nodes.size()) - 1));
    if (!visited_.insert(id).second)
      throw InputError(file_, fmt::format("node {} hangs in the scene twice; expected a tree", id));
    const tinygltf::Node& node = model_.nodes[id];
    const Eigen::Affine3d scene_from_node = scene_from_parent * parent_from_node(node);
    if (node.mesh >= static_cast<int>(model_.meshes.size()))
      throw InputError(file_,
                       fmt::format("node {} names mesh {}, which is not there", id, node.mesh));
    if (node.mesh >= 0) {
      first_vertex_.clear();
      for (const auto& primitive : model_.meshes[node.mesh].primitives)
        add(primitive, scene_from_node);
    }
    for (const int child : node.children) visit(child, scene_from_node, depth + 1);
  }

  void add(const tinygltf::Primitive& primitive, const Eigen::Affine3d& scene_from_node) {
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (mode != TINYGLTF_MODE_TRIANGLES && mode != TINYGLTF_MODE_TRIANGLE_STRIP &&
        mode != TINYGLTF_MODE_TRIANGLE_FAN)
      return;  // points and lines are no skin
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) return;
    const std::size_t vertices = accessors_.count(position->second, "POSITION");
    // Parts of one face often share their vertices: they stay joined.
    const auto [known, is_new] = first_vertex_.try_emplace(position->second, xyz_.size() / 3);
    if (is_new) add_vertices(primitive, position->second, vertices, scene_from_node);
    const std::int64_t first = static_cast<std::int64_t>(known->second);

    std::vector<std::int64_t> index = indices(primitive, vertices);
    const std::vector<double> uv = texture_coordinates(primitive, vertices);
    const bool mirrored = scene_from_node.linear().determinant() < 0;
    const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
      if (mirrored) std::swap(b, c);
      for (const std::size_t k : {a, b, c}) {
        const std::int64_t i = index[k];
        raw_.corner.push_back(first + i);
        raw_.corner_uv.push_back(uv.empty() ? 0.f : static_cast<float>(uv[2 * i]));
        raw_.corner_uv.push_back(uv.empty() ? 0.f : static_cast<float>(uv[2 * i + 1]));
      }
      raw_.end_face();
    };
    if (mode == TINYGLTF_MODE_TRIANGLES) {
      if (index.size() % 3)
        throw InputError(file_, fmt::format("a list of triangles has {} indices; expected a "
                                            "multiple of 3",
                                            index.size()));
      for (std::size_t k = 0; k < index.size(); k += 3) triangle(k, k + 1, k + 2);
    } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
      for (std::size_t k = 0; k + 2 < index.size(); ++k) triangle(k, k + 1 + k % 2, k + 2 - k % 2);
    } else {
      for (std::size_t k = 1; k + 1 < index.size(); ++k) triangle(0, k, k + 1);
    }
  }

  void add_vertices(const tinygltf::Primitive& primitive, int position, std::size_t vertices,
                    const Eigen::Affine3d& scene_from_node) {
    const std::vector<double> xyz = accessors_.read(position, 3, "POSITION");
    for (std::size_t i = 0; i < vertices; ++i) {
      const Vec3 p = scene_from_node * Vec3(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
      xyz_.insert(xyz_.end(), {p.x(), p.y(), p.z()});
    }
    const auto colour = primitive.attributes.find("COLOR_0");
    if (colour == primitive.attributes.end()) {
      rgba_.resize(rgba_.size() + 4 * vertices, 255);
      return;
    }
    coloured_ = true;
    const int columns = std::min(accessors_.columns(colour->second, "COLOR_0"), 4);
    const std::vector<double> values =
        accessors_.read(colour->second, std::max(columns, 3), "COLOR_0");
    if (values.size() != vertices * columns)
      throw InputError(file_, "COLOR_0 has another number of items than POSITION");
    for (std::size_t i = 0; i < vertices; ++i)
      for (int k = 0; k < 4; ++k) {
        const double value = k < columns ? values[i * columns + k] : 1;
        rgba_.push_back(
            static_cast<std::uint8_t>(255 * (value > 0 ? std::min(value, 1.) : 0.) + .5));
      }
  }

  std::vector<std::int64_t> indices(const tinygltf::Primitive& primitive, std::size_t vertices) {
    std::vector<std::int64_t> index;
    if (primitive.indices < 0) {
      for (std::size_t i = 0; i < vertices; ++i) index.push_back(static_cast<std::int64_t>(i));
      return index;
    }
    for (const double value : accessors_.read(primitive.indices, 1, "indices")) {
      if (!(value >= 0 && value < static_cast<double>(vertices)))
        throw InputError(file_,
                         fmt::format("triangle {} of a primitive names vertex {}; expected 0 "
                                     "to {}",
                                     index.size() / 3, value, vertices - 1));
      index.push_back(static_cast<std::int64_t>(value));
    }
    return index;
  }

  /// 2 a vertex; empty where the primitive has none. Notes the first textured primitive's picture.
  std::vector<double> texture_coordinates(const tinygltf::Primitive& primitive,
                                          std::size_t vertices) {
    int set = 0, texture = -1;
    if (primitive.material >= 0 && primitive.material < static_cast<int>(model_.materials.size())) {
      const auto& info = model_.materials[primitive.material].pbrMetallicRoughness.baseColorTexture;
      set = std::max(info.texCoord, 0);
      texture = info.index;
    }
    const auto attribute = primitive.attributes.find(fmt::format("TEXCOORD_{}", set));
    if (attribute == primitive.attributes.end()) return {};
    std::vector<double> uv = accessors_.read(attribute->second, 2, "TEXCOORD");
    if (uv.size() != 2 * vertices)
      throw InputError(file_, "TEXCOORD has another number of items than POSITION");
    textured_ = true;
    if (texture >= 0 && texture_ >= 0 && texture != texture_ && !warned_) {
      remark(Remark::warning,
             fmt::format("{}: has several textures; only the first is kept", file_.string()));
      warned_ = true;
    }
    if (texture_ < 0) texture_ = texture;
    return uv;
  }

  std::optional<Image> picture() const {
    if (texture_ >= static_cast<int>(model_.textures.size()))
      throw InputError(file_,
                       fmt::format("a material names texture {}, which is not there", texture_));
    const int source = model_.textures[texture_].source;
    if (source < 0 || source >= static_cast<int>(model_.images.size())) return std::nullopt;
    const tinygltf::Image& image = model_.images[source];
    std::vector<std::uint8_t> bytes = image.image;
    if (image.bufferView >= 0) {
      const auto [begin, size] = accessors_.view(image.bufferView, "texture");
      bytes.assign(begin, begin + size);
    }
    auto picture = recognise_image(std::move(bytes));
    if (!picture)
      remark(
          Remark::warning,
          fmt::format("{}: going on without its texture, which is missing or neither PNG nor JPEG",
                      file_.string()));
    return picture;
  }

  const std::filesystem::path& file_;
  const tinygltf::Model& model_;
  Accessors accessors_;
  RawMesh raw_;
  std::vector<double> xyz_;
  std::vector<std::uint8_t> rgba_;
  std::map<int, std::size_t> first_vertex_;  ///< by POSITION accessor, within one node
  std::set<int> visited_;
  bool coloured_ = false, textured_ = false, warned_ = false;
  int texture_ = -1;
};

}  // namespace

RawMesh read_gltf(const std::filesystem::path& file) {
  const tinygltf::Model model = load_model(file);
  return SceneReader(file, model).read();
}

}  // namespace hyperex::io
