// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/tracked_glb.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "hyperex/core/files.hpp"
#include "hyperex/report/gltf_parts.hpp"
#include "hyperex/report/skin_view.hpp"

namespace hyperex::report {
namespace {

using Eigen::Index;
using tracking::TrackedFrame;
using tracking::Tracking;

constexpr double kMaxBytes = 20e6;

enum Nodes : int { camera_node, camera_frame_node, head_node };

/// Valid frames, their times rising.
std::vector<const TrackedFrame*> frames_shown(const Tracking& tracking) {
  std::vector<const TrackedFrame*> shown;
  for (const TrackedFrame& frame : tracking.frames)
    if (frame.valid && (shown.empty() || frame.time_s > shown.back()->time_s))
      shown.push_back(&frame);
  return shown;
}

std::vector<PointsF> displacements(const std::vector<const TrackedFrame*>& shown,
                                   const Points& rest) {
  std::vector<PointsF> out;
  for (const TrackedFrame* frame : shown) {
    if (frame->vertices_m.rows() != rest.rows())
      throw std::invalid_argument("write_tracked_glb: a frame of another model");
    out.push_back((frame->vertices_m - rest).cast<float>());
  }
  return out;
}

/// A key where the head appears or disappears: 1 or 0, as steps.
void animate_validity(tinygltf::Animation& animation, GltfArrays& arrays,
                      const Tracking& tracking) {
  std::vector<double> times;
  std::vector<float> scale;
  for (const TrackedFrame& frame : tracking.frames) {
    if (!times.empty() && (frame.time_s <= times.back() || (scale.back() != 0) == frame.valid))
      continue;
    times.push_back(frame.time_s);
    scale.push_back(frame.valid ? 1 : 0);
  }
  if (times.size() == 1 && scale.front() != 0) return;  // always there
  Eigen::MatrixXf values(Index(scale.size()), 3);
  for (Index k = 0; k < values.rows(); ++k) values.row(k).setConstant(scale[std::size_t(k)]);
  const int keys = arrays.times(times, tracking.frames.front().time_s);
  animate(animation, head_node, "scale", keys, arrays.rows_as_vectors(values), "STEP");
}

/// Unit quaternions (x, y, z, w) on one half of their sphere, so that players take the short way.
Eigen::MatrixXf rotations(const std::vector<const TrackedFrame*>& shown) {
  Eigen::MatrixXf rows(Index(shown.size()), 4);
  for (Index k = 0; k < rows.rows(); ++k) {
    const Eigen::Quaterniond turn(shown[std::size_t(k)]->camera_from_head.rotation());
    rows.row(k) = turn.normalized().coeffs().transpose().cast<float>();
    if (k > 0 && rows.row(k).dot(rows.row(k - 1)) < 0) rows.row(k) *= -1;
  }
  return rows;
}

void animate_head(tinygltf::Model& model, GltfArrays& arrays, const Tracking& tracking,
                  const std::vector<const TrackedFrame*>& shown, const PoseTargets& targets) {
  std::vector<double> times;
  Eigen::MatrixXf places(Index(shown.size()), 3);
  for (const TrackedFrame* frame : shown) {
    places.row(Index(times.size())) =
        frame->camera_from_head.translation().transpose().cast<float>();
    times.push_back(frame->time_s);
  }
  const int keys = arrays.times(times, tracking.frames.front().time_s);
  tinygltf::Animation animation;
  animation.name = "tracked";
  animate(animation, head_node, "translation", keys, arrays.rows_as_vectors(places));
  animate(animation, head_node, "rotation", keys, arrays.rows_as_vectors(rotations(shown)));
  if (!targets.names.empty())
    animate(animation, head_node, "weights", keys, arrays.rows_as_scalars(targets.keys.weights));
  animate_validity(animation, arrays, tracking);
  model.animations.push_back(animation);
}

void add_face(tinygltf::Model& model, GltfArrays& arrays, const TriMesh& face,
              const PoseTargets& targets) {
  const PointsF rest = face.points.cast<float>();
  const PointsF normals = vertex_normals(rest, face.triangles);
  tinygltf::Primitive skin;
  skin.mode = TINYGLTF_MODE_TRIANGLES;
  skin.attributes["POSITION"] = arrays.vectors(rest, true);
  skin.attributes["NORMAL"] = arrays.vectors(normals, false);
  skin.indices = arrays.triangles(face.triangles);
  skin.material = 0;
  model.materials.push_back(skin_material(false, -1));
  tinygltf::Mesh mesh;
  mesh.name = "face";
  mesh.primitives.push_back(skin);
  if (!targets.names.empty()) {
    std::vector<int> all(std::size_t(rest.rows()));
    std::iota(all.begin(), all.end(), 0);
    add_morph_targets(mesh, arrays, targets, all);
  }
  model.meshes.push_back(mesh);
}

void add_nodes(tinygltf::Model& model, const capture::Intrinsics& camera,
               const Eigen::Isometry3d& camera_from_head) {
  tinygltf::Camera seen;
  seen.name = "recording_camera";
  seen.type = "perspective";
  seen.perspective.aspectRatio = double(camera.width_px) / camera.height_px;
  seen.perspective.yfov = 2 * std::atan(0.5 * camera.height_px / camera.fy_px);
  seen.perspective.znear = 0.01;  // m
  seen.perspective.zfar = 100;
  model.cameras.push_back(seen);
  model.nodes.resize(3);
  model.nodes[camera_node].name = "recording_camera";
  model.nodes[camera_node].camera = 0;
  model.nodes[camera_frame_node].name = "camera_frame";
  model.nodes[camera_frame_node].rotation = {1, 0, 0, 0};  // half a turn about x: y up, z backward
  model.nodes[camera_frame_node].children = {head_node};
  tinygltf::Node& head = model.nodes[head_node];
  head.name = "head";
  head.mesh = 0;
  const Vec3 place = camera_from_head.translation();
  const Eigen::Quaterniond turn(camera_from_head.rotation());
  head.translation = {place.x(), place.y(), place.z()};
  head.rotation = {turn.x(), turn.y(), turn.z(), turn.w()};
  tinygltf::Scene scene;
  scene.nodes = {camera_node, camera_frame_node};
  model.scenes.push_back(scene);
  model.defaultScene = 0;
}

}  // namespace

void write_tracked_glb(const std::filesystem::path& file, const expression::FaceModel& model,
                       const Tracking& tracking, const capture::Intrinsics& camera,
                       double tolerance_m) {
  if (!tracking.neutral || tracking.neutral->points_m.rows() != model.vertex_count())
    throw std::invalid_argument("write_tracked_glb: no neutral face of this model");
  const Points& rest = tracking.neutral->points_m;
  const auto shown = frames_shown(tracking);
  const std::vector<PointsF> motion = displacements(shown, rest);
  std::vector<double> time_s;
  for (const TrackedFrame* frame : shown) time_s.push_back(frame->time_s);
  const PoseTargets targets =
      pose_targets({rest, model.mesh.triangles}, motion, time_s, tolerance_m, kMaxBytes);
  tinygltf::Model gltf;
  gltf.asset.version = "2.0";
  gltf.asset.generator = "hyperex";
  GltfArrays arrays(gltf);
  add_face(gltf, arrays, {rest, model.mesh.triangles}, targets);
  add_nodes(gltf, camera,
            shown.empty() ? Eigen::Isometry3d::Identity() : shown.front()->camera_from_head);
  if (!shown.empty()) animate_head(gltf, arrays, tracking, shown, targets);
  write_file_atomically(file, [&](std::ostream& stream) {
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&gltf, stream, false, true);
  });
}

}  // namespace hyperex::report
