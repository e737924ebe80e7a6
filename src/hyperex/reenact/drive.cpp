// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/reenact/drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "hyperex/core/error.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/rbf.hpp"
#include "hyperex/tissue/face_frame.hpp"
#include "hyperex/tissue/lips.hpp"

namespace hyperex::reenact {
namespace {

/// -1 or 1 for points that only move the lower or the upper side of the mouth; the chin's count
/// with the lower one.
int side_of_point(const std::string& name) {
  for (int k = 4; k <= 12; ++k)
    if (name == tissue::ibug(k)) return -1;
  return tissue::lip_of(name);
}

std::vector<int> patch_nodes(const std::vector<DrivenPoint>& points, std::size_t i,
                             const tissue::TissueMesh& mesh, double radius) {
  const int lip = tissue::lip_of(points[i].name);
  double next = 1;
  for (std::size_t j = 0; j < points.size(); ++j)
    if (j != i && tissue::lip_of(points[j].name) * lip >= 0)
      next = std::min(next, (points[j].rest - points[i].rest).norm());
  const double reach = std::min(radius, next);
  const Points& skin = mesh.volume.outer.points;
  std::vector<int> hit;
  int nearest = -1;
  double least = 1;
  for (int v = 0; v < skin.rows(); ++v) {
    if (lip != 0 && (mesh.upper_margin[v] > 0) != (lip > 0)) continue;
    const double d = (skin.row(v).transpose() - points[i].rest).norm();
    if (d < least) {
      least = d;
      nearest = v;
    }
    if (d < reach) hit.push_back(v);
  }
  if (hit.empty() && nearest >= 0) hit.push_back(nearest);
  return hit;
}

/// Row j: how the displacement at node j follows from those of the points of its side.
void fill_weights(DrivenPatches& patches, const std::vector<DrivenPoint>& points,
                  const tissue::TissueMesh& mesh, int side) {
  std::vector<int> members, rows;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (side_of_point(points[i].name) * side >= 0) members.push_back(static_cast<int>(i));
  for (std::size_t j = 0; j < patches.nodes.size(); ++j)
    if ((mesh.upper_margin[patches.nodes[j]] > 0) == (side > 0))
      rows.push_back(static_cast<int>(j));
  if (members.empty() || rows.empty()) return;
  Points centres(members.size(), 3), at(rows.size(), 3);
  for (std::size_t i = 0; i < members.size(); ++i)
    centres.row(i) = points[members[i]].rest.transpose();
  for (std::size_t j = 0; j < rows.size(); ++j)
    at.row(j) = mesh.volume.outer.points.row(patches.nodes[rows[j]]);
  // Three points at a time: one unit displacement an axis.
  for (std::size_t first = 0; first < members.size(); first += 3) {
    Points unit = Points::Zero(members.size(), 3);
    for (std::size_t k = 0; k < 3 && first + k < members.size(); ++k) unit(first + k, k) = 1;
    const Points value = Rbf(centres, unit).at_all(at);
    for (std::size_t k = 0; k < 3 && first + k < members.size(); ++k)
      for (std::size_t j = 0; j < rows.size(); ++j)
        patches.weights(rows[j], members[first + k]) = value(j, k);
  }
}

}  // namespace

DrivenPatches driven_patches(const std::vector<DrivenPoint>& points, const tissue::TissueMesh& mesh,
                             double patch_radius_m, const std::string& source) {
  const SurfaceTree skin(mesh.skin);
  constexpr double off_skin_m = 0.025;
  for (const DrivenPoint& p : points)
    if (const double d = std::sqrt(skin.query(p.rest).squared_distance); d > off_skin_m)
      throw InputError(
          source,
          fmt::format("driven point {} lies {:.0f} mm off the skin after alignment; expected "
                      "at most {:.0f} mm",
                      p.name, d * 1e3, off_skin_m * 1e3));
  std::set<int> nodes;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int v : patch_nodes(points, i, mesh, patch_radius_m)) nodes.insert(v);
  DrivenPatches patches;
  patches.nodes.assign(nodes.begin(), nodes.end());
  patches.weights = Eigen::MatrixXd::Zero(patches.nodes.size(), points.size());
  fill_weights(patches, points, mesh, 1);
  fill_weights(patches, points, mesh, -1);
  return patches;
}

}  // namespace hyperex::reenact
