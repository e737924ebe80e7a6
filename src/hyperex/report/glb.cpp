// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/glb.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hyperex/core/files.hpp"
#include "hyperex/report/face_backing.hpp"
#include "hyperex/report/gltf_parts.hpp"
#include "hyperex/report/jaw_turns.hpp"
#include "hyperex/report/skin_view.hpp"

namespace hyperex::report {
namespace {

using Eigen::Index;

/// glTF's COLOR_0 is linear; 16 bits keep the dark tones apart. -1 where there are none.
template <class Rows>
int add_colours(GltfArrays& arrays, const Rows& srgb) {
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

tinygltf::Material plain_material(const char* name, std::vector<double> colour, double roughness) {
  tinygltf::Material material;
  material.name = name;
  material.pbrMetallicRoughness.metallicFactor = 0;
  material.pbrMetallicRoughness.roughnessFactor = roughness;
  material.pbrMetallicRoughness.baseColorFactor = std::move(colour);
  return material;
}

/// Adds a node with crowns and gum of one jaw; its number, -1 where there are none.
int add_teeth(tinygltf::Model& model, GltfArrays& arrays, const anatomy::JawTeeth& jaw,
              const std::string& name, int first_material) {
  tinygltf::Mesh mesh;
  mesh.name = name;
  for (const TriMesh* part : {&jaw.crowns, &jaw.gum}) {
    if (part->triangles.rows() == 0) continue;
    const PointsF points = part->points.cast<float>();
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = arrays.vectors(points, true);
    primitive.attributes["NORMAL"] = arrays.vectors(vertex_normals(points, part->triangles), false);
    primitive.indices = arrays.triangles(part->triangles);
    primitive.material = first_material + (part == &jaw.gum ? 1 : 0);
    mesh.primitives.push_back(std::move(primitive));
  }
  if (mesh.primitives.empty()) return -1;
  model.meshes.push_back(std::move(mesh));
  tinygltf::Node node;
  node.name = name;
  node.mesh = static_cast<int>(model.meshes.size()) - 1;
  model.nodes.push_back(node);
  return static_cast<int>(model.nodes.size()) - 1;
}

/// A node for each eyeball, in the colours of the report's (web/src/replay/face/backing.ts), which
/// are linear here.
void add_eyes(tinygltf::Model& model, GltfArrays& arrays, const std::vector<Eyeball>& eyeballs) {
  if (eyeballs.empty()) return;
  const int first = static_cast<int>(model.materials.size());
  model.materials.push_back(plain_material("sclera", {0.85, 0.82, 0.78, 1}, 0.35));
  model.materials.push_back(plain_material("iris", {0.153, 0.105, 0.065, 1}, 0.35));
  model.materials.push_back(plain_material("pupil", {0.007, 0.006, 0.005, 1}, 0.35));
  for (std::size_t side = 0; side < eyeballs.size(); ++side) {
    const Eyeball& eye = eyeballs[side];
    tinygltf::Mesh mesh;
    mesh.name = side == 0 ? "eye_R" : "eye_L";
    for (const TriMesh& part : eyeball_parts(eye)) {
      tinygltf::Primitive primitive;
      primitive.mode = TINYGLTF_MODE_TRIANGLES;
      const Points out = (part.points.rowwise() - eye.centre.transpose()) / eye.radius_m;
      primitive.attributes["POSITION"] = arrays.vectors(part.points.cast<float>(), true);
      primitive.attributes["NORMAL"] = arrays.vectors(out.cast<float>(), false);
      primitive.indices = arrays.triangles(part.triangles);
      primitive.material = first + static_cast<int>(mesh.primitives.size());
      mesh.primitives.push_back(std::move(primitive));
    }
    tinygltf::Node node;
    node.name = mesh.name;
    node.mesh = static_cast<int>(model.meshes.size());
    model.meshes.push_back(std::move(mesh));
    model.nodes.push_back(node);
  }
}

/// Rotation and translation of a node as the jaw's in each frame.
void animate_jaw(tinygltf::Model& model, GltfArrays& arrays, int node,
                 const simulate::Performance& performance, tinygltf::Animation& animation) {
  const auto frames = static_cast<Index>(performance.jaw_now_from_rest.size());
  Eigen::MatrixXf turns(frames, 4), shifts(frames, 3);
  Eigen::Quaterniond before = Eigen::Quaterniond::Identity();
  for (Index f = 0; f < frames; ++f) {
    const Eigen::Isometry3d& jaw = performance.jaw_now_from_rest[std::size_t(f)];
    before = near_to(before, jaw.linear());
    turns.row(f) = before.coeffs().cast<float>().transpose();  // x y z w
    shifts.row(f) = jaw.translation().cast<float>().transpose();
  }
  const int times = arrays.times(performance.frame_time_s, performance.frame_time_s.front());
  animate(animation, node, "rotation", times, arrays.rows_as_vectors(turns));
  animate(animation, node, "translation", times, arrays.rows_as_vectors(shifts));
  for (int k = 0; k < 4; ++k) model.nodes[std::size_t(node)].rotation.push_back(turns(0, k));
  for (int k = 0; k < 3; ++k) model.nodes[std::size_t(node)].translation.push_back(shifts(0, k));
}

void check_glb(const simulate::Performance& performance, const GlbOptions& options) {
  bool whole = performance.skin_displacement_m.size() == performance.frame_time_s.size();
  for (const PointsF& frame : performance.skin_displacement_m)
    whole = whole && frame.rows() == performance.skin_rest.points.rows();
  if (options.teeth)
    whole = whole && performance.jaw_now_from_rest.size() == performance.frame_time_s.size();
  if (!whole) throw std::invalid_argument("write_glb: frames that are not the performance's");
}

/// The skin at rest with its material, the first of the model.
tinygltf::Primitive skin_primitive(tinygltf::Model& model, GltfArrays& arrays, const SkinView& view,
                                   const simulate::Performance& performance, const io::Scan& scan) {
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
  } else if ((colours = add_colours(arrays, skin_colour(performance, scan))) >= 0) {
    skin.attributes["COLOR_0"] = colours;
  }
  skin.material = 0;
  model.materials.push_back(skin_material(texture >= 0 || colours >= 0, texture));
  return skin;
}

/// The pockets of all openings for a skin at `points`, one after the other.
TriMesh pockets(const std::vector<Opening>& openings, const Points& points) {
  TriMesh all;
  for (const Opening& opening : openings) {
    const TriMesh one = pocket(opening, points);
    const Index vertices = all.points.rows(), triangles = all.triangles.rows();
    all.points.conservativeResize(vertices + one.points.rows(), 3);
    all.points.bottomRows(one.points.rows()) = one.points;
    all.triangles.conservativeResize(triangles + one.triangles.rows(), 3);
    all.triangles.bottomRows(one.triangles.rows()) = one.triangles.array() + int(vertices);
  }
  return all;
}

/// Dark pockets behind the openings: a part of the skin's mesh, as they go along with its poses.
/// Unlit, as on the page: no light falls into a mouth.
tinygltf::Primitive cavity_primitive(tinygltf::Model& model, GltfArrays& arrays,
                                     const std::vector<Opening>& openings, const TriMesh& mesh) {
  Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 3, Eigen::RowMajor> srgb(mesh.points.rows(), 3);
  Index row = 0;
  for (const Opening& opening : openings) {
    const auto edge = Index(opening.loop.size());
    for (Index i = 0; i <= 3 * edge; ++i, ++row)
      for (int k = 0; k < 3; ++k)
        srgb(row, k) = kPocketColours[std::size_t(std::min(i / edge, Index(2)))][std::size_t(k)];
  }
  tinygltf::Primitive cavity;
  cavity.mode = TINYGLTF_MODE_TRIANGLES;
  cavity.attributes["POSITION"] = arrays.vectors(mesh.points.cast<float>(), true);
  cavity.attributes["COLOR_0"] = add_colours(arrays, srgb);
  cavity.indices = arrays.triangles(mesh.triangles);
  cavity.material = static_cast<int>(model.materials.size());
  tinygltf::Material material = plain_material("cavity", {1, 1, 1, 1}, 1);
  material.doubleSided = true;
  material.extensions["KHR_materials_unlit"] = tinygltf::Value(tinygltf::Value::Object{});
  model.materials.push_back(material);
  model.extensionsUsed.emplace_back("KHR_materials_unlit");
  return cavity;
}

/// Poses of the skin that fill what the others leave of the file, and how they follow each other.
void add_performance(tinygltf::Model& model, GltfArrays& arrays, tinygltf::Mesh& mesh,
                     const simulate::Performance& performance, const SkinView& view,
                     const std::vector<Opening>& openings, const Points& cavity,
                     const GlbOptions& options, int lower_teeth, GlbReport& report) {
  const Points& rest = performance.skin_rest.points;
  const double copies =
      double(Index(view.skin_vertex.size()) + cavity.rows()) / double(rest.rows());
  const PoseTargets targets =
      pose_targets(performance.skin_rest, performance.skin_displacement_m, performance.frame_time_s,
                   options.tolerance_m, options.max_bytes - double(arrays.bytes()), copies);
  report.keys = targets.names.size();
  report.max_error_m = targets.keys.max_error_m;
  add_morph_targets(mesh, arrays, targets, view.skin_vertex);
  if (!openings.empty())
    for (const PointsF& pose : targets.positions) {
      const Points now = pockets(openings, rest + pose.cast<double>()).points;
      const PointsF change = (now - cavity).cast<float>();
      mesh.primitives[1].targets.push_back(
          {{"POSITION", arrays.few_vectors(change, targets.least_move_m, true)}});
    }
  tinygltf::Animation animation;
  animation.name = "performance";
  const double start_s = performance.frame_time_s.front();
  const int times = arrays.times(performance.frame_time_s, start_s);
  animate(animation, 0, "weights", times, arrays.rows_as_scalars(targets.keys.weights));
  if (lower_teeth >= 0) animate_jaw(model, arrays, lower_teeth, performance, animation);
  model.animations.push_back(animation);
}

tinygltf::Model model_of(const simulate::Performance& performance, const io::Scan& scan,
                         const GlbOptions& options, GlbReport& report) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.asset.generator = "hyperex";
  GltfArrays arrays(model);
  const SkinView view = skin_view(performance, scan);
  const tinygltf::Primitive skin = skin_primitive(model, arrays, view, performance, scan);
  model.nodes.emplace_back();
  model.nodes[0].name = "face";
  model.nodes[0].mesh = 0;
  model.meshes.emplace_back();
  // Before the poses, which fill what the others leave of the file.
  const FaceBacking backing = face_backing(performance);
  add_eyes(model, arrays, backing.eyeballs);
  int lower_teeth = -1;
  if (options.teeth) {
    const int first = static_cast<int>(model.materials.size());
    model.materials.push_back(plain_material("teeth", {0.82, 0.74, 0.58, 1}, 0.35));
    model.materials.push_back(plain_material("gum", {0.48, 0.11, 0.11, 1}, 0.45));
    add_teeth(model, arrays, options.teeth->upper, "upper_teeth", first);
    lower_teeth = add_teeth(model, arrays, options.teeth->lower, "lower_teeth", first);
  }

