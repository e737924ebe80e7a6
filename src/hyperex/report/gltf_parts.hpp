// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Inside the room: what the glTF files of moving faces have in common.
#include <tiny_gltf.h>

#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/report/displacement_modes.hpp"

namespace hyperex::report {

/// Appends arrays to the one buffer of a glTF model, each with its own view and accessor. Gives the
/// accessor's number, but view() that of the view.
class GltfArrays {
 public:
  explicit GltfArrays(tinygltf::Model& model);

  int view(const void* data, std::size_t bytes, int target = 0);
  int accessor(int view, int component, int type, std::size_t count, bool normalised = false);
  /// Vertex attributes; `with_range`: with least and greatest values, as positions need.
  int vectors(const PointsF& rows, bool with_range);
  int triangles(const Triangles& rows);
  /// Key times of an animation, counted from `start_s`.
  int times(const std::vector<double>& time_s, double start_s);
  /// Values of an animation: row after row as numbers, or a vector of 3 or 4 each.
  int rows_as_scalars(const Eigen::MatrixXf& rows);
  int rows_as_vectors(const Eigen::MatrixXf& rows);

 private:
  int scalars(const std::vector<float>& values, bool with_range);
  tinygltf::Model& model_;
};

/// D_k, |V| x 3 each, that minimise over all frames f the sum of squares of
/// sum_k w_fk D_k - (normals(f) - normals at rest): D = W^+ dN.
std::vector<PointsF> normal_modes(const PointsF& rest, const PointsF& rest_normals,
                                  const Triangles& triangles, const DisplacementModes& modes);

/// Morph targets mode_0, mode_1 ... of the mesh's first primitive, and the weights of a player that
/// plays nothing.
void add_morph_targets(tinygltf::Mesh& mesh, GltfArrays& arrays,
                       const std::vector<PointsF>& positions, const std::vector<PointsF>& normals,
                       const Eigen::VectorXf& first_weights);

/// Adds a channel: `path` of `node` by the accessors of times and values.
void animate(tinygltf::Animation& animation, int node, const std::string& path, int times,
             int values, const std::string& interpolation = "LINEAR");

/// `coloured`: by vertex colours or a texture; else a light skin tone. `texture` -1: none.
tinygltf::Material skin_material(bool coloured, int texture);

}  // namespace hyperex::report
