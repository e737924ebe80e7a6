// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/face_backing.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/report/mouth_lining.hpp"

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

/// About the middle between the corners of the right (0) or left (1) eye.
bool is_at_eye(const std::vector<int>& loop, const Points& points, const FaceCorners& corners,
               std::size_t side) {
  const auto& inner = corners.inner[side];
  if (!inner) return false;
  const Vec3& outer = corners.outer[side];
  return (centre_of(loop, points) - (*inner + outer) / 2).norm() < 0.5 * (*inner - outer).norm();
}
bool is_eye(const std::vector<int>& loop, const Points& points, const FaceCorners& corners) {
  return is_at_eye(loop, points, corners, 0) || is_at_eye(loop, points, corners, 1);
}

/// Between the outer corners of the eyes, seen from the front.
bool in_the_face(const std::vector<int>& loop, const Points& points, const FaceCorners& corners) {
  const Vec3 centre = centre_of(loop, points);
  const Vec3 across = corners.outer[1] - corners.outer[0];
  const double share = (centre - corners.outer[0]).dot(across) / across.squaredNorm();
  return share > 0 && share < 1;
}

/// A hole of the scan beside that, as on a cheek: it faces forward and is not torn at the scan's
/// rim.
bool on_a_cheek(const std::vector<int>& loop, const Vec3& outward, const std::vector<int>& border,
                const Points& points, const FaceCorners& corners) {
  constexpr double torn_within_m = 0.01, faces = 0.3;
  if (outward.dot(corners.forward) < faces * outward.norm()) return false;
  const Points rim = points(border, Eigen::all);
  return std::ranges::all_of(loop, [&](int v) {
    return (rim.rowwise() - points.row(v)).rowwise().norm().minCoeff() > torn_within_m;
  });
}

Vec3 up_of(const Opening& opening, const FaceCorners& corners) {
  return opening.inward.cross(corners.outer[1] - corners.outer[0]).normalized();
}

/// Half of an opening's height.
double half_height(const Opening& opening, const Points& points, const FaceCorners& corners) {
  const Vec3 centre = centre_of(opening.loop, points), up = up_of(opening, corners);
  double half_m = 0;
  for (const int v : opening.loop)
    half_m = std::max(half_m, std::abs(up.dot(points.row(v).transpose() - centre)));
  return half_m;
}

/// How deep a pocket may reach behind an opening before it shows behind the scan in profile: as far
/// as the scan's border at the heights that the pocket has, less a clearance.
/// Infinite where the border is elsewhere, as on a whole head.
double room_behind(const Opening& opening, double low_m, double high_m,
                   const std::vector<int>& border, const Points& points,
                   const FaceCorners& corners) {
  // Lips that smile or open take the pocket along, up, down and back.
  constexpr double moves_m = 0.01, clear_m = 0.014, least_m = 0.004;
  const Vec3 centre = centre_of(opening.loop, points);
  const Vec3 up = up_of(opening, corners);
  double room_m = INFINITY;
  for (const int v : border) {
    const Vec3 off = points.row(v).transpose() - centre;
    const double height = up.dot(off);
    if (height < low_m - moves_m || height > high_m + moves_m) continue;
    room_m = std::min(room_m, off.dot(opening.inward) - clear_m);
  }
  return std::max(room_m, least_m);
}

/// A pocket as wide as its edge: two rings and a point.
void hang_pocket(Opening& opening, const Points& points, const std::array<Srgb, 3>& colours) {
  constexpr std::array<std::array<double, 2>, 2> depth_and_width = {{{0.35, 1.05}, {0.9, 0.8}}};
  const auto n = Index(opening.loop.size());
  const Points edge = points(opening.loop, Eigen::all);
  const Vec3 centre = centre_of(opening.loop, points);
  opening.rest.resize(3 * n + 1, 3);
  opening.rest.topRows(n) = edge;
  opening.colours.assign(std::size_t(n), colours[0]);
  for (std::size_t r = 0; r < 2; ++r) {
    const auto [depth, width] = depth_and_width[r];
    const Vec3 at = (1 - width) * centre + depth * opening.depth_m * opening.inward;
    opening.rest.middleRows(Index(r + 1) * n, n) = (width * edge).rowwise() + at.transpose();
    opening.rings.push_back({width, 1 - width, 0});
    opening.colours.insert(opening.colours.end(), std::size_t(n), colours[r + 1]);
  }
  opening.rest.row(3 * n) = (centre + opening.depth_m * opening.inward).transpose();
  opening.rings.push_back({0, 1, 0});
  opening.colours.push_back(colours[2]);
  opening.jaw = Eigen::VectorXd::Zero(n);
}

