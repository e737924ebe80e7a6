// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/muscles/fold_pull.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "hyperex/anatomy/fold_profile.hpp"
#include "hyperex/core/quantile.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/face/optional_landmarks.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/node_areas.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::muscles {
namespace {

/// Where the weight is below this, the skin is not pulled.
constexpr double kLeastSkinWeight = 1e-3;
constexpr int kPieces = 40;

/// Offsets outwards and up, in mm on the template's face: from the wing of the nose to the fold's
/// upper end, from the corner of the mouth to its lower end, and the largest outward bow between
/// them. Measured on the groove of a real smile; the line agrees with it to 2 mm (docs/muscles.md).
constexpr double kUpper_mm[2] = {4.5, 5}, kLower_mm[2] = {10, 0}, kBow_mm = 1.5;
/// The share of the line at which a given middle lies is at least this from both ends. Nearer to an
/// end, a curve through all three would bend too much.
constexpr double kLeastShare = 0.2;

/// Cuts in which the groove at rest is the fold's. Of four faces with a smile, three are 2.1 to 2.5
/// mm deep there; on the fourth, and on the canonical face, what is 1.2 to 1.6 mm deep is not the
/// fold.
constexpr double kRestShares[] = {0.2, 0.3, 0.4};
constexpr double kRestDepth_mm = 1.75, kFarthestShift_mm = 6;

/// A quadratic curve from `upper` to `lower`: at the share s of its way it is
/// (1 - s) upper + s lower + 4 s (1 - s) bow.
struct FoldCurve {
  Vec3 upper, lower, bow;
  Vec3 at(double s) const { return (1 - s) * upper + s * lower + 4 * s * (1 - s) * bow; }

  /// Bows it so that it passes through `middle`, at the share that the distances from both ends
  /// give.
  void lead_through(const Vec3& middle) {
    const double above = (middle - upper).norm(), below = (lower - middle).norm();
    const double s =
        above + below > 0 ? std::clamp(above / (above + below), kLeastShare, 1 - kLeastShare) : 0.5;
    bow = (middle - (1 - s) * upper - s * lower) / (4 * s * (1 - s));
  }
};

/// The rule's line.
FoldCurve ruled_curve(const io::Landmarks& landmarks, bool left) {
  const face::FaceFrame frame = face::face_frame(landmarks);
  const double mm = 1e-3 * scale_of(landmarks);
  const Vec3 out = (left ? 1 : -1) * mm * frame.x, up = mm * frame.y;
  return {landmarks.at(face::ibug(left ? 35 : 31)) + kUpper_mm[0] * out + kUpper_mm[1] * up,
          landmarks.at(face::ibug(left ? 54 : 48)) + kLower_mm[0] * out + kLower_mm[1] * up,
          kBow_mm * out};
}

/// The landmarks of the fold where they are given, and else the rule, shifted.
FoldCurve fold_curve(const io::Landmarks& landmarks, bool left, const Vec3& shift) {
  const auto given = [&](face::FoldPoint point) {
    return landmarks.find(face::fold_landmark(point, left));
  };
  const auto or_given = [&](face::FoldPoint point, const Vec3& ruled) -> Vec3 {
    const auto found = given(point);
    return found == landmarks.end() ? Vec3(ruled + shift) : found->second;
  };
  FoldCurve curve = ruled_curve(landmarks, left);
  curve.upper = or_given(face::FoldPoint::upper, curve.upper);
  curve.lower = or_given(face::FoldPoint::lower, curve.lower);
  if (const auto middle = given(face::FoldPoint::middle); middle != landmarks.end())
    curve.lead_through(middle->second);
  return curve;
}

/// The curve laid on the skin: kPieces + 1 points.
Points laid_on_skin(const FoldCurve& curve, const TriMesh& surface) {
  const SurfaceTree skin(surface);
  Points line(kPieces + 1, 3);
  for (int k = 0; k <= kPieces; ++k)
    line.row(k) = skin.query(curve.at(double(k) / kPieces)).point.transpose();
  return line;
}

/// How far outwards (mm) a line crosses the cut at this share of the way.
double crossing_mm(const Points& line, const anatomy::FoldProfile& profile, double share) {
  double last_share = -1, last_mm = 0;
  for (Eigen::Index k = 0; k < line.rows(); ++k) {
    const Vec3 local = 1e3 * profile.frame().local(line.row(k).transpose());
    const Eigen::Vector2d from_wing = local.head<2>() - profile.wing();
    const double here = from_wing.dot(profile.along()) / profile.along().squaredNorm();
    const double out_mm = from_wing.dot(profile.across());
    if (k > 0 && last_share <= share && share <= here && here > last_share)
      return last_mm + (share - last_share) / (here - last_share) * (out_mm - last_mm);
    last_share = here;
    last_mm = out_mm;
  }
  return last_mm;
}

}  // namespace

