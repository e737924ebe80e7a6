// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/support.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/simulate/drive/nose_cartilage.hpp"

namespace hyperex::simulate {
namespace {
using face::ibug;

constexpr double skull_off_lips_m = 0.008, jaw_off_lips_m = 0.006;
constexpr double jaw_reach_m = 0.015, jaw_below_edge_m = 0.010, jaw_below_lip_m = 0.016;
constexpr double border_free_m = 0.035;
constexpr double frontalis_reach_m = 0.035;
constexpr int brow_first = 17, brow_last = 26;  // iBUG points
constexpr double attached_m = 0.0015, backed_m = 0.005;
/// The front edge of the ramus lies this far in front of the condyles; the estimated ones lie in
/// front of the true ones.
constexpr double ramus_m = 0.035, ramus_estimated_m = 0.015;
constexpr int chin_first = 5, chin_last = 11;  // iBUG points of the jaw's line

class BoneMap {
 public:
  explicit BoneMap(const io::Landmarks& landmarks, const anatomy::Bones* bones)
      : frame_(face::face_frame(landmarks)), nose_(landmarks, frame_) {
    for (int k = 0; k < 17; ++k) jaw_line_.push_back(frame_.local(landmarks.at(face::ibug(k))));
    for (int k = 48; k < 68; ++k) lips_.push_back(frame_.local(landmarks.at(face::ibug(k))));
    nose_base_ = frame_.local(landmarks.at(face::ibug(33)));
    ear_base_ = 0.5 * (jaw_line_[2] + jaw_line_[14]);
    lower_lip_ = frame_.local(landmarks.at(face::ibug(57))).y();
    const auto* own = bones && bones->condyles() ? &*bones->condyles() : nullptr;
    ramus_z_ = own ? frame_.local(0.5 * ((*own)[0] + (*own)[1])).z() + ramus_m
                   : 0.5 * (jaw_line_[1] + jaw_line_[15]).z() + ramus_estimated_m;
  }

  /// Whether the tissue of a node is attached to the bone at its inner end.
  bool attached(Bone bone, const Vec3& inner, const Vec3& outer) const {
    const Vec3 q = frame_.local(inner), p = frame_.local(outer);
    if (bone == Bone::skull)
      return q.y() > skull_line(q.z()) && distance_to_lips(p) >= skull_off_lips_m;
    return p.y() < lower_lip_ - jaw_below_lip_m && q.z() > ramus_z_ &&
           distance_to_lips(p) >= jaw_off_lips_m;
  }

  /// Whether the tissue of a node covers the cartilage of the nose.
  bool on_cartilage(const Vec3& inner, const Vec3& outer) const {
    const Vec3 p = frame_.local(outer);
    return std::abs(p.x()) < nose_.half_width && p.z() > nose_.back && p.y() < nose_.top &&
           attached(Bone::skull, inner, outer);
  }

  /// `inner` and `outer`: the two ends of the layer at one node.
  Bone under(const Vec3& inner, const Vec3& outer) const {
    const Vec3 q = frame_.local(inner), p = frame_.local(outer);
    const double to_lips = distance_to_lips(p);
    if (q.y() > skull_line(q.z()) && to_lips >= skull_off_lips_m) return Bone::skull;
    if (p.y() < lower_lip_ - jaw_below_lip_m && p.y() > jaw_edge(p.x()) - jaw_below_edge_m &&
        distance_to_jaw(p, chin_first, chin_last) < jaw_reach_m && to_lips >= jaw_off_lips_m)
      return Bone::mandible;
    return Bone::none;
  }

  /// From a point in the face's frame to the nearest of the lips' points.
  double distance_to_lips(const Vec3& p) const {
    double best = 1;
    for (const Vec3& l : lips_) best = std::min(best, (p - l).norm());
    return best;
  }

  /// The place of the jaw's line between two of its points nearest to a point in the face's frame.
  Vec3 nearest_on_jaw(const Vec3& p, int first, int last) const {
    Vec3 best = jaw_line_[first];
    for (int k = first; k < last; ++k) {
      const Vec3 e = jaw_line_[k + 1] - jaw_line_[k];
      const double t = std::clamp((p - jaw_line_[k]).dot(e) / e.squaredNorm(), 0.0, 1.0);
      const Vec3 at = jaw_line_[k] + t * e;
      if ((p - at).norm() < (p - best).norm()) best = at;
    }
    return best;
  }
  double distance_to_jaw(const Vec3& p, int first, int last) const {
    return (p - nearest_on_jaw(p, first, last)).norm();
  }

