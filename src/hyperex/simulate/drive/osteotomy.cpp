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

}  // namespace

Osteotomies::Osteotomies(const std::vector<BoneMove>& moves, const io::Landmarks& landmarks,
                         const anatomy::Bones* bones)
    : frame_(face::face_frame(landmarks)) {
  const Vec3 condyles = JawHinge(landmarks, bones).centre;
  const auto local = [&](int k) { return frame_.local(landmarks.at(ibug(k))); };
  for (const BoneMove& move : moves) {
    Move out{whole_skull, 0, {}};
    Vec3 centre = condyles;
    switch (move.part) {
      case BonePart::skull:
        break;
      case BonePart::maxilla:
        out.segment = upper;
        out.plane_m = local(33).y() + kLeFortAboveNose_m + move.cut_shift_m;
        centre = landmarks.at(ibug(33));
        break;
      case BonePart::mandible:
        if (move.cut == BoneCut::whole) {
          out.segment = whole_mandible;
          break;
        }
        out.segment = front_of_mandible;
        out.plane_m = 0.5 * (frame_.local(condyles).z() + local(8).z()) + move.cut_shift_m;
        centre = landmarks.at(ibug(66));
        break;
      case BonePart::chin:
        out.segment = chin_alone;
        out.plane_m = local(8).y() + kChinShare * (local(57).y() - local(8).y()) + move.cut_shift_m;
        centre = landmarks.at(ibug(8));
        break;
    }
    out.motion = motion_of(move, frame_, centre);
    moves_.push_back(out);
  }
}

bool Osteotomies::holds(const Move& move, Bone bone, const Vec3& local) {
  switch (move.segment) {
    case whole_skull:
      return bone == Bone::skull;
    case upper:
      return bone == Bone::skull && local.y() < move.plane_m;
    case whole_mandible:
      return bone == Bone::mandible;
    case front_of_mandible:
      return bone == Bone::mandible && local.z() > move.plane_m;
    case chin_alone:
      return bone == Bone::mandible && local.y() < move.plane_m &&
             std::abs(local.x()) < kHalfChin_m;
  }
  return false;
}

template <class Holds>
Eigen::Isometry3d Osteotomies::product(const Holds& holds) const {
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  for (const Move& move : moves_)
    if (holds(move)) out = move.motion * out;
  return out;
}

Eigen::Isometry3d Osteotomies::motion(Bone bone, const Vec3& at) const {
  const Vec3 local = frame_.local(at);
  return product([&](const Move& move) { return holds(move, bone, local); });
}

Eigen::Isometry3d Osteotomies::cranium() const {
  return product([](const Move& move) { return move.segment == whole_skull; });
}

Eigen::Isometry3d Osteotomies::upper_teeth() const {
  return product(
      [](const Move& move) { return move.segment == whole_skull || move.segment == upper; });
}

Eigen::Isometry3d Osteotomies::lower_teeth() const {
  return product([](const Move& move) {
    return move.segment == whole_mandible || move.segment == front_of_mandible;
  });
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
