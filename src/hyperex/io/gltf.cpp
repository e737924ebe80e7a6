// SPDX-License-Identifier: GPL-3.0-or-later
// Reads glTF 2.0, text or binary, through tinygltf: all triangles of the scene, transformed by
// their nodes. Writing glTF is in src/hyperex/report.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "hyperex/core/error.hpp"
#include "hyperex/core/remarks.hpp"
#include "hyperex/io/gltf_accessors.hpp"
#include "hyperex/io/gltf_file.hpp"
#include "hyperex/io/gltf_shapes.hpp"
#include "hyperex/io/image.hpp"
#include "hyperex/io/raw_mesh.hpp"

namespace hyperex::io {
namespace {

/// Traverses the scene and joins the meshes of its nodes.
class SceneReader {
 public:
  SceneReader(const std::filesystem::path& file, const tinygltf::Model& model)
      : file_(file), model_(model), accessors_(file, model) {}

  /// The primitive with morph targets that has the most triangles, as a mesh of its own.
  ShapedMesh read_shapes() {
    walk([&](const tinygltf::Mesh& mesh, const Eigen::Affine3d& scene_from_node) {
      note_shaped(mesh, scene_from_node);
    });
    if (!shaped_) throw InputError(file_, "has no mesh with named morph targets; expected a rig");
    const auto [primitive, mesh, scene_from_node] = *shaped_;
    add(*primitive, scene_from_node);
    raw_.points = Eigen::Map<const Points>(xyz_.data(), xyz_.size() / 3, 3);
    raw_.corner_uv.clear();
    const std::size_t vertices = xyz_.size() / 3;
    ShapedMesh out;
    out.shapes = shapes_of(*primitive, names_of(*mesh), vertices, scene_from_node.linear());
    out.mesh = triangulated(file_, std::move(raw_)).mesh;
    out.landmarks = landmarks_of(*mesh, scene_from_node);
    return out;
  }

