// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/gltf_parts.hpp"

#include <algorithm>

#include "hyperex/report/skin_view.hpp"

namespace hyperex::report {

using Eigen::Index;

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

void add_morph_targets(tinygltf::Mesh& mesh, GltfArrays& arrays,
                       const std::vector<PointsF>& positions, const std::vector<PointsF>& normals,
                       const Eigen::VectorXf& first_weights) {
  tinygltf::Value::Array names;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    mesh.primitives[0].targets.push_back({{"POSITION", arrays.vectors(positions[k], true)},
                                          {"NORMAL", arrays.vectors(normals[k], false)}});
    mesh.weights.push_back(first_weights[Index(k)]);
    names.emplace_back("mode_" + std::to_string(k));
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
