// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/midsagittal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "hyperex/core/error.hpp"
#include "hyperex/core/quantile.hpp"
#include "hyperex/face/canonical_face.hpp"
#include "hyperex/face/optional_landmarks.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/metrics/regions.hpp"

namespace hyperex::metrics {
namespace {

constexpr double reach_m = 0.010;
constexpr double least_cosine = 0.5;  // between normals: 60 degrees
constexpr int most_points = 5000;     // number of surface points used for matching
constexpr int most_rounds = 60;
constexpr int most_idle_rounds = 4;
constexpr double most_turn_deg = 15, most_shift_m = 0.015;

/// A landmark and where its reflection should lie.
struct Ordered {
  Vec3 a, b;
};

struct Pairing {
  std::vector<Ordered> pairs;
  Vec3 to_left = Vec3::Zero();  // sum of left minus right
  int both_sides = 0;
};

Pairing pairing(const io::Landmarks& landmarks) {
  const auto& canonical = face::canonical_face();
  Pairing found;
  for (const auto& [name, p] : landmarks) {
    // Folds are not alike on both sides, least of all where a face is ill.
    if (face::is_optional_landmark(name)) continue;
    const std::string other = face::mirrored_landmark(name);
    if (other == name) {
      if (canonical.landmarks.contains(name)) found.pairs.push_back({p, p});
      continue;
    }
    const auto mirror = landmarks.find(other);
    if (mirror == landmarks.end()) continue;
    found.pairs.push_back({p, mirror->second});
    bool left = name.ends_with("_L");
    if (canonical.landmarks.contains(name))
      left = canonical.landmark(name, canonical.mesh.points).x() > 0;
    if (!left) continue;
    found.to_left += p - mirror->second;
    ++found.both_sides;
  }
  return found;
}

void solve(const Pairing& all, const std::vector<double>& weight, MidsagittalPlane& plane) {
  Vec3 middle = Vec3::Zero();
  double sum = 0;
  for (size_t i = 0; i < all.pairs.size(); ++i) {
    middle += weight[i] * 0.5 * (all.pairs[i].a + all.pairs[i].b);
    sum += weight[i];
  }
  middle /= sum;
  Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
  for (size_t i = 0; i < all.pairs.size(); ++i) {
    const Vec3 a = all.pairs[i].a - middle, b = all.pairs[i].b - middle;
    m += weight[i] * 0.5 * (a * b.transpose() + b * a.transpose());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(m);
  plane.normal = eigen.eigenvectors().col(0).normalized();
  if (plane.normal.dot(all.to_left) < 0) plane.normal *= -1;
  plane.offset_m = plane.normal.dot(middle);
}

/// The surface that is matched with its mirror image.
struct Surface {
  const TriMesh& mesh;
  SurfaceTree tree;
  Points vertex_normal;
  std::vector<char> on_border;
  std::vector<int> sample;  // vertices

  Surface(const TriMesh& rest, const io::Landmarks& landmarks)
      : mesh(rest),
        tree(rest),
        vertex_normal(vertex_normals(rest)),
        on_border(static_cast<size_t>(rest.points.rows()), 0) {
    for (const auto& loop : boundary_loops(rest.triangles))
      for (const int v : loop) on_border[static_cast<size_t>(v)] = 1;
    const Regions regions = regions_of(rest.points, landmarks);
    std::vector<int> all(static_cast<size_t>(rest.points.rows()));
    std::iota(all.begin(), all.end(), 0);
    if (const Region* face = regions.find("face")) all = face->vertices;
    const size_t stride = 1 + all.size() / most_points;
    for (size_t i = 0; i < all.size(); i += stride) sample.push_back(all[i]);
  }

  Vec3 corner(int triangle, int k) const { return mesh.points.row(mesh.triangles(triangle, k)); }
  Vec3 normal(int triangle) const {
    const Vec3 a = corner(triangle, 0);
    return (corner(triangle, 1) - a).cross(corner(triangle, 2) - a).normalized();
  }
  bool border_foot(const ClosestPoint& foot) const {
    bool all = true;
    for (int k = 0; k < 3; ++k)
      if (foot.weights[k] > 1e-9)
        all &= on_border[static_cast<size_t>(mesh.triangles(foot.triangle, k))] != 0;
    return all && foot.weights.minCoeff() <= 1e-9;
  }
};

/// A vertex (relative to the middle of the face), the closest point to its mirror image, and the
/// normal there.
struct Contact {
  Vec3 p, foot, normal;
};

/// `feet`: closest points of the previous round, or empty; replaced by those of this round.
std::vector<Contact> contacts(const Surface& surface, const MidsagittalPlane& plane,
                              const Vec3& middle, std::vector<ClosestPoint>& feet) {
  Points reflected(static_cast<Eigen::Index>(surface.sample.size()), 3);
  for (Eigen::Index i = 0; i < reflected.rows(); ++i)
    reflected.row(i) =
        plane.reflect(surface.mesh.points.row(surface.sample[static_cast<size_t>(i)])).transpose();
  feet = surface.tree.query_all(reflected, feet);
  std::vector<Contact> list;
  for (size_t i = 0; i < feet.size(); ++i) {
    const ClosestPoint& foot = feet[i];
    if (foot.squared_distance > reach_m * reach_m || surface.border_foot(foot)) continue;
    const Vec3 normal = surface.normal(foot.triangle);
    const Vec3 own = surface.vertex_normal.row(surface.sample[i]);
    if (!(plane.reflect_vector(own).dot(normal) > least_cosine)) continue;
    const Vec3 p = surface.mesh.points.row(surface.sample[i]);
    list.push_back({p - middle, foot.point - middle, normal});
  }
  return list;
}

/// One Gauss-Newton step on the weighted residuals normal . (reflected - foot). Returns the length
/// of the step (radian, and metre over 0.1 m). `delta`: the offset relative to the middle.
double step(const std::vector<Contact>& list, Vec3& n, double& delta, double& rms) {
  std::vector<double> residual, size;
  for (const Contact& c : list) {
    const Vec3 q = c.p - 2 * (n.dot(c.p) - delta) * n;
    residual.push_back(c.normal.dot(q - c.foot));
    size.push_back(std::abs(residual.back()));
  }
  const double cut = 4.685 * std::max(1.4826 * median(size), 1e-7);
  const Vec3 b1 = n.unitOrthogonal(), b2 = n.cross(b1);
  Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
  Vec3 g = Vec3::Zero();
  double squares = 0, sum = 0;
  for (size_t i = 0; i < list.size(); ++i) {
    const Contact& c = list[i];
    const double part = residual[i] / cut;
    if (std::abs(part) >= 1) continue;
    const double w = std::pow(1 - part * part, 2);
    const double away = n.dot(c.p) - delta, nn = c.normal.dot(n);
    const Vec3 d(-2 * (b1.dot(c.p) * nn + away * c.normal.dot(b1)),
                 -2 * (b2.dot(c.p) * nn + away * c.normal.dot(b2)), 2 * nn);
    h += w * d * d.transpose();
    g += w * residual[i] * d;
    squares += w * residual[i] * residual[i];
    sum += w;
  }
  rms = std::sqrt(squares / sum);
  h.diagonal().array() += 1e-12 * h.trace();
  const Vec3 x = h.ldlt().solve(-g);
  n = (n + x[0] * b1 + x[1] * b2).normalized();
  delta += x[2];
  return std::max(x.head<2>().norm(), std::abs(x[2]) / 0.1);
}

}  // namespace

MidsagittalPlane landmark_plane(const io::Landmarks& landmarks) {
  const Pairing all = pairing(landmarks);
  if (all.both_sides < 2)
    throw InputError(InputProblem{"landmarks", 0, "", fmt::format("{} pairs", all.both_sides),
                                  "two or more landmarks with their counterparts on the other "
                                  "side, for the midsagittal plane"});
  MidsagittalPlane plane;
  std::vector<double> weight(all.pairs.size(), 1), residual(all.pairs.size());
  for (int round = 0; round < 10; ++round) {
    solve(all, weight, plane);
    for (size_t i = 0; i < all.pairs.size(); ++i)
      residual[i] = (plane.reflect(all.pairs[i].a) - all.pairs[i].b).norm();
    const double scale = std::max(median(residual), 1e-6);
    double squares = 0, sum = 0;
    for (size_t i = 0; i < weight.size(); ++i) {
      weight[i] = 1 / (1 + std::pow(residual[i] / scale, 2));
      squares += weight[i] * residual[i] * residual[i];
      sum += weight[i];
    }
    plane.landmark_rms_m = std::sqrt(squares / sum);
  }
  plane.surface_rms_m = std::numeric_limits<double>::quiet_NaN();
  return plane;
}

MidsagittalPlane midsagittal_plane(const TriMesh& rest, const io::Landmarks& landmarks) {
  const MidsagittalPlane start = landmark_plane(landmarks);
  const Surface surface(rest, landmarks);
  Vec3 middle = Vec3::Zero();
  for (const int v : surface.sample) middle += rest.points.row(v).transpose();
  middle /= static_cast<double>(surface.sample.size());
  MidsagittalPlane plane = start;
  double delta = start.offset_m - start.normal.dot(middle);
  const double first_delta = delta;
  std::vector<ClosestPoint> feet;
  // On a scan, the steps finally fluctuate by some micrometres, because closest points change
  // between triangles. The iteration therefore also ends when the steps no longer decrease.
  double least = std::numeric_limits<double>::infinity();
  int idle_rounds = 0;
  for (plane.rounds = 0; plane.rounds < most_rounds;) {
    const auto list = contacts(surface, plane, middle, feet);
    if (list.size() < 100) {
      plane = start;
      plane.note = "too little of the reflected face lies near the face to refine its plane";
      return plane;
    }
    const double moved = step(list, plane.normal, delta, plane.surface_rms_m);
    plane.offset_m = delta + plane.normal.dot(middle);
    ++plane.rounds;
    idle_rounds = moved < 0.9 * least ? 0 : idle_rounds + 1;
    least = std::min(least, moved);
    if (moved < 1e-8 || idle_rounds == most_idle_rounds) break;
  }
  plane.turned_deg = std::acos(std::clamp(plane.normal.dot(start.normal), -1.0, 1.0)) * 180 / M_PI;
  plane.shifted_m = delta - first_delta;
  if (!(plane.turned_deg < most_turn_deg) || !(std::abs(plane.shifted_m) < most_shift_m)) {
    const std::string note = fmt::format(
        "the surface would turn the landmarks' midsagittal plane by {:.1f} degrees and shift it by "
        "{:.1f} mm; the landmarks' plane is kept",
        plane.turned_deg, 1e3 * plane.shifted_m);
    plane = start;
    plane.note = note;
  }
  return plane;
}

}  // namespace hyperex::metrics
