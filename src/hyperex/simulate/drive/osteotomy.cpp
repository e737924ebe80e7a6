// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/osteotomy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hyperex/face/ibug.hpp"
#include "hyperex/simulate/drive/jaw.hpp"

namespace hyperex::simulate {
namespace {
using face::ibug;

constexpr double kLeFortAboveNose_m = 0.006, kChinShare = 0.45, kHalfChin_m = 0.027;
/// Two motions that differ by less are the same.
constexpr double kSame = 1e-12;

Eigen::Isometry3d motion_of(const BoneMove& move, const face::FaceFrame& axes, const Vec3& centre) {
  const Vec3 rad = Eigen::Map<const Vec3>(move.turn_deg.data()) * std::numbers::pi / 180;
  const Vec3 by = Eigen::Map<const Vec3>(move.move_m.data());
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  out.linear() = (Eigen::AngleAxisd(rad.z(), axes.z) * Eigen::AngleAxisd(rad.y(), axes.y) *
                  Eigen::AngleAxisd(rad.x(), axes.x))
                     .toRotationMatrix();
  out.translation() =
      centre - out.linear() * centre + by.x() * axes.x + by.y() * axes.y + by.z() * axes.z;
  return out;
}

/// The segment of one move.
BoneSegment segment_of(const BoneMove& move, const io::Landmarks& landmarks,
                       const face::FaceFrame& axes, const Vec3& condyles) {
  const auto at = [&](int k) -> Vec3 { return landmarks.at(ibug(k)); };
  BoneSegment out{move.part, move.cut == BoneCut::standard ? usual_cut(move.part) : move.cut,
                  condyles};
  switch (out.cut) {
    case BoneCut::le_fort_1:
      out.turns_about = at(33);
      out.plane_at = at(33) + (kLeFortAboveNose_m + move.cut_shift_m) * axes.y;
      out.plane_normal = -axes.y;
      out.ends_at = 0.5 * (condyles + at(33));
      break;
    case BoneCut::bsso:
      out.turns_about = at(66);
      out.plane_at = 0.5 * (condyles + at(8)) + move.cut_shift_m * axes.z;
      out.plane_normal = axes.z;
      break;
    case BoneCut::genioplasty:
      out.turns_about = at(8);
      out.plane_at = at(8) + kChinShare * (at(57) - at(8)) + move.cut_shift_m * axes.y;
      out.plane_normal = -axes.y;
      out.half_width_m = kHalfChin_m;
      break;
    case BoneCut::standard:
    case BoneCut::whole:
      break;
  }
  return out;
}

}  // namespace

std::vector<BoneSegment> usual_segments(const io::Landmarks& landmarks,
                                        const anatomy::Bones* bones) {
  const face::FaceFrame axes = face::face_frame(landmarks);
  const Vec3 condyles = JawHinge(landmarks, bones).centre;
  std::vector<BoneSegment> out;
  for (const auto& [word, part] : words_of(BonePart{}))
    out.push_back(segment_of({.part = part}, landmarks, axes, condyles));
  return out;
}

Osteotomies::Osteotomies(const std::vector<BoneMove>& moves, const io::Landmarks& landmarks,
                         const anatomy::Bones* bones)
    : frame_(face::face_frame(landmarks)), nose_(landmarks, frame_) {
  const Vec3 condyles = JawHinge(landmarks, bones).centre;
  for (const BoneMove& move : moves) {
    const BoneSegment segment = segment_of(move, landmarks, frame_, condyles);
    moves_.push_back({segment, motion_of(move, frame_, segment.turns_about)});
  }
}

bool Osteotomies::holds(const BoneSegment& segment, Bone bone, const Vec3& at) const {
  const bool of_skull = segment.part == BonePart::skull || segment.part == BonePart::maxilla;
  if (bone != (of_skull ? Bone::skull : Bone::mandible)) return false;
  if (segment.plane_normal.dot(at - segment.plane_at) <= 0 && !segment.plane_normal.isZero(0))
    return false;
  if (segment.ends_at && frame_.z.dot(at - *segment.ends_at) <= 0) return false;
  return segment.half_width_m == 0 || std::abs(frame_.local(at).x()) < segment.half_width_m;
}

template <class Holds>
Eigen::Isometry3d Osteotomies::product(const Holds& holds) const {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  for (const Move& move : moves_)
    if (holds(move.segment)) out = move.motion * out;
  return out;
}

Eigen::Isometry3d Osteotomies::motion(Bone bone, const Vec3& at) const {
  return product([&](const BoneSegment& segment) { return holds(segment, bone, at); });
}

Vec3 Osteotomies::displacement_of_skull(const Vec3& at) const {
  const Vec3 by = motion(Bone::skull, at) * at - at;
  const auto cut = std::find_if(moves_.begin(), moves_.end(), [](const Move& move) {
    return move.segment.part == BonePart::maxilla;
  });
  if (cut == moves_.end()) return by;
  const BoneSegment& maxilla = cut->segment;
  const double height = frame_.y.dot(at - maxilla.plane_at),
               clamped = nose_.top - frame_.local(maxilla.plane_at).y(),
               aside = frame_.local(at).x() / nose_.half_width;
  if (height <= 0 || height >= clamped || std::abs(aside) >= 1) return by;
  if (maxilla.ends_at && frame_.z.dot(at - *maxilla.ends_at) <= 0) return by;
  const double s = 1 - height / clamped;
  const double share = (3 * s * s - s * s * s) / 2 * (1 - std::abs(aside));
  const Vec3 foot = at - height * frame_.y, &across = maxilla.plane_normal;
  const Vec3 of_maxilla = upper_teeth() * foot - cranium() * foot;
  return by + share * (of_maxilla - of_maxilla.dot(across) * across);
}

Eigen::Isometry3d Osteotomies::cranium() const {
  return product([](const BoneSegment& segment) { return segment.part == BonePart::skull; });
}

Eigen::Isometry3d Osteotomies::upper_teeth() const {
  return product([](const BoneSegment& segment) {
    return segment.part == BonePart::skull || segment.part == BonePart::maxilla;
  });
}

Eigen::Isometry3d Osteotomies::lower_teeth() const {
  return product([](const BoneSegment& segment) { return segment.part == BonePart::mandible; });
}

BonesAbout::BonesAbout(const Osteotomies& cuts, const std::vector<Bone>& bones,
                       const Points& places) {
  for (std::size_t v = 0; v < bones.size(); ++v) {
    if (bones[v] == Bone::none) continue;
    const Vec3 at = places.row(Eigen::Index(v));
    const Eigen::Isometry3d motion = cuts.motion(bones[v], at);
    auto group = std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) {
      return (g.motion.matrix() - motion.matrix()).cwiseAbs().maxCoeff() < kSame;
    });
    if (group == groups_.end()) group = groups_.insert(group, {motion, {}});
    group->places.push_back(at);
  }
}

Vec3 BonesAbout::displacement(const Vec3& at) const {
  Vec3 sum = Vec3::Zero();
  double weights = 0;
  for (const Group& group : groups_) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3& p : group.places) nearest = std::min(nearest, (p - at).squaredNorm());
    const double weight = 1 / std::max(nearest, 1e-12);
    sum += weight * (group.motion * at - at);
    weights += weight;
  }
  return weights > 0 ? Vec3(sum / weights) : sum;
}

}  // namespace hyperex::simulate
