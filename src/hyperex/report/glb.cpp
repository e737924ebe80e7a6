// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/glb.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/core/lower_case.hpp"
#include "hyperex/report/eye_model.hpp"
#include "hyperex/report/gltf_face.hpp"
#include "hyperex/report/gltf_pockets.hpp"
#include "hyperex/report/jaw_turns.hpp"
#include "hyperex/report/skin_view.hpp"

namespace hyperex::report {
namespace {

using Eigen::Index;

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

/// Rotation of the eyes' nodes as the gaze in each frame.
void animate_eyes(tinygltf::Model& model, GltfArrays& arrays, const FaceNodes& nodes,
                  const std::vector<Eyeball>& eyes, const simulate::Performance& performance,
                  tinygltf::Animation& animation) {
  const auto frames = static_cast<Index>(performance.gaze.size());
  std::array<Eigen::MatrixXf, 2> turns{Eigen::MatrixXf(frames, 4), Eigen::MatrixXf(frames, 4)};
  for (Index f = 0; f < frames; ++f) {
    const auto now = turns_of(performance.gaze[std::size_t(f)], eyes);
    for (std::size_t side = 0; side < 2; ++side)  // less than half a turn: w > 0 throughout
      turns[side].row(f) = now[side].coeffs().cast<float>().transpose();  // x y z w
  }
  const int times = arrays.times(performance.frame_time_s, performance.frame_time_s.front());
  for (const auto& [node, turn] : {std::pair{nodes.eye_R, &turns[0]}, {nodes.eye_L, &turns[1]}}) {
    animate(animation, node, "rotation", times, arrays.rows_as_vectors(*turn));
    for (int k = 0; k < 4; ++k) model.nodes[std::size_t(node)].rotation.push_back((*turn)(0, k));
  }
}

/// Puts the upper teeth where surgery put them.
void place_upper_teeth(tinygltf::Node& node, const Eigen::Isometry3d& now_from_rest) {
  if (now_from_rest.isApprox(Eigen::Isometry3d::Identity(), 1e-9)) return;
  const Eigen::Vector4d turn = Eigen::Quaterniond(now_from_rest.linear()).coeffs();
  const Vec3 shift = now_from_rest.translation();
  node.rotation.assign(turn.begin(), turn.end());  // x y z w
  node.translation.assign(shift.begin(), shift.end());
}

void check_glb(const simulate::Performance& performance, const GlbOptions& options) {
  bool whole = performance.skin_displacement_m.size() == performance.frame_time_s.size();
  for (const PointsF& frame : performance.skin_displacement_m)
    whole = whole && frame.rows() == performance.skin_rest.points.rows();
  if (options.teeth)
    whole = whole && performance.jaw_now_from_rest.size() == performance.frame_time_s.size();
  whole = whole &&
          (performance.gaze.empty() || performance.gaze.size() == performance.frame_time_s.size());
  if (!whole) throw std::invalid_argument("write_glb: frames that are not the performance's");
}

/// The jaw in some frames.
std::vector<Eigen::Affine3d> jaws_of(const simulate::Performance& performance,
                                     const std::vector<int>& frames) {
  std::vector<Eigen::Affine3d> jaws;
  for (const int f : frames) jaws.emplace_back(performance.jaw_now_from_rest[std::size_t(f)]);
  return jaws;
}

/// Adds the performance as morph targets of the skin and an animation of their weights. The targets
/// may take the bytes that the other parts leave of options.max_bytes.
void add_performance(tinygltf::Model& model, GltfArrays& arrays, tinygltf::Mesh& mesh,
                     const simulate::Performance& performance, const SkinView& view,
                     const FaceBacking& backing, const std::vector<PocketGroup>& pockets,
                     const GlbOptions& options, const FaceNodes& nodes, GlbReport& report) {
  const Points& rest = performance.skin_rest.points;
  Index written = Index(view.skin_vertex.size());
  for (const PocketGroup& group : pockets) written += group.at_rest.points.rows();
  const double copies = double(written) / double(rest.rows());
  const PoseTargets targets =
      pose_targets(performance.skin_rest, performance.skin_displacement_m, performance.frame_time_s,
                   options.tolerance_m, options.max_bytes - double(arrays.bytes()), copies);
  report.keys = targets.names.size();
  report.max_error_m = targets.keys.max_error_m;
  add_morph_targets(mesh, arrays, targets, view.skin_vertex);
  add_pocket_targets(
      mesh, arrays, pockets, rest, targets,
      options.teeth ? jaws_of(performance, targets.keys.frames) : std::vector<Eigen::Affine3d>{});
  tinygltf::Animation animation;
  animation.name = "performance";
  const double start_s = performance.frame_time_s.front();
  const int times = arrays.times(performance.frame_time_s, start_s);
  animate(animation, 0, "weights", times, arrays.rows_as_scalars(targets.keys.weights));
  if (nodes.lower_teeth >= 0) animate_jaw(model, arrays, nodes.lower_teeth, performance, animation);
  if (nodes.eye_R >= 0 && !performance.gaze.empty())
    animate_eyes(model, arrays, nodes, backing.eyeballs, performance, animation);
  model.animations.push_back(animation);
}

tinygltf::Model model_of(const simulate::Performance& performance, const io::Scan& scan,
                         const GlbOptions& options, GlbReport& report) {
  tinygltf::Model model;
  begin_face(model);
  GltfArrays arrays(model);
  const SkinView view = skin_view(performance, scan);
  const tinygltf::Primitive skin =
      skin_primitive(model, arrays, view, performance, scan, options.skin_tone);
  // Added before the morph targets, which may take the rest of options.max_bytes.
  std::optional<FaceBacking> made;
  if (!options.backing) made = face_backing(performance, options.teeth);
  const FaceBacking& backing = made ? *made : *options.backing;
  FaceNodes nodes;
  add_eyes(model, arrays, backing.eyeballs, performance.skin_rest, nodes);
  if (options.teeth) {
    add_teeth(model, arrays, *options.teeth, backing.forward, nodes);
    place_upper_teeth(model.nodes[std::size_t(nodes.upper_teeth)],
                      performance.upper_teeth_now_from_rest);
  }

  tinygltf::Mesh mesh;
  mesh.name = "skin";
  mesh.primitives.push_back(skin);
  const auto pockets = pocket_groups(backing.openings, performance.skin_rest.points);
  add_pockets(model, arrays, mesh, pockets);
  const bool moves =
      std::any_of(performance.skin_displacement_m.begin(), performance.skin_displacement_m.end(),
                  [](const PointsF& frame) { return !frame.isZero(0); });
  if (moves)
    add_performance(model, arrays, mesh, performance, view, backing, pockets, options, nodes,
                    report);
  model.meshes[0] = std::move(mesh);
  end_face(model);
  return model;
}

}  // namespace

GlbReport write_glb(const std::filesystem::path& file, const simulate::Performance& performance,
                    const io::Scan& scan, const GlbOptions& options) {
  if (ending_of(file) != ".glb")
    throw InputError(file, "is no name for a binary glTF; expected one that ends in .glb");
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
