// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/face_backing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::report {
namespace {

using anatomy::FaceCorners;
using Eigen::Index;

Vec3 centre_of(const std::vector<int>& loop, const Points& points) {
  Vec3 centre = Vec3::Zero();
  for (const int v : loop) centre += points.row(v).transpose() / double(loop.size());
  return centre;
}

/// About the middle between the corners of the mouth, and as wide.
bool is_mouth(const std::vector<int>& loop, const Points& points, const FaceCorners& corners) {
  const Vec3 across = corners.mouth[1] - corners.mouth[0];
  const Vec3 off = centre_of(loop, points) - (corners.mouth[1] + corners.mouth[0]) / 2;
  double least = 0, most = 0;
  for (const int v : loop) {
    const double at = (points.row(v).transpose() - corners.mouth[0]).dot(across);
    least = v == loop.front() ? at : std::min(least, at);
    most = v == loop.front() ? at : std::max(most, at);
  }
  return off.norm() < 0.4 * across.norm() && most - least > 0.6 * across.squaredNorm();
}

/// Between the outer corners of the eyes, seen from the front: not where a scan is torn at its rim.
bool in_the_face(const std::vector<int>& loop, const Points& points, const FaceCorners& corners) {
  const Vec3 centre = centre_of(loop, points);
  const Vec3 across = corners.outer[1] - corners.outer[0];
  const double share = (centre - corners.outer[0]).dot(across) / across.squaredNorm();
  return share > 0 && share < 1;
}

/// How deep a pocket may reach behind an opening before it shows behind the scan in profile: as far
/// as the scan's border at the heights that the pocket has, less a clearance.
/// Infinite where the border is elsewhere, as on a whole head.
double room_behind(const Opening& opening, const std::vector<int>& border, const Points& points,
                   const FaceCorners& corners) {
  // Lips that smile or open take the pocket along, up, down and back.
  constexpr double moves_m = 0.01, clear_m = 0.014, least_m = 0.004;
  const Vec3 centre = centre_of(opening.loop, points);
  const Vec3 up = opening.inward.cross(corners.outer[1] - corners.outer[0]).normalized();
  double half_m = 0;
  for (const int v : opening.loop)
    half_m = std::max(half_m, std::abs(up.dot(points.row(v).transpose() - centre)));
  double room_m = INFINITY;
  for (const int v : border) {
    const Vec3 off = points.row(v).transpose() - centre;
    if (std::abs(up.dot(off)) > 1.35 * half_m + moves_m) continue;
    room_m = std::min(room_m, off.dot(opening.inward) - clear_m);
  }
  return std::max(room_m, least_m);
}

std::vector<Opening> openings_of(const TriMesh& skin, const FaceCorners& corners) {
  constexpr double longest_m = 0.25;
  const std::vector<std::vector<int>> loops = boundary_loops(skin.triangles);
  std::vector<double> length_m;
  for (const auto& loop : loops) length_m.push_back(loop_length(loop, skin.points));
  const Points normals = vertex_normals(skin);
  const auto border = std::max_element(length_m.begin(), length_m.end()) - length_m.begin();
  std::vector<Opening> openings;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (std::ptrdiff_t(i) == border || length_m[i] > longest_m || loops[i].size() < 3 ||
        !in_the_face(loops[i], skin.points, corners))
      continue;
    Vec3 outward = Vec3::Zero();
    for (const int v : loops[i]) outward += normals.row(v).transpose();
    outward /= double(loops[i].size());
    // The edge of a lip is rolled in; the face's own direction keeps the pocket behind it.
    openings.push_back({loops[i], -(corners.forward + 0.5 * outward).normalized(),
                        std::min(0.03, 0.25 * length_m[i])});
    if (is_mouth(loops[i], skin.points, corners)) {
      // As deep as a row of teeth, and wide enough for it between the cheeks.
      openings.back().depth_m = 0.5 * length_m[i];
      openings.back().rings = {{{0.22, 1.35}, {0.95, 1.3}}};
    }
    openings.back().depth_m =
        std::min(openings.back().depth_m,
                 room_behind(openings.back(), loops[std::size_t(border)], skin.points, corners));
  }
  return openings;
}