Points part_of_fold(const Points& fold, const TemplateMuscle& muscle) {
  const double from = muscle.fold_from, to = muscle.fold_to;
  const auto at = [&](double share) {
    const double x = share * double(fold.rows() - 1);
    const Eigen::Index i = std::min<Eigen::Index>(Eigen::Index(x), fold.rows() - 2);
    return Vec3((1 - (x - double(i))) * fold.row(i) + (x - double(i)) * fold.row(i + 1));
  };
  Points part(kPieces + 1, 3);
  for (int k = 0; k <= kPieces; ++k) part.row(k) = at(from + (to - from) * k / kPieces).transpose();
  return part;
}

Vec3 groove_at_rest(const TriMesh& skin, const io::Landmarks& landmarks, bool left) {
  const anatomy::FoldProfile profile(skin, landmarks, left);
  const Points ruled = laid_on_skin(ruled_curve(landmarks, left), skin);
  std::vector<double> depths_mm, offsets_mm;
  for (const double share : kRestShares) {
    const auto groove = profile.groove(share);
    if (!groove) return Vec3::Zero();
    depths_mm.push_back(groove->depth_mm);
    offsets_mm.push_back(groove->place_mm - crossing_mm(ruled, profile, share));
  }
  const double offset_mm = median(offsets_mm);
  if (median(depths_mm) < kRestDepth_mm || std::abs(offset_mm) > kFarthestShift_mm)
    return Vec3::Zero();
  const Eigen::Vector2d across = profile.across();
  return 1e-3 * offset_mm * (across.x() * profile.frame().x + across.y() * profile.frame().y);
}

Points nasolabial_fold(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks, bool left,
                       bool from_rest) {
  const Vec3 shift = from_rest ? groove_at_rest(mesh.skin, landmarks, left) : Vec3(Vec3::Zero());
  return laid_on_skin(fold_curve(landmarks, left, shift), mesh.volume.outer);
}

io::Landmarks fold_places(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks) {
  io::Landmarks places;
  for (const bool left : {true, false}) {
    const Points line = nasolabial_fold(mesh, landmarks, left);
    for (const auto& [point, row] : {std::pair{face::FoldPoint::upper, 0},
                                     {face::FoldPoint::middle, kPieces / 2},
                                     {face::FoldPoint::lower, kPieces}})
      if (const std::string name = face::fold_landmark(point, left); !landmarks.contains(name))
        places[name] = line.row(row).transpose();
  }
  return places;
}

Eigen::VectorXd fold_pull(const MuscleLine& line, const TemplateMuscle& muscle, const Points& fold,
                          const tissue::TissueMesh& mesh, const FoldShape& shape) {
  const tissue::VolumeMesh& volume = mesh.volume;
  Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * volume.nodes.rows());
  if (!muscle.ends_in_fold()) return force;
  MuscleLine part;
  part.line = part_of_fold(fold, muscle);
  part.arc = arc_of(part.line);
  const double width = 1e-3 * shape.width_mm * line.scale;
  const double inwards = shape.inwards_deg * std::numbers::pi / 180;
  const Vec3 origin = line.line.row(0);
  const Points normals = vertex_normals(volume.outer);
  const Eigen::VectorXd areas = node_areas(volume.outer);
  for (int v = 0; v < volume.surface_nodes(); ++v) {
    const Vec3 at = volume.nodes.row(v), n = normals.row(v);
    const double weight = std::exp(-std::pow(nearest_on_line(part, at).distance_m / width, 2));
    if (weight < kLeastSkinWeight) continue;
    const Vec3 towards = origin - at;
    const Vec3 along = (towards - n * n.dot(towards)).normalized();
    force.segment<3>(3 * v) =
        weight * areas[v] * (std::cos(inwards) * along - std::sin(inwards) * n);
  }
  return force;
}

}  // namespace hyperex::muscles