  tinygltf::Mesh mesh;
  mesh.name = "skin";
  mesh.primitives.push_back(skin);
  const TriMesh cavity = pockets(backing.openings, performance.skin_rest.points);
  if (!backing.openings.empty())
    mesh.primitives.push_back(cavity_primitive(model, arrays, backing.openings, cavity));
  const bool moves =
      std::any_of(performance.skin_displacement_m.begin(), performance.skin_displacement_m.end(),
                  [](const PointsF& frame) { return !frame.isZero(0); });
  if (moves)
    add_performance(model, arrays, mesh, performance, view, backing.openings, cavity.points,
                    options, lower_teeth, report);
  model.meshes[0] = std::move(mesh);
  tinygltf::Scene scene;
  for (std::size_t n = 0; n < model.nodes.size(); ++n) scene.nodes.push_back(int(n));
  model.scenes.push_back(scene);
  model.defaultScene = 0;
  return model;
}

}  // namespace

GlbReport write_glb(const std::filesystem::path& file, const simulate::Performance& performance,
                    const io::Scan& scan, const GlbOptions& options) {
  check_glb(performance, options);
  GlbReport report;
  const tinygltf::Model model = model_of(performance, scan, options, report);
  write_file_atomically(file, [&](std::ostream& stream) {
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, true);
    report.bytes = static_cast<double>(stream.tellp());
  });
  return report;
}

}  // namespace hyperex::report
