// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/muscles/fold_pull.hpp"

#include <cmath>
#include <numbers>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
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

Points nasolabial_fold(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks, bool left) {
  const face::FaceFrame frame = face::face_frame(landmarks);
  const double mm = 1e-3 * scale_of(landmarks);
  const Vec3 out = (left ? 1 : -1) * mm * frame.x, up = mm * frame.y;
  const Vec3 wing =
      landmarks.at(face::ibug(left ? 35 : 31)) + kUpper_mm[0] * out + kUpper_mm[1] * up;
  const Vec3 corner =
      landmarks.at(face::ibug(left ? 54 : 48)) + kLower_mm[0] * out + kLower_mm[1] * up;
  const SurfaceTree skin(mesh.volume.outer);
  Points line(kPieces + 1, 3);
  for (int k = 0; k <= kPieces; ++k) {
    const double s = double(k) / kPieces;
    line.row(k) =
        skin.query((1 - s) * wing + s * corner + 4 * s * (1 - s) * kBow_mm * out).point.transpose();
  }
  return line;
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
