// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/asymmetry.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/sided_triangles.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/metrics/regions.hpp"
#include "hyperex/metrics/surface_distance.hpp"

namespace hyperex::metrics {
namespace {

std::vector<int> with_counterpart(const Region* region, const Counterparts& pairs) {
  std::vector<int> kept;
  if (region)
    for (const int v : region->vertices)
      if (pairs.found[static_cast<size_t>(v)]) kept.push_back(v);
  return kept;
}

}  // namespace

Counterparts counterparts(const TriMesh& rest, const MidsagittalPlane& plane,
                          const std::vector<int>& side, double reach_m) {
  // A closest point within this distance coincides with the mirror image, even on the border.
  constexpr double upon_m = 1e-6;
  std::vector<char> on_border(static_cast<size_t>(rest.points.rows()), 0);
  for (const auto& loop : boundary_loops(rest.triangles))
    for (const int v : loop) on_border[static_cast<size_t>(v)] = 1;
  const SurfaceTree tree(rest);
  const SidedTriangles sided(rest, side);
  const auto count = static_cast<size_t>(rest.points.rows());
  Counterparts pairs{std::vector<std::array<int, 3>>(count), std::vector<Vec3>(count),
                     Eigen::VectorXd(rest.points.rows()), std::vector<char>(count, 0)};
  const auto part_of = [&](size_t i) -> const std::vector<char>* {
    return &sided.open_to(side.empty() ? 0 : side[i]);
  };
  const auto pair = [&](size_t i, const ClosestPoint& foot) {
    const auto row = static_cast<Eigen::Index>(i);
    const int f = foot.triangle;
    bool border = foot.weights.minCoeff() <= 1e-9;
    for (int k = 0; k < 3; ++k) {
      pairs.vertices[i][static_cast<size_t>(k)] = rest.triangles(f, k);
      if (foot.weights[k] > 1e-9)
        border &= on_border[static_cast<size_t>(rest.triangles(f, k))] != 0;
    }
    pairs.weights[i] = foot.weights;
    pairs.distance_m[row] = std::sqrt(foot.squared_distance);
    pairs.found[i] = pairs.distance_m[row] <= (border ? upon_m : reach_m);
  };
  // Consecutive vertices are usually neighbours, so the search starts at the result for the
  // previous one.
  tbb::parallel_for(tbb::blocked_range<size_t>(0, count), [&](const auto& range) {
    const std::vector<char>* last = nullptr;
    ClosestPoint foot;
    for (size_t i = range.begin(); i < range.end(); ++i) {
      const std::vector<char>* part = part_of(i);
      const Vec3 reflected = plane.reflect(rest.points.row(static_cast<Eigen::Index>(i)));
      foot = part == last ? tree.query_among(*part, reflected, tree.reach(reflected, foot.point))
                          : tree.query_among(*part, reflected);
      last = part;
      pair(i, foot);
    }
  });
  return pairs;
}

Eigen::VectorXf asymmetry_mm(const MidsagittalPlane& plane, const Counterparts& pairs,
                             const PointsF& displacement) {
  return asymmetry_mm(plane, pairs, displacement, displacement);
}

Eigen::VectorXf asymmetry_mm(const MidsagittalPlane& plane, const Counterparts& pairs,
                             const PointsF& displacement, const PointsF& across) {
  Eigen::VectorXf out(displacement.rows());
  for (Eigen::Index i = 0; i < out.size(); ++i) {
    const auto at = static_cast<size_t>(i);
    if (!pairs.found[at]) {
      out[i] = std::numeric_limits<float>::quiet_NaN();
      continue;
    }
    Vec3 other = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
      other += pairs.weights[at][k] *
               across.row(pairs.vertices[at][static_cast<size_t>(k)]).cast<double>();
    const Vec3 own = displacement.row(i).cast<double>();
    out[i] = static_cast<float>(1e3 * (own - plane.reflect_vector(other)).norm());
  }
  return out;
}

RestAsymmetry rest_asymmetry(const TriMesh& rest, const io::Landmarks& landmarks,
                             const std::vector<int>& side) {
  RestAsymmetry out;
  out.plane = midsagittal_plane(rest, landmarks);
  out.pairs = counterparts(rest, out.plane, side);
  const Regions regions = regions_of(rest.points, landmarks);
  out.face = with_counterpart(regions.find("face"), out.pairs);
  out.mouth = with_counterpart(regions.find("lips"), out.pairs);
  if (const Region* face = regions.find("face"))
    out.paired_share =
        static_cast<double>(out.face.size()) / static_cast<double>(face->vertices.size());
  const DistanceStatistics at_rest = statistics_of(out.pairs.distance_m, out.face);
  out.rest_rms_mm = at_rest.rms_mm;
  out.rest_p95_mm = at_rest.p95_mm;
  return out;
}

Asymmetry asymmetry_of(const RestAsymmetry& rest, const std::vector<PointsF>& frames,
                       const std::vector<PointsF>& twin) {
  Asymmetry out{rest, {}, 0, {}};
  out.frames.resize(frames.size());
  const auto summary = [&](const PointsF& own, const PointsF& across) -> AsymmetrySummary {
    const Eigen::VectorXd map_m =
        1e-3 * asymmetry_mm(out.plane, out.pairs, own, across).cast<double>();
    const DistanceStatistics face = statistics_of(map_m, out.face);
    const DistanceStatistics mouth = statistics_of(map_m, out.mouth);
    return {face.rms_mm, face.p95_mm, mouth.rms_mm, mouth.p95_mm};
  };
  tbb::parallel_for(size_t{0}, frames.size(),
                    [&](size_t f) { out.frames[f] = summary(frames[f], frames[f]); });
  for (size_t f = 0; f < frames.size(); ++f)
    if (out.frames[f].face_rms_mm > out.frames[static_cast<size_t>(out.worst_frame)].face_rms_mm)
      out.worst_frame = static_cast<int>(f);
  const auto worst = static_cast<size_t>(out.worst_frame);
  if (worst < twin.size()) out.mesh_floor = summary(frames[worst], twin[worst]);
  return out;
}

}  // namespace hyperex::metrics
