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

constexpr double greatest_shift_m = 0.010;
/// Difference of the walks to both lips at which a place counts as wholly above or below the mouth.
constexpr double full_margin_m = 0.010;

std::vector<int> patch_nodes(const std::vector<DrivenPoint>& points, std::size_t i,
                             const tissue::TissueMesh& mesh, double radius) {
  const int lip = tissue::lip_of(points[i].name);
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
    if (d < radius) hit.push_back(v);
  }
  if (hit.empty() && nearest >= 0) hit.push_back(nearest);
  return hit;
}

}  // namespace

DriveField::DriveField(std::vector<DrivenPoint> points, const std::vector<Vec3>& still,
                       const tissue::TissueMesh& mesh, const Vec3& up, double mouth_shift_m)
    : points_(std::move(points)), shift_(mouth_shift_m * up) {
  const Points& skin = mesh.volume.outer.points;
  // The margin of the nearest node, of a lip's point on that lip.
  const auto margin_at = [&](const Vec3& p, int lip) {
    double least = 1, margin = 0;
    for (int v = 0; v < skin.rows(); ++v) {
      if (lip != 0 && (mesh.upper_margin[v] > 0) != (lip > 0)) continue;
      if (const double d = (skin.row(v).transpose() - p).norm(); d < least) {
        least = d;
        margin = mesh.upper_margin[v];
      }
    }
    return margin;
  };
  centres_.resize(points_.size() + still.size(), 3);
  Eigen::Index row = 0;
  for (const DrivenPoint& p : points_)
    centres_.row(row++) = opened(p.rest, margin_at(p.rest, tissue::lip_of(p.name))).transpose();
  for (const Vec3& p : still) centres_.row(row++) = opened(p, margin_at(p, 0)).transpose();
}

Vec3 DriveField::opened(const Vec3& p, double margin) const {
  return p + std::clamp(margin / full_margin_m, -1.0, 1.0) * shift_;
}

double DriveField::openness() const {
  return std::min(1.0, shift_.norm() / greatest_shift_m);
}

Eigen::MatrixXd DriveField::weights(const Points& places, const std::vector<double>& margin) const {
  Points at(places.rows(), 3);
  for (Eigen::Index j = 0; j < at.rows(); ++j)
    at.row(j) = opened(places.row(j), margin[j]).transpose();
  Eigen::MatrixXd all(places.rows(), points_.size());
  // Three points at a time: one unit displacement an axis.
  for (std::size_t first = 0; first < points_.size(); first += 3) {
    const std::size_t count = std::min<std::size_t>(3, points_.size() - first);
    Points unit = Points::Zero(centres_.rows(), 3);
    for (std::size_t k = 0; k < count; ++k) unit(first + k, k) = 1;
    all.middleCols(first, count) = Rbf(centres_, unit).at_all(at).leftCols(count);
  }
  return all;
}

double lip_parting(const AlignedMotion& motion, const std::vector<int>& driven_rows,
                   const Vec3& up) {
  double most = 0;
  for (const Points& at : motion.motion.positions) {
    double height[2] = {0, 0};  // lower, upper
    int count[2] = {0, 0};
    for (int row : driven_rows)
      if (const int lip = tissue::lip_of(motion.motion.names[row]); lip != 0) {
        height[lip > 0] += up.dot(at.row(row) - motion.rest.row(row));
        ++count[lip > 0];
      }
    if (count[0] == 0 || count[1] == 0) return 0;
    most = std::max(most, height[1] / count[1] - height[0] / count[0]);
  }
  return std::min(greatest_shift_m, most / 2);
}

std::vector<Vec3> still_places(const std::vector<DrivenPoint>& points,
                               const io::Landmarks& landmarks) {
  std::vector<Vec3> still;
  for (int k = 0; k < 48; ++k) {
    if (k > 3 && k < 13) continue;
    const std::string name = tissue::ibug(k);
    const bool drives = std::any_of(points.begin(), points.end(),
                                    [&](const DrivenPoint& p) { return p.name == name; });
    if (!drives && landmarks.count(name)) still.push_back(landmarks.at(name));
  }
  return still;
}

DrivenPatches driven_patches(const DriveField& field, const tissue::TissueMesh& mesh,
                             double patch_radius_m, const std::string& source) {
  const std::vector<DrivenPoint>& points = field.points();
  const SurfaceTree skin(mesh.skin);
  constexpr double off_skin_m = 0.025;
  for (const DrivenPoint& p : points)
    if (const double d = std::sqrt(skin.query(p.rest).squared_distance); d > off_skin_m)
      throw InputError(source,
                       fmt::format("driven point {} lies {:.0f} mm off the skin after alignment; "
                                   "expected at most {:.0f} mm",
                                   p.name, d * 1e3, off_skin_m * 1e3));
  const double radius = patch_radius_m * (1.5 - 0.5 * field.openness());
  std::set<int> nodes;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int v : patch_nodes(points, i, mesh, radius)) nodes.insert(v);
  DrivenPatches patches;
  patches.nodes.assign(nodes.begin(), nodes.end());
  Points places(patches.nodes.size(), 3);
  std::vector<double> margin;
  for (std::size_t j = 0; j < patches.nodes.size(); ++j) {
    places.row(j) = mesh.volume.outer.points.row(patches.nodes[j]);
    margin.push_back(mesh.upper_margin[patches.nodes[j]]);
  }
  patches.weights = field.weights(places, margin);
  return patches;
}

}  // namespace hyperex::reenact
