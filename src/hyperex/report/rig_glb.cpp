// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/rig_glb.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <utility>

#include "hyperex/core/files.hpp"
#include "hyperex/report/gltf_face.hpp"
#include "hyperex/report/gltf_pockets.hpp"

namespace hyperex::report {
namespace {

using Eigen::Index;

constexpr float kLeastMove_m = 5e-5F;

/// A motion of a rigid part, in place of its own vertices' rest.
using Move = std::function<Points(const Points&)>;

/// Morph targets of all primitives of a mesh that moves as a whole: `moves[k]` for `names[k]`.
void add_rigid_targets(tinygltf::Model& model, GltfArrays& arrays, int node,
                       const std::vector<std::string>& names, const std::vector<Move>& moves) {
  if (node < 0 || names.empty()) return;
  tinygltf::Mesh& mesh = model.meshes[std::size_t(model.nodes[std::size_t(node)].mesh)];
  for (tinygltf::Primitive& primitive : mesh.primitives) {
    const tinygltf::Accessor at = model.accessors[std::size_t(primitive.attributes["POSITION"])];
    const std::size_t from = model.bufferViews[std::size_t(at.bufferView)].byteOffset;
    const PointsF rest = Eigen::Map<const PointsF>(
        reinterpret_cast<const float*>(model.buffers[0].data.data() + from), Index(at.count), 3);
    for (const Move& move : moves)
      primitive.targets.push_back(
          {{"POSITION",
            arrays.vectors((move(rest.cast<double>()) - rest.cast<double>()).cast<float>(),
                           true)}});
  }
  tinygltf::Value::Array values;
  for (const std::string& name : names) values.emplace_back(name);
  mesh.extras = tinygltf::Value(tinygltf::Value::Object{{"targetNames", tinygltf::Value(values)}});
  mesh.weights.assign(names.size(), 0);
}

void add_eye_targets(tinygltf::Model& model, GltfArrays& arrays, int node, const Vec3& ahead,
                     const Vec3& across, const std::vector<RigShape>& shapes,
                     const std::optional<expression::Gaze> RigShape::*eye) {
  std::vector<std::string> names;
  std::vector<Move> moves;
  for (const RigShape& shape : shapes) {
    if (!(shape.*eye)) continue;
    const Eigen::Matrix3d turn =
        expression::turn_of(*(shape.*eye), ahead, across).toRotationMatrix();
    names.push_back(shape.name);
    moves.emplace_back([turn](const Points& rest) { return Points(rest * turn.transpose()); });
  }
  add_rigid_targets(model, arrays, node, names, moves);
}

/// The lower teeth turn about the jaw's axis, so their node is at its middle.
void add_jaw_targets(tinygltf::Model& model, GltfArrays& arrays, int node, const Vec3& axis_m,
                     const std::vector<RigShape>& shapes) {
  std::vector<std::string> names;
  std::vector<Move> moves;
  for (const RigShape& shape : shapes) {
    if (shape.jaw_now_from_rest.isApprox(Eigen::Affine3d::Identity(), 1e-9)) continue;
    names.push_back(shape.name);
    moves.emplace_back([axis_m, jaw = shape.jaw_now_from_rest](const Points& rest) {
      Points out(rest.rows(), 3);
      for (Index v = 0; v < rest.rows(); ++v)
        out.row(v) = (jaw * (rest.row(v).transpose() + axis_m) - axis_m).transpose();
      return out;
    });
  }
  add_rigid_targets(model, arrays, node, names, moves);
}

/// So that a program which plays the rig knows its points (io/gltf_shapes.hpp).
void list_landmarks(tinygltf::Mesh& skin, const io::Landmarks& landmarks) {
  tinygltf::Value::Object places;
  for (const auto& [name, at] : landmarks)
    places[name] = tinygltf::Value(tinygltf::Value::Array{
        tinygltf::Value(at.x()), tinygltf::Value(at.y()), tinygltf::Value(at.z())});
  tinygltf::Value::Object extras = skin.extras.Get<tinygltf::Value::Object>();
  extras["landmarks_m"] = tinygltf::Value(places);
  skin.extras = tinygltf::Value(extras);
}

void check_shapes(const std::vector<RigShape>& shapes, Index vertices) {
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    if (shapes[k].displacement_m.rows() != vertices)
      throw std::invalid_argument("write_rig_glb: a shape of another skin");
    if (const auto& pair = shapes[k].corrects; pair && std::max((*pair)[0], (*pair)[1]) >= k)
      throw std::invalid_argument("write_rig_glb: a corrective before its shapes");
  }
}

/// The displacement where a shape is shown: a corrective together with those that it corrects.
PointsF skin_shown(const RigShape& shape, const std::vector<RigShape>& shapes) {
  PointsF moved = shape.displacement_m;
  if (shape.corrects)
    for (const std::size_t one : *shape.corrects) moved += shapes[one].displacement_m;
  return moved;
}

PoseTargets targets_of(const TriMesh& rest, const std::vector<RigShape>& shapes) {
  const PointsF at_rest = rest.points.cast<float>();
  const PointsF rest_normals = vertex_normals(at_rest, rest.triangles);
  PoseTargets targets;
  targets.least_move_m = kLeastMove_m;
  targets.keys.weights = Eigen::MatrixXf::Zero(1, Index(shapes.size()));
  for (const RigShape& shape : shapes) {
    targets.names.push_back(shape.name);
    targets.positions.push_back(pose_of(shape.displacement_m, kLeastMove_m));
    PointsF normals =
        vertex_normals(at_rest + skin_shown(shape, shapes), rest.triangles) - rest_normals;
    if (shape.corrects)
      for (const std::size_t one : *shape.corrects) normals -= targets.normals[one];
    targets.normals.push_back(std::move(normals));
  }
  return targets;
}

}  // namespace