/// The part of a sphere between two angles from its gaze, radians.
TriMesh zone(const Eyeball& eye, double from, double to, int rings) {
  constexpr int sectors = 32;
  const Vec3 x = eye.gaze.unitOrthogonal(), y = eye.gaze.cross(x);
  TriMesh mesh;
  mesh.points.resize((rings + 1) * sectors, 3);
  for (int i = 0; i <= rings; ++i)
    for (int k = 0; k < sectors; ++k) {
      const double polar = from + (to - from) * i / rings;
      const double turn = 2 * std::numbers::pi * k / sectors;
      const Vec3 out =
          std::cos(polar) * eye.gaze + std::sin(polar) * (std::cos(turn) * x + std::sin(turn) * y);
      mesh.points.row(i * sectors + k) = (eye.centre + eye.radius_m * out).transpose();
    }
  mesh.triangles.resize(2 * rings * sectors, 3);
  Index row = 0;
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < sectors; ++k) {
      const int a = i * sectors + k, b = i * sectors + (k + 1) % sectors;
      mesh.triangles.row(row++) << a, a + sectors, b + sectors;
      mesh.triangles.row(row++) << a, b + sectors, b;
    }
  return mesh;
}

}  // namespace

FaceBacking face_backing(const TriMesh& skin, const io::Landmarks& landmarks) {
  FaceBacking backing;
  const auto corners = anatomy::face_corners(landmarks);
  if (!corners) return backing;
  backing.forward = corners->forward;
  backing.openings = openings_of(skin, *corners);
  backing.eyeballs = anatomy::eyeballs_behind(skin.points, *corners);
  return backing;
}

FaceBacking face_backing(const simulate::Performance& performance) {
  io::Landmarks landmarks;
  const motion::Motion& tracks = performance.landmarks;
  if (!tracks.positions.empty())
    for (std::size_t i = 0; i < tracks.names.size(); ++i)
      landmarks[tracks.names[i]] = tracks.positions.front().row(Index(i)).transpose();
  return face_backing(performance.skin_rest, landmarks);
}

Eigen::VectorXd light_in_mouth(const TriMesh& part, const TriMesh& row, const Vec3& forward) {
  constexpr double dark_m = 0.035, least = 0.35;
  if (part.points.rows() == 0 || row.points.rows() == 0)
    return Eigen::VectorXd::Ones(part.points.rows());
  const double front = (row.points * forward).maxCoeff();
  const Eigen::ArrayXd behind = (front - (part.points * forward).array()) / dark_m;
  return 1 - (1 - least) * behind.max(0).min(1);
}

TriMesh pocket(const Opening& opening, const Points& points) {
  const auto n = Index(opening.loop.size());
  const Vec3 centre = centre_of(opening.loop, points);
  TriMesh mesh;
  mesh.points.resize(3 * n + 1, 3);
  const auto ring = [&](Index which, double depth, double width) {
    for (Index i = 0; i < n; ++i) {
      const Vec3 edge = points.row(opening.loop[std::size_t(i)]);
      mesh.points.row(which * n + i) =
          (centre + width * (edge - centre) + depth * opening.depth_m * opening.inward).transpose();
    }
  };
  ring(0, 0, 1);
  ring(1, opening.rings[0].depth, opening.rings[0].width);
  ring(2, opening.rings[1].depth, opening.rings[1].width);
  mesh.points.row(3 * n) = (centre + opening.depth_m * opening.inward).transpose();
  mesh.triangles.resize(5 * n, 3);
  Index row = 0;
  for (Index i = 0; i < n; ++i) {
    const int a = int(i), b = int((i + 1) % n), m = int(n);
    for (const int r : {0, m}) {
      mesh.triangles.row(row++) << r + b, r + a, r + m + a;
      mesh.triangles.row(row++) << r + b, r + m + a, r + m + b;
    }
    mesh.triangles.row(row++) << 2 * m + b, 2 * m + a, 3 * m;
  }
  return mesh;
}

std::vector<TriMesh> eyeball_parts(const Eyeball& eyeball) {
  // An iris of 11.7 mm and a pupil of 4 mm on a ball of 24 mm, as angles from the gaze.
  constexpr double pupil = 0.167, iris = 0.51;
  return {zone(eyeball, iris, std::numbers::pi, 16), zone(eyeball, pupil, iris, 3),
          zone(eyeball, 0, pupil, 2)};
}

}  // namespace hyperex::report
