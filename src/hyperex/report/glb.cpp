// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/glb.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "hyperex/core/files.hpp"
#include "hyperex/report/skin_view.hpp"

namespace hyperex::report {
namespace {

using Eigen::Index;

/// Appends arrays to the one buffer of a glTF model, each with its own view and accessor.
class GltfArrays {
 public:
  explicit GltfArrays(tinygltf::Model& model) : model_(model) { model_.buffers.emplace_back(); }

  int view(const void* data, std::size_t bytes, int target = 0) {
    auto& buffer = model_.buffers[0].data;
    buffer.resize((buffer.size() + 3) / 4 * 4);
    tinygltf::BufferView out;
    out.buffer = 0;
    out.byteOffset = buffer.size();
    out.byteLength = bytes;
    out.target = target;
    const auto* first = static_cast<const unsigned char*>(data);
    buffer.insert(buffer.end(), first, first + bytes);
    model_.bufferViews.push_back(out);
    return static_cast<int>(model_.bufferViews.size()) - 1;
  }

  int accessor(int view, int component, int type, std::size_t count, bool normalised = false) {
    tinygltf::Accessor out;
    out.bufferView = view;
    out.componentType = component;
    out.type = type;
    out.count = count;
    out.normalized = normalised;
    model_.accessors.push_back(out);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  int vectors(const PointsF& rows, bool with_range) {
    const int at =
        accessor(view(rows.data(), rows.size() * sizeof(float), TINYGLTF_TARGET_ARRAY_BUFFER),
                 TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, rows.rows());
    if (with_range) {
      for (int k = 0; k < 3; ++k) {
        model_.accessors[at].minValues.push_back(rows.col(k).minCoeff());
        model_.accessors[at].maxValues.push_back(rows.col(k).maxCoeff());
      }
    }
    return at;
  }

  int scalars(const std::vector<float>& values, bool with_range) {
    const int at = accessor(view(values.data(), values.size() * sizeof(float)),
                            TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, values.size());
    if (with_range) {
      const auto [least, most] = std::minmax_element(values.begin(), values.end());
      model_.accessors[at].minValues = {*least};
      model_.accessors[at].maxValues = {*most};
    }
    return at;
  }

 private:
  tinygltf::Model& model_;
};

PointsF spread(const PointsF& skin, const std::vector<int>& skin_vertex) {
  PointsF out(static_cast<Index>(skin_vertex.size()), 3);
  for (std::size_t i = 0; i < skin_vertex.size(); ++i) out.row(i) = skin.row(skin_vertex[i]);
  return out;
}

/// D_k, |V| x 3 each, that minimise over all frames f the sum of squares of
/// sum_k w_fk D_k - (normals(f) - normals at rest): D = W^+ dN.
std::vector<PointsF> normal_modes(const PointsF& rest, const PointsF& rest_normals,
                                  const Triangles& triangles, const DisplacementModes& modes) {
  const Eigen::MatrixXf inverse =
      modes.weights.cast<double>().completeOrthogonalDecomposition().pseudoInverse().cast<float>();
  std::vector<PointsF> out(modes.modes.size(), PointsF::Zero(rest.rows(), 3));
  for (Index f = 0; f < modes.weights.rows(); ++f) {
    const PointsF change = vertex_normals(rest + modes.displacement(f), triangles) - rest_normals;
    for (std::size_t k = 0; k < out.size(); ++k) out[k] += inverse(k, f) * change;
  }
  return out;
}

/// glTF's COLOR_0 is linear, scans store sRGB; 16 bits keep the dark tones apart.
int add_colours(GltfArrays& arrays, const reenact::Performance& performance, const io::Scan& scan) {
  const auto srgb = skin_colour(performance, scan);
  if (srgb.rows() == 0) return -1;
  const auto linear = [](std::uint8_t byte) {
    const double s = byte / 255.0;
    const double l = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    return static_cast<std::uint16_t>(std::lround(65535 * l));
  };
  std::vector<std::uint16_t> values;
  values.reserve(srgb.size());
  for (Index v = 0; v < srgb.rows(); ++v) {
    for (int k = 0; k < 3; ++k) values.push_back(linear(srgb(v, k)));
    values.push_back(65535);  // a face is opaque, whatever a scanner left in alpha
  }
  const int view = arrays.view(values.data(), values.size() * 2, TINYGLTF_TARGET_ARRAY_BUFFER);
  return arrays.accessor(view, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4,
                         srgb.rows(), true);
}

int add_texture(tinygltf::Model& model, GltfArrays& arrays, const io::Image& picture) {
  tinygltf::Image image;
  image.mimeType = picture.mime_type;
  image.bufferView = arrays.view(picture.bytes.data(), picture.bytes.size());
  model.images.push_back(image);
  tinygltf::Sampler sampler;
  sampler.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
  sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
  model.samplers.push_back(sampler);
  tinygltf::Texture texture;
  texture.source = 0;
  texture.sampler = 0;
  model.textures.push_back(texture);
  return 0;
}

tinygltf::Material skin_material(bool coloured, int texture) {
  tinygltf::Material material;
  material.name = "skin";
  material.doubleSided = true;
  auto& pbr = material.pbrMetallicRoughness;
  pbr.metallicFactor = 0;
  pbr.roughnessFactor = 0.6;
  if (!coloured) pbr.baseColorFactor = {0.72, 0.45, 0.34, 1};  // linear; a light skin tone
  pbr.baseColorTexture.index = texture;
  return material;
}

void add_targets(tinygltf::Mesh& mesh, GltfArrays& arrays, const SkinView& view,
                 const PointsF& rest, const PointsF& rest_normals, const Triangles& skin_triangles,
                 const DisplacementModes& modes) {
  const auto normals = normal_modes(rest, rest_normals, skin_triangles, modes);
  tinygltf::Value::Array names;
  for (std::size_t k = 0; k < modes.modes.size(); ++k) {
    mesh.primitives[0].targets.push_back(
        {{"POSITION", arrays.vectors(spread(modes.modes[k], view.skin_vertex), true)},
         {"NORMAL", arrays.vectors(spread(normals[k], view.skin_vertex), false)}});
    mesh.weights.push_back(modes.weights(0, k));
    names.emplace_back("mode_" + std::to_string(k));
  }
  mesh.extras = tinygltf::Value(tinygltf::Value::Object{{"targetNames", tinygltf::Value(names)}});
}

tinygltf::Animation weights_animation(GltfArrays& arrays, const std::vector<double>& time_s,
                                      const Eigen::MatrixXf& weights) {
  std::vector<float> times, values;
  for (const double t : time_s) times.push_back(static_cast<float>(t - time_s.front()));
  for (Index f = 0; f < weights.rows(); ++f)
    for (Index k = 0; k < weights.cols(); ++k) values.push_back(weights(f, k));
  tinygltf::AnimationSampler sampler;
  sampler.input = arrays.scalars(times, true);
  sampler.output = arrays.scalars(values, false);
  sampler.interpolation = "LINEAR";
  tinygltf::AnimationChannel channel;
  channel.sampler = 0;
  channel.target_node = 0;
  channel.target_path = "weights";
  tinygltf::Animation animation;
  animation.name = "performance";
  animation.samplers.push_back(sampler);
  animation.channels.push_back(channel);
  return animation;
}

void check(const reenact::Performance& performance, const DisplacementModes& modes) {
  const auto frames = static_cast<Index>(performance.frame_time_s.size());
  if (!modes.modes.empty() && (modes.weights.rows() != frames ||
                               modes.modes[0].rows() != performance.skin_rest.points.rows()))
    throw std::invalid_argument("write_glb: the modes are not the performance's");
}

tinygltf::Model model_of(const reenact::Performance& performance, const io::Scan& scan,
                         const DisplacementModes& modes) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "hyperex";
  GltfArrays arrays(model);
  const SkinView view = skin_view(performance, scan);
  const PointsF rest = performance.skin_rest.points.cast<float>();
  const PointsF rest_normals = vertex_normals(rest, performance.skin_rest.triangles);