double write_rig_glb(const std::filesystem::path& file, const simulate::Performance& performance,
                     const io::Scan& scan, const anatomy::Teeth* teeth, const Vec3& jaw_axis_m,
                     const std::vector<RigShape>& shapes, face::SkinTone tone) {
  const TriMesh& rest = performance.skin_rest;
  check_shapes(shapes, rest.points.rows());
  tinygltf::Model model;
  begin_face(model);
  GltfArrays arrays(model);
  const SkinView view = skin_view(performance, scan);
  tinygltf::Mesh skin;
  skin.name = "skin";
  skin.primitives.push_back(skin_primitive(model, arrays, view, performance, scan, tone));
  const FaceBacking backing = face_backing(performance, teeth);
  const auto pockets = pocket_groups(backing.openings, rest.points);
  add_pockets(model, arrays, skin, pockets);
  const PoseTargets targets = targets_of(rest, shapes);
  add_morph_targets(skin, arrays, targets, view.skin_vertex);
  list_landmarks(skin, landmarks_at_rest(performance));
  std::vector<Eigen::Affine3d> jaws;
  if (teeth)
    for (const RigShape& shape : shapes) jaws.push_back(shape.jaw_now_from_rest);
  add_pocket_targets(skin, arrays, pockets, rest.points, targets, jaws);
  FaceNodes nodes;
  add_eyes(model, arrays, backing.eyeballs, performance.skin_rest, nodes);
  if (teeth) {
    anatomy::Teeth about = *teeth;
    for (TriMesh* part : {&about.lower.crowns, &about.lower.gum, &about.tongue})
      part->points.rowwise() -= jaw_axis_m.transpose();
    add_teeth(model, arrays, about, backing.forward, nodes);
    if (nodes.lower_teeth >= 0)
      model.nodes[std::size_t(nodes.lower_teeth)].translation = {jaw_axis_m.x(), jaw_axis_m.y(),
                                                                 jaw_axis_m.z()};
    add_jaw_targets(model, arrays, nodes.lower_teeth, jaw_axis_m, shapes);
  }
  if (backing.eyeballs.size() == 2) {
    const Vec3 across = backing.eyeballs[1].centre - backing.eyeballs[0].centre;
    for (const auto& [node, eye] :
         {std::pair{nodes.eye_R, &RigShape::right_eye}, {nodes.eye_L, &RigShape::left_eye}})
      add_eye_targets(model, arrays, node, backing.forward, across, shapes, eye);
  }
  model.meshes[0] = std::move(skin);
  end_face(model);
  double bytes = 0;
  write_file_atomically(file, [&](std::ostream& stream) {
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, true);
    bytes = static_cast<double>(stream.tellp());
  });
  return bytes;
}

}  // namespace hyperex::report
