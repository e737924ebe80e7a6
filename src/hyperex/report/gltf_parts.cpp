// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/gltf_parts.hpp"

#include <algorithm>
#include <cstdint>
#include <map>

#include "hyperex/report/skin_view.hpp"

namespace hyperex::report {

using Eigen::Index;

namespace {
constexpr std::size_t kVector = 12;  // bytes
/// The size of an index in a sparse accessor, bytes.
std::size_t index_bytes(std::size_t vertices) {
  return vertices <= 65536 ? 2 : 4;
}

std::size_t longer_than(const PointsF& rows, float least) {
  return static_cast<std::size_t>((rows.rowwise().norm().array() >= least).count());
}

/// The bytes that few_vectors() writes.
std::size_t few_bytes(const PointsF& rows, float least) {
  const auto vertices = static_cast<std::size_t>(rows.rows());
  return std::min(kVector * vertices, (kVector + index_bytes(vertices)) * longer_than(rows, least));
}
}  // namespace

GltfArrays::GltfArrays(tinygltf::Model& model) : model_(model) {
  model_.buffers.emplace_back();
}

int GltfArrays::view(const void* data, std::size_t bytes, int target) {
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

int GltfArrays::accessor(int view, int component, int type, std::size_t count, bool normalised) {
  tinygltf::Accessor out;
  out.bufferView = view;
  out.componentType = component;
  out.type = type;
  out.count = count;
  out.normalized = normalised;
  model_.accessors.push_back(out);
  return static_cast<int>(model_.accessors.size()) - 1;
}

int GltfArrays::vectors(const PointsF& rows, bool with_range) {
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

int GltfArrays::few_vectors(const PointsF& rows, float least, bool with_range) {
  std::vector<std::uint32_t> indices;
  for (Index v = 0; v < rows.rows(); ++v)
    if (rows.row(v).norm() >= least) indices.push_back(static_cast<std::uint32_t>(v));
  const auto vertices = static_cast<std::size_t>(rows.rows());
  if (indices.empty() || few_bytes(rows, least) >= kVector * vertices)
    return vectors(rows, with_range);
  PointsF values(static_cast<Index>(indices.size()), 3);
  for (std::size_t i = 0; i < indices.size(); ++i) values.row(Index(i)) = rows.row(indices[i]);
  const int at = accessor(-1, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, vertices);
  if (with_range) {  // of all: those that are not stored are 0
    for (int k = 0; k < 3; ++k) {
      auto& out = model_.accessors[static_cast<std::size_t>(at)];
      out.minValues.push_back(std::min(0.F, values.col(k).minCoeff()));
      out.maxValues.push_back(std::max(0.F, values.col(k).maxCoeff()));
    }
  }
  auto& sparse = model_.accessors[static_cast<std::size_t>(at)].sparse;
  sparse.isSparse = true;
  sparse.indices.byteOffset = sparse.values.byteOffset = 0;
  sparse.count = static_cast<int>(indices.size());
  if (index_bytes(vertices) == 2) {
    const std::vector<std::uint16_t> narrow(indices.begin(), indices.end());
    sparse.indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    sparse.indices.bufferView = view(narrow.data(), 2 * narrow.size());
  } else {
    sparse.indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    sparse.indices.bufferView = view(indices.data(), 4 * indices.size());
  }
  sparse.values.bufferView = view(values.data(), kVector * indices.size());
  return at;
}

int GltfArrays::triangles(const Triangles& rows) {
  const int at = view(rows.data(), rows.size() * sizeof(int), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  return accessor(at, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, rows.size());
}

int GltfArrays::scalars(const std::vector<float>& values, bool with_range) {
  const int at = accessor(view(values.data(), values.size() * sizeof(float)),
                          TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, values.size());
  if (with_range) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    model_.accessors[at].minValues = {*least};
    model_.accessors[at].maxValues = {*most};
  }
  return at;
}

int GltfArrays::times(const std::vector<double>& time_s, double start_s) {
  std::vector<float> times;
  for (const double t : time_s) times.push_back(static_cast<float>(t - start_s));
  return scalars(times, true);
}

int GltfArrays::rows_as_scalars(const Eigen::MatrixXf& rows) {
  std::vector<float> values;
  for (Index f = 0; f < rows.rows(); ++f)
    for (Index k = 0; k < rows.cols(); ++k) values.push_back(rows(f, k));
  return scalars(values, false);
}

int GltfArrays::rows_as_vectors(const Eigen::MatrixXf& rows) {
  const int at = rows_as_scalars(rows);
  model_.accessors[at].type = rows.cols() == 4 ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3;
  model_.accessors[at].count = rows.rows();
  return at;
}

namespace {
/// Smaller changes of a normal are not stored: about one degree.
constexpr float kLeastNormal = 0.02F;
}  // namespace

PointsF spread(const PointsF& skin, const std::vector<int>& vertices) {
  PointsF out(static_cast<Index>(vertices.size()), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i) out.row(Index(i)) = skin.row(vertices[i]);
  return out;
}

PoseTargets pose_targets(const TriMesh& rest, const std::vector<PointsF>& displacements,
                         const std::vector<double>& time_s, double tolerance_m, double max_bytes,
                         double copies) {
  constexpr double kJson = 700;  // accessors, views and name of a key
  const PointsF at_rest = rest.points.cast<float>();
  const PointsF rest_normals = vertex_normals(at_rest, rest.triangles);
  std::map<int, PointsF> normals;
  double spent = 0;
  PoseTargets targets;
  targets.least_move_m = least_move_m(tolerance_m);
  const auto take = [&](int frame) {
    PointsF change =
        vertex_normals(at_rest + displacements[std::size_t(frame)], rest.triangles) - rest_normals;
    const double bytes =
        copies * double(few_bytes(displacements[std::size_t(frame)], targets.least_move_m) +
                        few_bytes(change, kLeastNormal)) +
        double(sizeof(float) * time_s.size()) + kJson;
    if (spent + bytes > max_bytes && !normals.empty()) return false;
    spent += bytes;
    normals[frame] = std::move(change);
    return true;
  };
  targets.keys = pose_keys(displacements, tolerance_m, take);
  for (const int frame : targets.keys.frames) {
    targets.positions.push_back(pose_of(displacements[std::size_t(frame)], targets.least_move_m));
    targets.normals.push_back(std::move(normals.at(frame)));
  }
  targets.names = pose_names(targets.keys, time_s);
  return targets;
}

void add_morph_targets(tinygltf::Mesh& mesh, GltfArrays& arrays, const PoseTargets& targets,
                       const std::vector<int>& vertices) {
  tinygltf::Value::Array names;
  for (std::size_t k = 0; k < targets.positions.size(); ++k) {
    mesh.primitives[0].targets.push_back(
        {{"POSITION",
          arrays.few_vectors(spread(targets.positions[k], vertices), targets.least_move_m, true)},
         {"NORMAL", arrays.few_vectors(spread(targets.normals[k], vertices), kLeastNormal)}});
    mesh.weights.push_back(targets.keys.weights(0, Index(k)));
    names.emplace_back(targets.names[k]);
  }
  mesh.extras = tinygltf::Value(tinygltf::Value::Object{{"targetNames", tinygltf::Value(names)}});
}

void animate(tinygltf::Animation& animation, int node, const std::string& path, int times,
             int values, const std::string& interpolation) {
  tinygltf::AnimationSampler sampler;
  sampler.input = times;
  sampler.output = values;
  sampler.interpolation = interpolation;
  tinygltf::AnimationChannel channel;
  channel.sampler = static_cast<int>(animation.samplers.size());
  channel.target_node = node;
  channel.target_path = path;
  animation.samplers.push_back(sampler);
  animation.channels.push_back(channel);
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

}  // namespace hyperex::report
