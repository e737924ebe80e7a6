// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/gltf_face.hpp"

#include <cmath>

#include "hyperex/report/complexion.hpp"
#include "hyperex/report/eye_model.hpp"
#include "hyperex/report/mouth_colours.hpp"

namespace hyperex::report {

using Eigen::Index;

namespace {

double linear(std::uint8_t byte) {
  const double s = byte / 255.0;
  return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
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

/// How much light falls on each vertex, as COLOR_0 in all three channels.
int add_light(GltfArrays& arrays, const Eigen::VectorXd& light) {
  std::vector<std::uint16_t> values;
  for (const double share : light) {
    values.insert(values.end(), 3, static_cast<std::uint16_t>(std::lround(65535 * share)));
    values.push_back(65535);
  }
  const int view = arrays.view(values.data(), values.size() * 2, TINYGLTF_TARGET_ARRAY_BUFFER);
  return arrays.accessor(view, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4,
                         std::size_t(light.size()), true);
}

/// Adds a node with the parts of one jaw, in the order of their materials; its number, -1 where
/// there are none.
int add_jaw(tinygltf::Model& model, GltfArrays& arrays, const std::vector<const TriMesh*>& parts,
            const Vec3& forward, const std::string& name, int first_material) {
  tinygltf::Mesh mesh;
  mesh.name = name;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const TriMesh& part = *parts[i];
    if (part.triangles.rows() == 0) continue;
    const PointsF points = part.points.cast<float>();
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = arrays.vectors(points, true);
    primitive.attributes["NORMAL"] = arrays.vectors(vertex_normals(points, part.triangles), false);
    primitive.attributes["COLOR_0"] = add_light(arrays, light_in_mouth(part, *parts[0], forward));
    primitive.indices = arrays.triangles(part.triangles);
    primitive.material = first_material + int(i);
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

std::vector<double> base_colour(const Srgb& colour) {
  return {linear(colour[0]), linear(colour[1]), linear(colour[2]), 1};
}

}  // namespace

// glTF's COLOR_0 is linear; 16 bits keep the dark tones apart.
int add_colours(
    GltfArrays& arrays,
    const Eigen::Matrix<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& srgb) {
  if (srgb.rows() == 0) return -1;
  const auto sixteen = [](std::uint8_t byte) {
    return static_cast<std::uint16_t>(std::lround(65535 * linear(byte)));
  };
  std::vector<std::uint16_t> values;
  values.reserve(srgb.size());
  for (Index v = 0; v < srgb.rows(); ++v) {
    for (int k = 0; k < 3; ++k) values.push_back(sixteen(srgb(v, k)));
    values.push_back(65535);  // a face is opaque, whatever a scanner left in alpha
  }
  const int view = arrays.view(values.data(), values.size() * 2, TINYGLTF_TARGET_ARRAY_BUFFER);
  return arrays.accessor(view, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4,
                         srgb.rows(), true);
}

tinygltf::Material plain_material(const char* name, std::vector<double> colour, double roughness) {
  tinygltf::Material material;
  material.name = name;
  material.pbrMetallicRoughness.metallicFactor = 0;
  material.pbrMetallicRoughness.roughnessFactor = roughness;
  material.pbrMetallicRoughness.baseColorFactor = std::move(colour);
  return material;
}

void begin_face(tinygltf::Model& model) {
  model.asset.version = "2.0";
  model.asset.generator = "hyperex";
  model.nodes.emplace_back();
  model.nodes[0].name = "face";
  model.nodes[0].mesh = 0;
  model.meshes.emplace_back();
}

void add_eyes(tinygltf::Model& model, GltfArrays& arrays, const std::vector<Eyeball>& eyeballs,
              const TriMesh& skin, FaceNodes& nodes) {
  if (eyeballs.empty()) return;
  const EyeModel& eye = eye_model();
  const int material = static_cast<int>(model.materials.size());
  model.materials.push_back(plain_material("eye", {1, 1, 1, 1}, 0.12));
  const std::vector<Eigen::VectorXf> lights = light_on_eyes(eyeballs, skin);
  for (std::size_t side = 0; side < eyeballs.size(); ++side) {
    const Eyeball& ball = eyeballs[side];
    const Eigen::VectorXf& light = lights[side];
    render::VertexColours colours = eye.colours;
    for (Index v = 0; v < colours.rows(); ++v)
      for (int k = 0; k < 3; ++k)
        colours(v, k) = static_cast<std::uint8_t>(std::lround(float(colours(v, k)) * light[v]));
    const Points out = eye.mesh.points * looking_along(ball.gaze).toRotationMatrix().transpose();
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = arrays.vectors((ball.radius_m * out).cast<float>(), true);
    primitive.attributes["NORMAL"] = arrays.vectors(out.cast<float>(), false);
    primitive.attributes["COLOR_0"] = add_colours(arrays, colours);
    primitive.indices = arrays.triangles(eye.mesh.triangles);
    primitive.material = material;
    tinygltf::Mesh mesh;
    mesh.name = side == 0 ? "eye_R" : "eye_L";
    mesh.primitives.push_back(std::move(primitive));
    tinygltf::Node node;
    node.name = mesh.name;
    node.mesh = static_cast<int>(model.meshes.size());
    node.translation = {ball.centre.x(), ball.centre.y(), ball.centre.z()};
    model.meshes.push_back(std::move(mesh));
    (side == 0 ? nodes.eye_R : nodes.eye_L) = static_cast<int>(model.nodes.size());
    model.nodes.push_back(node);
  }
}

void add_teeth(tinygltf::Model& model, GltfArrays& arrays, const anatomy::Teeth& teeth,
               const Vec3& forward, FaceNodes& nodes) {
  const int first = static_cast<int>(model.materials.size());
  model.materials.push_back(plain_material("teeth", base_colour(kCrownColour), 0.35));
  model.materials.push_back(plain_material("gum", base_colour(kGumColour), 0.45));
  if (teeth.tongue.triangles.rows() > 0)
    model.materials.push_back(plain_material("tongue", base_colour(kTongueColour), 0.5));
  nodes.upper_teeth = add_jaw(model, arrays, {&teeth.upper.crowns, &teeth.upper.gum}, forward,
                              "upper_teeth", first);
  nodes.lower_teeth = add_jaw(model, arrays, {&teeth.lower.crowns, &teeth.lower.gum, &teeth.tongue},
                              forward, "lower_teeth", first);
}

tinygltf::Primitive skin_primitive(tinygltf::Model& model, GltfArrays& arrays, const SkinView& view,
                                   const simulate::Performance& performance, const io::Scan& scan,
                                   face::SkinTone tone) {
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
  } else {
    io::VertexColours colour = skin_colour(performance, scan);
    if (colour.rows() == 0) colour = complexion(performance, tone);
    colours = add_colours(arrays, colour);
    if (colours >= 0) skin.attributes["COLOR_0"] = colours;
  }
  skin.material = 0;
  model.materials.push_back(skin_material(texture >= 0 || colours >= 0, texture));
  return skin;
}

void end_face(tinygltf::Model& model) {
  tinygltf::Scene scene;
  for (std::size_t n = 0; n < model.nodes.size(); ++n) scene.nodes.push_back(int(n));
  model.scenes.push_back(scene);
  model.defaultScene = 0;
}

}  // namespace hyperex::report