  EdgeOfJaw edge_from(const Vec3& outer) const {
    const Vec3 p = frame_.local(outer), at = nearest_on_jaw(p, chin_first, chin_last);
    return {p.y() < at.y(), frame_.world(at), (p - at).norm()};
  }

  const face::FaceFrame& frame() const { return frame_; }

 private:
  /// Height of the skull's lower border at depth z.
  double skull_line(double z) const {
    const double t = std::clamp((z - ear_base_.z()) / (nose_base_.z() - ear_base_.z()), -0.5, 1.2);
    return ear_base_.y() + t * (nose_base_.y() - ear_base_.y());
  }

  /// Height of the jaw's lower edge at x. Beside the face it is 1 m, higher than all tissue.
  double jaw_edge(double x) const {
    for (int k = 0; k < 16; ++k) {
      const Vec3 &a = jaw_line_[k], &b = jaw_line_[k + 1];
      if ((x - a.x()) * (x - b.x()) <= 0 && a.x() != b.x())
        return a.y() + (x - a.x()) / (b.x() - a.x()) * (b.y() - a.y());
    }
    return 1;
  }

  face::FaceFrame frame_;
  NoseCartilage nose_;
  std::vector<Vec3> jaw_line_, lips_;
  Vec3 nose_base_, ear_base_;
  double lower_lip_ = 0, ramus_z_ = 0;
};

}  // namespace

std::vector<Bone> bones_under(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks) {
  const BoneMap map(landmarks, mesh.bones.get());
  const auto& volume = mesh.volume;
  std::vector<Bone> bones(volume.surface_nodes());
  for (int v = 0; v < volume.surface_nodes(); ++v) {
    const Vec3 inner = volume.nodes.row(volume.inner_node(v)), outer = volume.nodes.row(v);
    if (!mesh.bones) {
      bones[v] = map.under(inner, outer);
      continue;
    }
    const Bone bone = mesh.bones->nearest(inner, attached_m).bone;
    if (bone == Bone::none && map.on_cartilage(inner, outer)) bones[v] = Bone::skull;
    if (bone != Bone::none && map.attached(bone, inner, outer)) bones[v] = bone;
  }
  return bones;
}

std::vector<char> backed_by_bone(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks) {
  const auto& volume = mesh.volume;
  std::vector<char> out(volume.surface_nodes(), 1);
  if (!mesh.bones) return out;
  const BoneMap map(landmarks, nullptr);
  for (int v = 0; v < volume.surface_nodes(); ++v)
    out[v] =
        map.edge_from(volume.nodes.row(v)).below ||
        mesh.bones->nearest(volume.nodes.row(volume.inner_node(v)), backed_m).bone != Bone::none;
  return out;
}

std::vector<EdgeOfJaw> edge_of_jaw(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks) {
  const BoneMap map(landmarks, nullptr);
  std::vector<EdgeOfJaw> out;
  for (int v = 0; v < mesh.volume.surface_nodes(); ++v)
    out.push_back(map.edge_from(mesh.volume.nodes.row(v)));
  return out;
}

std::vector<double> distances_to_lips(const tissue::TissueMesh& mesh,
                                      const io::Landmarks& landmarks) {
  const BoneMap map(landmarks, nullptr);
  const Points& skin = mesh.volume.outer.points;
  std::vector<double> distances(skin.rows());
  for (Eigen::Index v = 0; v < skin.rows(); ++v)
    distances[v] = map.distance_to_lips(map.frame().local(skin.row(v)));
  return distances;
}

std::vector<char> near_jaw(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks) {
  const BoneMap map(landmarks, nullptr);
  const Points& skin = mesh.volume.outer.points;
  std::vector<char> near(skin.rows());
  for (Eigen::Index v = 0; v < skin.rows(); ++v)
    near[v] = map.distance_to_jaw(map.frame().local(skin.row(v)), 4, 12) < border_free_m;
  return near;
}

std::vector<char> over_frontalis(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks) {
  const face::FaceFrame frame = face::face_frame(landmarks);
  std::vector<Vec3> brows;
  for (int k = brow_first; k <= brow_last; ++k)
    brows.push_back(frame.local(landmarks.at(face::ibug(k))));
  const Points& skin = mesh.volume.outer.points;
  std::vector<char> over(skin.rows());
  for (Eigen::Index v = 0; v < skin.rows(); ++v) {
    const Vec3 p = frame.local(skin.row(v));
    const Vec3& brow = *std::ranges::min_element(
        brows, {}, [&](const Vec3& at) { return (p - at).squaredNorm(); });
    over[v] = p.y() > brow.y() && (p - brow).norm() < frontalis_reach_m;
  }
  return over;
}

}  // namespace hyperex::simulate