  RawMesh read() {
    walk([&](const tinygltf::Mesh& mesh, const Eigen::Affine3d& scene_from_node) {
      first_vertex_.clear();
      for (const auto& primitive : mesh.primitives) add(primitive, scene_from_node);
    });
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
    // A file without scenes: all nodes that are not children of another node.
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

  /// Takes the mesh of a node, where its transforms place it.
  using TakeMesh = std::function<void(const tinygltf::Mesh&, const Eigen::Affine3d&)>;

  void walk(const TakeMesh& take) {
    for (const int root : roots()) visit(root, Eigen::Affine3d::Identity(), 1, take);
  }

  /// The names of a mesh's morph targets; none where it has no list of them.
  static std::vector<std::string> names_of(const tinygltf::Mesh& mesh) {
    std::vector<std::string> names;
    if (!mesh.extras.IsObject() || !mesh.extras.Has("targetNames")) return names;
    const tinygltf::Value& listed = mesh.extras.Get("targetNames");
    for (std::size_t k = 0; listed.IsArray() && k < listed.ArrayLen(); ++k) {
      const tinygltf::Value& name = listed.Get(static_cast<int>(k));
      names.push_back(name.IsString() ? name.Get<std::string>() : "");
    }
    return names;
  }

  Landmarks landmarks_of(const tinygltf::Mesh& mesh, const Eigen::Affine3d& scene_from_node) const {
    Landmarks landmarks;
    if (!mesh.extras.IsObject() || !mesh.extras.Has("landmarks_m")) return landmarks;
    const tinygltf::Value& listed = mesh.extras.Get("landmarks_m");
    const auto expect = [&](bool right) {
      if (!right)
        throw InputError(file_,
                         "landmarks_m of its mesh: expected an object of names with three numbers");
    };
    expect(listed.IsObject());
    for (const std::string& name : listed.Keys()) {
      const tinygltf::Value& at = listed.Get(name);
      expect(at.IsArray() && at.ArrayLen() == 3);
      Vec3 place;
      for (int k = 0; k < 3; ++k) {
        expect(at.Get(k).IsNumber());
        place[k] = at.Get(k).GetNumberAsDouble();
      }
      expect(place.allFinite());
      landmarks[name] = scene_from_node * place;
    }
    return landmarks;
  }

  void note_shaped(const tinygltf::Mesh& mesh, const Eigen::Affine3d& scene_from_node) {
    if (names_of(mesh).empty()) return;
    for (const auto& primitive : mesh.primitives) {
      const auto position = primitive.attributes.find("POSITION");
      if (primitive.targets.empty() || position == primitive.attributes.end()) continue;
      const std::size_t corners = primitive.indices < 0
                                      ? accessors_.count(position->second, "POSITION")
                                      : accessors_.count(primitive.indices, "indices");
      if (shaped_ && corners <= most_corners_) continue;
      most_corners_ = corners;
      shaped_ = Shaped{&primitive, &mesh, scene_from_node};
    }
  }

  std::vector<MorphShape> shapes_of(const tinygltf::Primitive& primitive,
                                    const std::vector<std::string>& names, std::size_t vertices,
                                    const Eigen::Matrix3d& turn) const {
    std::vector<MorphShape> shapes;
    for (std::size_t k = 0; k < std::min(names.size(), primitive.targets.size()); ++k) {
      const auto position = primitive.targets[k].find("POSITION");
      if (names[k].empty() || position == primitive.targets[k].end()) continue;
      const auto xyz = accessors_.read_sparse(position->second, 3, vertices, "a morph target");
      const Points rows = Eigen::Map<const Points>(xyz.data(), Eigen::Index(vertices), 3);
      if (!rows.allFinite())
        throw InputError(
            file_, fmt::format("the morph target {} has a number that is not finite", names[k]));
      shapes.push_back({names[k], (rows * turn.transpose()).cast<float>()});
    }
    return shapes;
  }

  void visit(int id, const Eigen::Affine3d& scene_from_parent, int depth, const TakeMesh& take) {
    constexpr int deepest = 256;
    if (depth > deepest)
      throw InputError(file_, fmt::format("its nodes are nested deeper than {} levels", deepest));
    if (id < 0 || id >= static_cast<int>(model_.nodes.size()))
      throw InputError(file_, fmt::format("its scene names node {}; expected 0 to {}", id,
                                          int(model_.nodes.size()) - 1));
    if (!visited_.insert(id).second)
      throw InputError(file_, fmt::format("node {} is in the scene twice; expected a tree", id));
    const tinygltf::Node& node = model_.nodes[id];
    const Eigen::Affine3d scene_from_node = scene_from_parent * parent_from_node(node);
    if (node.mesh >= static_cast<int>(model_.meshes.size()))
      throw InputError(file_,
                       fmt::format("node {} names mesh {}, which is not there", id, node.mesh));
    if (node.mesh >= 0) take(model_.meshes[node.mesh], scene_from_node);
    for (const int child : node.children) visit(child, scene_from_node, depth + 1, take);
  }

  void add(const tinygltf::Primitive& primitive, const Eigen::Affine3d& scene_from_node) {
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (mode != TINYGLTF_MODE_TRIANGLES && mode != TINYGLTF_MODE_TRIANGLE_STRIP &&
        mode != TINYGLTF_MODE_TRIANGLE_FAN)
      return;  // points and lines are not surfaces
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) return;
    const std::size_t vertices = accessors_.count(position->second, "POSITION");
    // Several primitives of one face often share their vertices; these stay shared.
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

  /// 2 numbers per vertex; empty if the primitive has none. Stores the image of the first textured
  /// primitive.
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

  struct Shaped {
    const tinygltf::Primitive* primitive;
    const tinygltf::Mesh* mesh;
    Eigen::Affine3d scene_from_node;
  };

  const std::filesystem::path& file_;
  const tinygltf::Model& model_;
  GltfAccessors accessors_;
  std::optional<Shaped> shaped_;
  std::size_t most_corners_ = 0;
  RawMesh raw_;
  std::vector<double> xyz_;
  std::vector<std::uint8_t> rgba_;
  std::map<int, std::size_t> first_vertex_;  ///< key: POSITION accessor, within one node
  std::set<int> visited_;
  bool coloured_ = false, textured_ = false, warned_ = false;
  int texture_ = -1;
};

}  // namespace

RawMesh read_gltf(const std::filesystem::path& file) {
  const tinygltf::Model model = load_gltf(file);
  return SceneReader(file, model).read();
}

ShapedMesh read_gltf_shapes(const std::filesystem::path& file) {
  const tinygltf::Model model = load_gltf(file);
  return SceneReader(file, model).read_shapes();
}

}  // namespace hyperex::io
