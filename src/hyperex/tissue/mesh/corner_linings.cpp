// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/mesh/corner_linings.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hyperex/anatomy/lips.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/clean_mesh.hpp"
#include "hyperex/geometry/geodesic.hpp"
#include "hyperex/geometry/sight.hpp"

namespace hyperex::tissue {
namespace {

constexpr double kNear_m = 0.012;     // the inner corners
constexpr double kWalk_m = 0.012;     // from the border of the mouth
constexpr double kRayReach_m = 0.03;  // of rays
constexpr double kHiddenShare = 0.9;  // of the directions

/// Unit, one per row.
Points forward_directions(const face::FaceFrame& frame) {
  Points directions(15, 3);
  Eigen::Index row = 0;
  for (const double up : {-0.6, -0.3, 0.0, 0.3, 0.6})
    for (const double left : {-0.5, 0.0, 0.5})
      directions.row(row++) = (frame.z + up * frame.y + left * frame.x).normalized().transpose();
  return directions;
}

}  // namespace

int remove_corner_linings(TriMesh& mesh, const io::Landmarks& landmarks) {
  const std::vector<int> border = anatomy::mouth_border(mesh, landmarks);
  if (border.empty()) return 0;
  const std::vector<double> walk = EdgePaths(mesh).distances(border, kWalk_m);
  const Vec3 corner[2] = {landmarks.at(face::ibug(60)), landmarks.at(face::ibug(64))};
  std::vector<int> near;
  for (std::size_t v = 0; v < walk.size(); ++v) {
    const Vec3 at = mesh.points.row(Eigen::Index(v));
    if (std::isfinite(walk[v]) &&
        std::min((at - corner[0]).norm(), (at - corner[1]).norm()) < kNear_m)
      near.push_back(int(v));
  }
  const std::vector<double> blocked =
      blocked_shares(mesh, near, forward_directions(face::face_frame(landmarks)), kRayReach_m);
  std::vector<char> hidden(walk.size(), 0);
  for (std::size_t i = 0; i < near.size(); ++i)
    hidden[std::size_t(near[i])] = blocked[i] > kHiddenShare;
  std::vector<char> drop(std::size_t(mesh.triangles.rows()), 0);
  int dropped = 0;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    int corners = 0;
    for (int k = 0; k < 3; ++k) corners += hidden[std::size_t(mesh.triangles(f, k))];
    if (corners < 2) continue;
    drop[std::size_t(f)] = 1;
    ++dropped;
  }
  if (dropped > 0) mesh = without_triangles(mesh, drop);
  return dropped;
}

}  // namespace hyperex::tissue