std::vector<Opening> openings_of(const TriMesh& skin, const FaceCorners& corners,
                                 const anatomy::Teeth* teeth) {
  constexpr double longest_m = 0.25;
  const std::vector<std::vector<int>> loops = boundary_loops(skin.triangles);
  std::vector<double> length_m;
  for (const auto& loop : loops) length_m.push_back(loop_length(loop, skin.points));
  const Points normals = vertex_normals(skin);
  const auto border = std::max_element(length_m.begin(), length_m.end()) - length_m.begin();
  std::vector<Opening> openings;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (std::ptrdiff_t(i) == border || length_m[i] > longest_m || loops[i].size() < 3) continue;
    Vec3 outward = Vec3::Zero();
    for (const int v : loops[i]) outward += normals.row(v).transpose();
    outward /= double(loops[i].size());
    if (!in_the_face(loops[i], skin.points, corners) &&
        !on_a_cheek(loops[i], outward, loops[std::size_t(border)], skin.points, corners))
      continue;
    // The edge of a lip is rolled in; the face's own direction keeps the pocket behind it.
    openings.push_back({loops[i], -(corners.forward + 0.5 * outward).normalized(),
                        std::min(0.03, 0.25 * length_m[i])});
    Opening& opening = openings.back();
    opening.mouth = is_mouth(loops[i], skin.points, corners);
    opening.eye = !opening.mouth && is_eye(loops[i], skin.points, corners);
    // About the depth of a row of teeth.
    if (opening.mouth) opening.depth_m = 0.5 * length_m[i];
    const auto room = [&](double low_m, double high_m) {
      return room_behind(opening, low_m, high_m, loops[std::size_t(border)], skin.points, corners);
    };
    if (opening.mouth) {
      line_mouth(opening, skin, corners, teeth,
                 [&](double height) { return room(height, height); });
    } else {
      const double half_m = 1.35 * half_height(opening, skin.points, corners);
      opening.depth_m = std::min(opening.depth_m, room(-half_m, half_m));
      hang_pocket(opening, skin.points, opening.eye ? kLidColours : kPocketColours);
    }
  }
  return openings;
}

}  // namespace

FaceBacking face_backing(const TriMesh& skin, const io::Landmarks& landmarks,
                         const anatomy::Teeth* teeth) {
  FaceBacking backing;
  const auto corners = anatomy::face_corners(landmarks);
  if (!corners) return backing;
  backing.forward = corners->forward;
  backing.openings = openings_of(skin, *corners, teeth);
  backing.eyeballs = anatomy::eyeballs_behind(skin.points, *corners);
  return backing;
}

io::Landmarks landmarks_at_rest(const simulate::Performance& performance) {
  io::Landmarks landmarks;
  const motion::Motion& tracks = performance.landmarks;
  if (!tracks.positions.empty())
    for (std::size_t i = 0; i < tracks.names.size(); ++i)
      landmarks[tracks.names[i]] = tracks.positions.front().row(Index(i)).transpose();
  return landmarks;
}

FaceBacking face_backing(const simulate::Performance& performance, const anatomy::Teeth* teeth) {
  return face_backing(performance.skin_rest, landmarks_at_rest(performance), teeth);
}

std::array<bool, 2> open_eyes(const FaceBacking& backing, const Points& skin,
                              const io::Landmarks& landmarks) {
  std::array<bool, 2> open{};
  const auto corners = anatomy::face_corners(landmarks);
  for (std::size_t side = 0; corners && side < 2; ++side)
    open[side] = std::ranges::any_of(backing.openings, [&](const Opening& opening) {
      return is_at_eye(opening.loop, skin, *corners, side);
    });
  return open;
}

Eigen::VectorXd light_in_mouth(const TriMesh& part, const TriMesh& row, const Vec3& forward) {
  constexpr double dark_m = 0.035, least = 0.35;
  if (part.points.rows() == 0 || row.points.rows() == 0)
    return Eigen::VectorXd::Ones(part.points.rows());
  const double front = (row.points * forward).maxCoeff();
  const Eigen::ArrayXd behind = (front - (part.points * forward).array()) / dark_m;
  return 1 - (1 - least) * behind.max(0).min(1);
}

double light_between_lips(const std::vector<int>& loop, const Points& points) {
  constexpr double least = 0.15, falls_m = 1.5e-3;
  const Vec3 first = points.row(loop.front());
  Vec3 area = Vec3::Zero();
  double length_m = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3 from = points.row(loop[i]), to = points.row(loop[(i + 1) % loop.size()]);
    area += (from - first).cross(to - first) / 2;
    length_m += (to - from).norm();
  }
  return 1 - (1 - least) * std::exp(-2 * area.norm() / (length_m * falls_m));
}

TriMesh pocket(const Opening& opening, const Points& points, const Eigen::Affine3d& jaw) {
  const auto n = Index(opening.loop.size()), rings = Index(opening.rings.size());  // with the edge
  const Points moved = points(opening.loop, Eigen::all) - opening.rest.topRows(n);
  const Eigen::RowVector3d centre = moved.colwise().mean();
  TriMesh mesh;
  mesh.points = opening.rest;
  mesh.points.topRows(n) += moved;
  for (Index v = n; v < mesh.points.rows(); ++v) {
    const bool point = v == rings * n;
    const PocketRing& ring = opening.rings[std::size_t(v / n - 1)];
    const Vec3 rest = opening.rest.row(v);
    const double share = ring.jaw * (point ? 0.5 : opening.jaw[v % n]);
    mesh.points.row(v) += ring.edge * moved.row(v % n) + ring.centre * centre +
                          share * (jaw * rest - rest).transpose();
  }
  mesh.triangles.resize((2 * rings - 1) * n, 3);
  Index row = 0;
  const int m = int(n), last = m * int(rings - 1);
  for (int a = 0; a < m; ++a) {
    const int b = (a + 1) % m;
    for (int r = 0; r < last; r += m) {
      mesh.triangles.row(row++) << r + b, r + a, r + m + a;
      mesh.triangles.row(row++) << r + b, r + m + a, r + m + b;
    }
    mesh.triangles.row(row++) << last + b, last + a, last + m;
  }
  return mesh;
}

}  // namespace hyperex::report
