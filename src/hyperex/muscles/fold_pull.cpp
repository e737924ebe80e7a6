// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/muscles/fold_pull.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

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

/// The landmarks of the fold where they are given, and else the rule.
FoldCurve fold_curve(const io::Landmarks& landmarks, bool left) {
  const face::FaceFrame frame = face::face_frame(landmarks);
  const double mm = 1e-3 * scale_of(landmarks);
  const Vec3 out = (left ? 1 : -1) * mm * frame.x, up = mm * frame.y;
  const auto given = [&](face::FoldPoint point) {
    return landmarks.find(face::fold_landmark(point, left));
  };
  const auto end_of = [&](face::FoldPoint point, int ibug, const double(&offset_mm)[2]) -> Vec3 {
    const auto found = given(point);
    if (found != landmarks.end()) return found->second;
    return landmarks.at(face::ibug(ibug)) + offset_mm[0] * out + offset_mm[1] * up;
  };
  FoldCurve curve{end_of(face::FoldPoint::upper, left ? 35 : 31, kUpper_mm),
                  end_of(face::FoldPoint::lower, left ? 54 : 48, kLower_mm), kBow_mm * out};
  if (const auto middle = given(face::FoldPoint::middle); middle != landmarks.end())
    curve.lead_through(middle->second);
  return curve;
}

/// The part of a line between the shares `from` and `to` of its length. The points of the line are
/// equally spaced.
MuscleLine part_of(const Points& line, double from, double to) {
  const auto at = [&](double share) {
    const double x = share * double(line.rows() - 1);
    const Eigen::Index i = std::min<Eigen::Index>(Eigen::Index(x), line.rows() - 2);
    return Vec3((1 - (x - double(i))) * line.row(i) + (x - double(i)) * line.row(i + 1));
  };
  MuscleLine out;
  out.line.resize(kPieces + 1, 3);
  for (int k = 0; k <= kPieces; ++k)
    out.line.row(k) = at(from + (to - from) * k / kPieces).transpose();
  out.arc = arc_of(out.line);
  return out;
}

}  // namespace

Points nasolabial_fold(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks, bool left) {
  const FoldCurve curve = fold_curve(landmarks, left);
  const SurfaceTree skin(mesh.volume.outer);
  Points line(kPieces + 1, 3);
  for (int k = 0; k <= kPieces; ++k)
    line.row(k) = skin.query(curve.at(double(k) / kPieces)).point.transpose();
  return line;
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
  const MuscleLine part = part_of(fold, muscle.fold_from, muscle.fold_to);
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
