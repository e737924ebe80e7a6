// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/roughness.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/metrics/regions.hpp"

namespace hyperex::metrics {
namespace {

constexpr double kNearPoint_m = 0.012;
/// The least number of neighbours for the fit.
constexpr std::size_t kFewest = 8;

/// The vertices within the reach of a vertex along edges. Kept between calls to avoid allocation.
class Around {
 public:
  Around(const Points& points, const std::vector<std::vector<int>>& neighbours)
      : points_(points), neighbours_(neighbours), seen_(neighbours.size(), -1) {}

  const std::vector<int>& of(int v) {
    found_.assign(1, v);
    seen_[std::size_t(v)] = v;
    for (std::size_t i = 0; i < found_.size(); ++i)
      for (const int w : neighbours_[std::size_t(found_[i])]) {
        if (seen_[std::size_t(w)] == v ||
            (points_.row(w) - points_.row(v)).squaredNorm() > kRoughnessReach_m * kRoughnessReach_m)
          continue;
        seen_[std::size_t(w)] = v;
        found_.push_back(w);
      }
    return found_;
  }

 private:
  const Points& points_;
  const std::vector<std::vector<int>>& neighbours_;
  std::vector<int> seen_, found_;
};

}  // namespace

Roughness roughness(const TriMesh& skin, const PointsF& displacement) {
  const auto count = std::size_t(skin.points.rows());
  const auto neighbours = vertex_neighbours(skin.triangles, skin.points.rows());
  const Points normals = vertex_normals(skin);
  std::vector<char> border(count, 0);
  for (const auto& loop : boundary_loops(skin.triangles))
    for (const int v : loop) border[std::size_t(v)] = 1;
  std::vector<double> rough_m(count, -1);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 512), [&](const auto& range) {
    Around around(skin.points, neighbours);
    for (std::size_t v = range.begin(); v < range.end(); ++v) {
      const std::vector<int>& all = around.of(int(v));
      if (all.size() <= kFewest) continue;
      if (std::any_of(all.begin(), all.end(), [&](int w) { return border[std::size_t(w)]; }))
        continue;
      const Vec3 normal = normals.row(Eigen::Index(v)).transpose();
      const Vec3 along = normal.unitOrthogonal(), across = normal.cross(along);
      Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
      Vec3 b = Vec3::Zero();
      for (const int w : all) {
        const Vec3 way = (skin.points.row(w) - skin.points.row(Eigen::Index(v))).transpose();
        const Vec3 row(1, way.dot(along) / kRoughnessReach_m, way.dot(across) / kRoughnessReach_m);
        a += row * row.transpose();
        b += row * normal.dot(displacement.row(w).cast<double>().transpose());
      }
      const double smooth = a.ldlt().solve(b)[0];
      const double own = normal.dot(displacement.row(Eigen::Index(v)).cast<double>().transpose());
      if (std::isfinite(smooth)) rough_m[v] = std::abs(own - smooth);
    }
  });
  Roughness out;
  out.vertex_mm = Eigen::VectorXd::Constant(Eigen::Index(count), std::nan(""));
  std::vector<double> judged;
  double squares = 0;
  for (std::size_t v = 0; v < count; ++v) {
    if (rough_m[v] < 0) continue;
    judged.push_back(rough_m[v]);
    out.vertex_mm[Eigen::Index(v)] = 1e3 * rough_m[v];
    squares += rough_m[v] * rough_m[v];
    if (out.roughest < 0 || rough_m[v] > rough_m[std::size_t(out.roughest)]) out.roughest = int(v);
  }
  out.judged = Eigen::Index(judged.size());
  if (judged.empty()) return out;
  out.greatest_mm = 1e3 * rough_m[std::size_t(out.roughest)];
  out.rms_mm = 1e3 * std::sqrt(squares / double(judged.size()));
  const auto at = judged.begin() + std::ptrdiff_t(0.99 * double(judged.size() - 1));
  std::nth_element(judged.begin(), at, judged.end());
  out.p99_mm = 1e3 * *at;
  return out;
}

std::vector<PartRoughness> roughness_by_part(const Roughness& rough, const Points& rest,
                                             const io::Landmarks& landmarks) {
  std::vector<PartRoughness> parts;
  const auto add = [&](const char* part, const std::vector<int>& vertices) {
    double squares = 0;
    int count = 0;
    for (const int v : vertices)
      if (const double value = rough.vertex_mm[v]; !std::isnan(value))
        squares += value * value, ++count;
    if (count > 0) parts.push_back({part, std::sqrt(squares / count)});
  };
  const auto near = [&](const std::vector<int>& points) {
    std::vector<int> vertices;
    for (Eigen::Index v = 0; v < rest.rows(); ++v)
      if (std::any_of(points.begin(), points.end(), [&](int k) {
            const auto at = landmarks.find(face::ibug(k));
            return at != landmarks.end() &&
                   (rest.row(v).transpose() - at->second).norm() < kNearPoint_m;
          }))
        vertices.push_back(int(v));
    return vertices;
  };
  const Regions regions = regions_of(rest, landmarks);
  add("brows", near({17, 18, 19, 20, 21, 22, 23, 24, 25, 26}));
  if (const Region* forehead = regions.find("forehead")) add("forehead", forehead->vertices);
  add("corners", near({48, 54}));
  if (const Region* chin = regions.find("chin")) add("chin", chin->vertices);
  return parts;
}

}  // namespace hyperex::metrics
