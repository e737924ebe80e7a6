// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/skin_measured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hyperex/anatomy/lips.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/smooth_step.hpp"
#include "hyperex/simulate/drive/triangulate.hpp"

namespace hyperex::simulate {
namespace {

double share_at(const Vec3& p, const std::vector<Vec3>& centres, const RegionOptions& options) {
  if (options.measured == Measured::all) return 1;
  double nearest = 1;
  for (const Vec3& c : centres) nearest = std::min(nearest, (p - c).norm());
  if (nearest <= options.measured_radius_m) return 1;
  if (nearest >= options.measured_radius_m + options.blend_m) return 0;
  return 1 - smooth_step((nearest - options.measured_radius_m) / options.blend_m);
}

/// Which lip a place belongs to; only near the mouth and where it is clear.
std::vector<int> sides(const Points& places, const std::vector<double>& margin,
                       const face::FaceFrame& frame, double reach) {
  std::vector<int> side(places.rows(), 0);
  constexpr double sure_m = 0.004;
  for (Eigen::Index i = 0; i < places.rows(); ++i)
    if (std::abs(margin[i]) > sure_m && (places.row(i).transpose() - frame.origin).norm() < reach)
      side[i] = margin[i] > 0 ? 1 : -1;
  return side;
}

/// Which lip each tracked point belongs to: by its name, or where the motion has a mesh of its own,
/// whose vertices have numbers for names, by walking on that.
std::vector<int> point_sides(const TriMesh& tracked, const std::vector<std::string>& names,
                             const io::Landmarks& landmarks, const face::FaceFrame& frame,
                             double reach) {
  std::vector<int> row(names.size(), -1), used;  // of points that triangles hold
  TriMesh mesh{{}, tracked.triangles};
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      int& at = row[std::size_t(mesh.triangles(f, k))];
      if (at < 0) {
        at = int(used.size());
        used.push_back(mesh.triangles(f, k));
      }
      mesh.triangles(f, k) = at;
    }
  mesh.points = tracked.points(used, Eigen::all);
  const std::vector<int> walked =
      sides(mesh.points, anatomy::upper_lip_margin(mesh, landmarks), frame, reach);
  std::vector<int> side;
  for (std::size_t p = 0; p < names.size(); ++p) {
    const int named = anatomy::lip_of(names[p]);
    side.push_back(named != 0 || row[p] < 0 ? named : walked[std::size_t(row[p])]);
  }
  return side;
}

}  // namespace

MeasuredRegion measured_region(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                               const AlignedMotion& motion, const RegionOptions& options) {
  MeasuredRegion region;
  region.share.assign(mesh.skin.points.rows(), 0.0);
  region.outer_share.assign(mesh.volume.surface_nodes(), 0.0);
  if (options.measured == Measured::none) return region;

  std::vector<Vec3> centres;
  for (const std::string& name : options.measured_points) {
    const int i = motion.motion.index_of(name);
    if (i < 0)
      throw InputError(motion.motion.source,
                       fmt::format("has no point {}, whose surroundings are to be measured", name));
    centres.push_back(motion.rest.row(i).transpose());
  }
  const face::FaceFrame frame = face::face_frame(landmarks);
  TriMesh tracked{motion.rest, motion.motion.triangles};
  const bool own_mesh = tracked.triangles.rows() > 0;
  if (!own_mesh) tracked.triangles = triangulate_points(motion.motion.names, motion.rest, frame);
  if (tracked.triangles.rows() == 0)
    throw InputError(motion.motion.source,
                     "has too few points to make triangles of; expected at "
                     "least three, not on one line, for a measured region");
  const double reach = 1.8 * (landmarks.at(face::ibug(54)) - frame.origin).norm();
  std::vector<int> point_side;
  if (own_mesh)
    point_side = point_sides(tracked, motion.motion.names, landmarks, frame, reach);
  else
    for (const auto& name : motion.motion.names) point_side.push_back(anatomy::lip_of(name));
  region.skin = match(mesh.skin.points, tracked,
                      sides(mesh.skin.points, mesh.skin_upper_margin, frame, reach), point_side);
  const Points& outer = mesh.volume.outer.points;
  region.outer = match(outer, tracked, sides(outer, mesh.upper_margin, frame, reach), point_side);
  for (Eigen::Index v = 0; v < mesh.skin.points.rows(); ++v)
    region.share[v] = share_at(mesh.skin.points.row(v), centres, options);
  for (Eigen::Index v = 0; v < outer.rows(); ++v)
    region.outer_share[v] = share_at(outer.row(v), centres, options);
  return region;
}

}  // namespace hyperex::simulate
