// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/teeth/teeth_fit.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "hyperex/anatomy/lips.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/mesh_distance.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::anatomy {
namespace {

using Eigen::Index;

constexpr double kMeanBreadth_m = 0.0895, kIncisorShow_m = 0.003, kLowerShow_m = 0.0005,
                 kLeastApart_m = 0.0005;
constexpr double kOcclusionFalls_deg = 7, kFarthestBehind_m = 0.025;

/// The frame of the arches in the scan: x is left in it, y up, z forward.
struct MouthFrame {
  Eigen::Isometry3d scan_from_arch = Eigen::Isometry3d::Identity();
  double lips_apart_m = 0;
  Vec3 hinge = Vec3::Zero();  ///< of the jaw, in the arches' frame
  Vec3 back = Vec3::Zero();   ///< into the head, level in the face, in the arches' frame
};

MouthFrame mouth_frame(const io::Landmarks& landmarks) {
  const face::FaceFrame face = face::face_frame(landmarks);
  const auto local = [&](int k) { return face.local(landmarks.at(face::ibug(k))); };
  double middle = 0;
  constexpr int on_it[] = {27, 30, 33, 8, 62, 66};
  constexpr int beside[][2] = {{36, 45}, {39, 42}, {48, 54}, {31, 35}};
  for (const int k : on_it) middle += local(k).x() / 10;
  for (const auto& pair : beside) middle += (local(pair[0]).x() + local(pair[1]).x()) / 2 / 10;
  const Vec3 upper = local(62), lower = local(66);
  const double tilt = kOcclusionFalls_deg * std::numbers::pi / 180;
  Eigen::Isometry3d face_from_arch = Eigen::Isometry3d::Identity();
  // A turn about x by a positive angle lowers what is in front.
  face_from_arch.linear() = Eigen::AngleAxisd(tilt, Vec3::UnitX()).toRotationMatrix();
  face_from_arch.translation() =
      Vec3(middle, upper.y() - kIncisorShow_m, std::min(upper.z(), lower.z()));
  Eigen::Isometry3d scan_from_face = Eigen::Isometry3d::Identity();
  scan_from_face.linear() = face.face_from_scan().transpose();
  scan_from_face.translation() = face.origin;
  MouthFrame out;
  out.scan_from_arch = scan_from_face * face_from_arch;
  out.lips_apart_m = std::max(0.0, upper.y() - lower.y());
  Vec3 hinge = (local(1) + local(15)) / 2;
  hinge.x() = middle;
  out.hinge = face_from_arch.inverse() * hinge;
  out.back = face_from_arch.linear().transpose() * -Vec3::UnitZ();
  return out;
}

/// Opens the lower arch (in the arches' frame) until its incisors' edges are lower by `drop_m`.
void open_jaw(JawTeeth& lower, const Vec3& hinge, const Vec3& edge, double drop_m) {
  const Vec3 arm = edge - hinge;
  const double radius = std::hypot(arm.y(), arm.z());
  const double from = std::atan2(arm.y(), arm.z());
  const double to = std::asin(std::clamp((arm.y() - drop_m) / radius, -1.0, 1.0));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(from - to, Vec3::UnitX()).toRotationMatrix();
  for (TriMesh* part : {&lower.crowns, &lower.gum})
    part->points = ((part->points.rowwise() - hinge.transpose()) * turn.transpose()).rowwise() +
                   hinge.transpose();
}

/// A place for arches of one size, found by going back from the lips.
struct Placed {
  double back_m = 0, clearance_m = -1;
};

Points outer_places(const Teeth& teeth) {
  std::vector<Vec3> places;
  for (const TriMesh* part :
       {&teeth.upper.crowns, &teeth.upper.gum, &teeth.lower.crowns, &teeth.lower.gum}) {
    const Points normals = vertex_normals(*part);
    for (Index v = 0; v < part->points.rows(); ++v) {
      const Vec3 p = part->points.row(v), n = normals.row(v);
      // Only what faces lips and cheeks, not the tongue: outwards from the arch's inside.
      if (n.dot(Vec3(p.x(), 0, p.z() + 0.035).normalized()) > 0.3) places.push_back(p);
    }
  }
  Points out(Index(places.size()), 3);
  for (std::size_t i = 0; i < places.size(); ++i) out.row(Index(i)) = places[i];
  return out;
}

Placed place(const Points& places, const MouthFrame& frame, const MeshDistance& tissue) {
  Placed out;
  // Lower bounds of the distances to the tissue: the last measured one minus the displacement
  // since.
  std::vector<double> left(std::size_t(places.rows()), -1);
  const double need = kTeethClearance_m;
  while (out.back_m < kFarthestBehind_m) {
    double least = 1;
    for (Index i = 0; i < places.rows(); ++i) {
      double& own = left[std::size_t(i)];
      if (own < need)
        own = tissue.at(frame.scan_from_arch *
                        Vec3(places.row(i).transpose() + out.back_m * frame.back));
      least = std::min(least, own);
    }
    out.clearance_m = least;
    if (least >= need) return out;
    const double step = std::clamp(need - least, 1e-4, 1e-3);
    out.back_m += step;
    for (double& own : left) own -= step;
  }
  out.clearance_m = -1;
  return out;
}

void move(Teeth& teeth, const Eigen::Isometry3d& by) {
  for (JawTeeth* jaw : {&teeth.upper, &teeth.lower})
    for (TriMesh* part : {&jaw->crowns, &jaw->gum})
      part->points =
          (part->points * by.linear().transpose()).rowwise() + by.translation().transpose();
}

}  // namespace

TeethFit fit_teeth(const TriMesh& skin, const TriMesh& boundary, const io::Landmarks& landmarks) {
  TeethFit fit;
  for (const std::string& name : face::all_ibug())
    if (!landmarks.contains(name)) {
      fit.why_none = "the landmark " + name + " is missing";
      return fit;
    }
  if (!mouth_is_open(skin, landmarks)) {
    fit.why_none = "the lips are joined";
    return fit;
  }
  const MouthFrame frame = mouth_frame(landmarks);
  const MeshDistance tissue(boundary);
  fit.size.scale = std::clamp(
      (landmarks.at(face::ibug(45)) - landmarks.at(face::ibug(36))).norm() / kMeanBreadth_m, 0.7,
      1.3);
  double best = 1;
  for (const double breadth : {1.0, 0.9, 0.8}) {
    const ArchSize size{fit.size.scale, breadth};
    Teeth teeth = dental_arches(size);
    // In occlusion the lower edges stand above the upper ones by the overbite.
    const Vec3 edge = size.scale * Vec3(0, kOverbite_m, -kOverjet_m);
    const double of_lips =
        frame.lips_apart_m + kOverbite_m * size.scale - kIncisorShow_m - kLowerShow_m;
    open_jaw(teeth.lower, frame.hinge, edge, std::max(kLeastApart_m, of_lips));
    const Placed placed = place(outer_places(teeth), frame, tissue);
    if (placed.clearance_m < 0) continue;
    const double narrowed_m = (1 - breadth) * 0.056 * size.scale;
    const double cost = placed.back_m + narrowed_m / 2;
    if (cost >= best) continue;
    best = cost;
    fit.size = size;
    fit.behind_lips_m = placed.back_m;
    fit.least_clearance_m = placed.clearance_m;
    move(teeth, frame.scan_from_arch * Eigen::Translation3d(Vec3(placed.back_m * frame.back)));
    fit.teeth = std::move(teeth);
  }
  if (fit.teeth.upper.empty()) fit.why_none = "no place for them is found behind lips and cheeks";
  return fit;
}

}  // namespace hyperex::anatomy