  tinygltf::Primitive skin;
  skin.mode = TINYGLTF_MODE_TRIANGLES;
  skin.attributes["POSITION"] = arrays.vectors(spread(rest, view.skin_vertex), true);
  skin.attributes["NORMAL"] = arrays.vectors(spread(rest_normals, view.skin_vertex), false);
  const int indices = arrays.view(view.triangles.data(), view.triangles.size() * sizeof(int),
                                  TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  skin.indices = arrays.accessor(indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                 TINYGLTF_TYPE_SCALAR, view.triangles.size());
  int texture = -1, colours = -1;
  if (view.uv.rows() > 0) {
    const int uv =
        arrays.view(view.uv.data(), view.uv.size() * sizeof(float), TINYGLTF_TARGET_ARRAY_BUFFER);
    skin.attributes["TEXCOORD_0"] =
        arrays.accessor(uv, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC2, view.uv.rows());
    texture = add_texture(model, arrays, *scan.texture);
  } else if ((colours = add_colours(arrays, performance, scan)) >= 0) {
    skin.attributes["COLOR_0"] = colours;
  }
  skin.material = 0;
  model.materials.push_back(skin_material(texture >= 0 || colours >= 0, texture));

  tinygltf::Mesh mesh;
  mesh.name = "skin";
  mesh.primitives.push_back(skin);
  if (!modes.modes.empty()) {
    add_targets(mesh, arrays, view, rest, rest_normals, performance.skin_rest.triangles, modes);
    model.animations.push_back(weights_animation(arrays, performance.frame_time_s, modes.weights));
  }
  model.meshes.push_back(mesh);
  tinygltf::Node node;
  node.name = "face";
  node.mesh = 0;
  model.nodes.push_back(node);
  tinygltf::Scene scene;
  scene.nodes.push_back(0);
  model.scenes.push_back(scene);
  model.defaultScene = 0;
  return model;
}

}  // namespace

void write_glb(const std::filesystem::path& file, const reenact::Performance& performance,
               const io::Scan& scan, const DisplacementModes& modes) {
  check(performance, modes);
  const tinygltf::Model model = model_of(performance, scan, modes);
  write_file_atomically(file, [&](std::ostream& stream) {
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, true);
  });
}

}  // namespace hyperex::report
