// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/glb.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hyperex/core/files.hpp"
#include "hyperex/report/gltf_parts.hpp"
#include "hyperex/report/skin_view.hpp"

namespace hyperex::report {
namespace {

using Eigen::Index;

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

void check(const reenact::Performance& performance) {
  bool whole = performance.skin_displacement_m.size() == performance.frame_time_s.size();
  for (const PointsF& frame : performance.skin_displacement_m)
    whole = whole && frame.rows() == performance.skin_rest.points.rows();
  if (!whole) throw std::invalid_argument("write_glb: frames that are not the performance's");
}

tinygltf::Model model_of(const reenact::Performance& performance, const io::Scan& scan,
                         const GlbOptions& options, GlbReport& report) {
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
  skin.indices = arrays.triangles(view.triangles);
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
  const bool moves =
      std::any_of(performance.skin_displacement_m.begin(), performance.skin_displacement_m.end(),
                  [](const PointsF& frame) { return !frame.isZero(0); });
  if (moves) {
    const double copies = double(view.skin_vertex.size()) / double(rest.rows());
    const PoseTargets targets = pose_targets(performance.skin_rest, performance.skin_displacement_m,
                                             performance.frame_time_s, options.tolerance_m,
                                             options.max_bytes - double(arrays.bytes()), copies);
    report.keys = targets.names.size();
    report.max_error_m = targets.keys.max_error_m;
    add_morph_targets(mesh, arrays, targets, view.skin_vertex);
    tinygltf::Animation animation;
    animation.name = "performance";
    const double start_s = performance.frame_time_s.front();
    const int times = arrays.times(performance.frame_time_s, start_s);
    animate(animation, 0, "weights", times, arrays.rows_as_scalars(targets.keys.weights));
    model.animations.push_back(animation);
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

GlbReport write_glb(const std::filesystem::path& file, const reenact::Performance& performance,
                    const io::Scan& scan, const GlbOptions& options) {
  check(performance);
  GlbReport report;
  const tinygltf::Model model = model_of(performance, scan, options, report);
  write_file_atomically(file, [&](std::ostream& stream) {
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, true);
    report.bytes = static_cast<double>(stream.tellp());
  });
  return report;
}

}  // namespace hyperex::report
