// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Internal to the room: parts common to all glTF files of moving faces.
#include <tiny_gltf.h>

#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/report/pose_keys.hpp"

namespace hyperex::report {

/// Appends arrays to the one buffer of a glTF model, each with its own view and accessor. Functions
/// return the number of the accessor; view() returns that of the view.
class GltfArrays {
 public:
  explicit GltfArrays(tinygltf::Model& model);

  int view(const void* data, std::size_t bytes, int target = 0);
  int accessor(int view, int component, int type, std::size_t count, bool normalised = false);
  /// Vertex attributes; `with_range`: with least and greatest values, as positions need.
  int vectors(const PointsF& rows, bool with_range);
  /// Vertex attributes, many of which are nearly 0. Those shorter than `least` are set to 0 and not
  /// stored (sparse accessor), if that takes less space.
  int few_vectors(const PointsF& rows, float least, bool with_range = false);
  std::size_t bytes() const { return model_.buffers[0].data.size(); }
  int triangles(const Triangles& rows);
  /// Key times of an animation, counted from `start_s`.
  int times(const std::vector<double>& time_s, double start_s);
  /// Values of an animation: one row after the other, as single numbers or as vectors of 3 or 4.
  int rows_as_scalars(const Eigen::MatrixXf& rows);
  int rows_as_vectors(const Eigen::MatrixXf& rows);

 private:
  int scalars(const std::vector<float>& values, bool with_range);
  tinygltf::Model& model_;
};

/// A moving surface as morph targets.
struct PoseTargets {
  PoseKeys keys;
  std::vector<PointsF> positions, normals;  ///< of each key, what is added to those at rest
  std::vector<std::string> names;
  float least_move_m = 0;  ///< smaller displacements are set to 0
};

/// Morph targets of the surface at rest from its displacements over time. If all keys would take
/// more than `max_bytes`, the last ones are left out, but never the first. `copies`: mean number of
/// times that a vertex is written (1.2: a fifth of them twice).
PoseTargets pose_targets(const TriMesh& rest, const std::vector<PointsF>& displacements,
                         const std::vector<double>& time_s, double tolerance_m, double max_bytes,
                         double copies = 1);

/// Morph targets of the mesh's first primitive, with one vertex for each of `vertices`, and the
/// weights that are used when no animation plays.
void add_morph_targets(tinygltf::Mesh& mesh, GltfArrays& arrays, const PoseTargets& targets,
                       const std::vector<int>& vertices);

/// Rows of a skin's vertices.
PointsF spread(const PointsF& skin, const std::vector<int>& vertices);

/// Adds a channel: `path` of `node` by the accessors of times and values.
void animate(tinygltf::Animation& animation, int node, const std::string& path, int times,
             int values, const std::string& interpolation = "LINEAR");

/// `coloured`: by vertex colours or a texture; else a light skin tone. `texture` -1: none.
tinygltf::Material skin_material(bool coloured, int texture);

}  // namespace hyperex::report
