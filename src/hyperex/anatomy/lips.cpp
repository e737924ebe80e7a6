// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/lips.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/anatomy/lip_line.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/geodesic.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::anatomy {
namespace {

std::vector<int> vertices_near(const TriMesh& mesh, const io::Landmarks& landmarks,
                               std::initializer_list<int> numbers) {
  std::vector<int> vertices;
  for (int k : numbers)
    vertices.push_back(nearest_vertex(mesh.points, landmarks.at(face::ibug(k))));
  return vertices;
}

/// Right corner, the inner lip line, left corner: each inner point the mean of upper and lower.
std::vector<Vec3> lip_line(const io::Landmarks& landmarks) {
  const auto mean = [&](int a, int b) {
    return Vec3(0.5 * (landmarks.at(face::ibug(a)) + landmarks.at(face::ibug(b))));
  };
  return {landmarks.at(face::ibug(48)),
          landmarks.at(face::ibug(60)),
          mean(61, 67),
          mean(62, 66),
          mean(63, 65),
          landmarks.at(face::ibug(64)),
          landmarks.at(face::ibug(54))};
}

double distance_to_polyline(const Vec3& p, const std::vector<Vec3>& line) {
  double best = 1e300;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec3 e = line[i + 1] - line[i];
    const double t = std::clamp((p - line[i]).dot(e) / std::max(1e-18, e.squaredNorm()), 0.0, 1.0);
    best = std::min(best, (p - line[i] - t * e).norm());
  }
  return best;
}

Points as_rows(const std::vector<Vec3>& list) {
  Points rows(static_cast<Eigen::Index>(list.size()), 3);
  for (std::size_t i = 0; i < list.size(); ++i) rows.row(static_cast<Eigen::Index>(i)) = list[i];
  return rows;
}

std::vector<Vec3> as_list(const Points& rows) {
  return {rows.rowwise().begin(), rows.rowwise().end()};
}

constexpr double spacing_m = 0.0005;

/// Points every half millimetre along a polyline, its ends among them.
std::vector<Vec3> resampled(const std::vector<Vec3>& line) {
  double length = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) length += (line[i + 1] - line[i]).norm();
  const int count = std::max(2, static_cast<int>(std::ceil(length / spacing_m)));
  std::vector<Vec3> out{line.front()};
  double passed = 0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double step = (line[i + 1] - line[i]).norm();
    while (static_cast<int>(out.size()) < count &&
           double(out.size()) * length / count <= passed + step) {
      const double t = (double(out.size()) * length / count - passed) / std::max(step, 1e-12);
      out.push_back(line[i] + t * (line[i + 1] - line[i]));
    }
    passed += step;
  }
  out.push_back(line.back());
  return out;
}

/// Gaussian mean along the line; its ends stay, since beyond them it is continued turned round.
std::vector<Vec3> smoothed(const std::vector<Vec3>& line, double sigma_m) {
  const int n = static_cast<int>(line.size()),
            reach = std::min(n - 1, int(3 * sigma_m / spacing_m));
  std::vector<Vec3> out(line.size());
  for (int i = 0; i < n; ++i) {
    Vec3 sum = Vec3::Zero();
    double weights = 0;
    for (int d = -reach; d <= reach; ++d) {
      const int j = i + d;
      const Vec3 p = j < 0    ? Vec3(2 * line.front() - line[-j])
                     : j >= n ? Vec3(2 * line.back() - line[2 * (n - 1) - j])
                              : line[j];
      const double w = std::exp(-0.5 * std::pow(d * spacing_m / sigma_m, 2));
      sum += w * p;
      weights += w;
    }
    out[i] = sum / weights;
  }
  return out;
}

/// The two edges of an open mouth.
struct Rims {
  int right_corner = -1, left_corner = -1;
  std::vector<int> upper, lower;  // without the corners
};

std::optional<Rims> rims_of(const TriMesh& mesh, const io::Landmarks& landmarks) {
  const std::vector<int> loop = mouth_border(mesh, landmarks);
  if (loop.empty()) return {};
  const Vec3 left = landmarks.at(face::ibug(54)) - landmarks.at(face::ibug(48));
  const auto before = [&](int a, int b) {
    return (mesh.points.row(a) - mesh.points.row(b)).dot(left) < 0;
  };
  const auto [first, last] = std::minmax_element(loop.begin(), loop.end(), before);
  Rims rims{*first, *last, {}, {}};
  // A loop runs as its triangles do: from the right corner to the left these lie above it.
  std::vector<int>* side = &rims.upper;
  for (std::size_t i = 1; i < loop.size(); ++i) {
    const int v = loop[(std::size_t(first - loop.begin()) + i) % loop.size()];
    if (v == rims.left_corner)
      side = &rims.lower;
    else
      side->push_back(v);
  }
  return rims;
}

/// At the corners neither lip is nearer, and the rims belong to their lips.
void settle_at_rims(std::vector<double>& margin, const TriMesh& mesh, const Rims& rims) {
  const Vec3 corner = mesh.points.row(rims.right_corner);
  const Vec3 across = mesh.points.row(rims.left_corner).transpose() - corner;
  const double at_right = margin[rims.right_corner], at_left = margin[rims.left_corner];
  for (std::size_t v = 0; v < margin.size(); ++v) {
    const double t = (mesh.points.row(v).transpose() - corner).dot(across) / across.squaredNorm();
    if (margin[v] != 0) margin[v] -= at_right + std::clamp(t, 0.0, 1.0) * (at_left - at_right);
  }
  constexpr double sure = 0.005;
  for (int v : rims.upper) margin[v] = std::max(margin[v], sure);
  for (int v : rims.lower) margin[v] = std::min(margin[v], -sure);
}

}  // namespace

int lip_of(const std::string& landmark) {
  for (int k : {49, 50, 51, 52, 53, 61, 62, 63})
    if (landmark == face::ibug(k)) return 1;
  for (int k : {55, 56, 57, 58, 59, 65, 66, 67})
    if (landmark == face::ibug(k)) return -1;
  return 0;
}

std::vector<double> upper_lip_margin(const TriMesh& mesh, const io::Landmarks& landmarks) {
  const EdgePaths paths(mesh);
  const auto upper = paths.distances(vertices_near(mesh, landmarks, {50, 51, 52}));
  const auto lower = paths.distances(vertices_near(mesh, landmarks, {56, 57, 58}));
  std::vector<double> margin(upper.size());
  constexpr double far = 1;  // m
  for (std::size_t v = 0; v < margin.size(); ++v)
    margin[v] = std::min(lower[v], far) - std::min(upper[v], far);
  if (const auto rims = rims_of(mesh, landmarks)) settle_at_rims(margin, mesh, *rims);
  return margin;
}

std::vector<int> mouth_border(const TriMesh& mesh, const io::Landmarks& landmarks) {
  const std::vector<Vec3> line = lip_line(landmarks);
  const Vec3 corner_r = line.front(), across = line.back() - line.front();
  const double width = across.norm();
  for (auto& loop : boundary_loops(mesh.triangles)) {
    double least = 1e300, greatest = -1e300;
    for (int v : loop) {
      const Vec3 p = mesh.points.row(v);
      if (distance_to_polyline(p, line) > 0.25 * width) continue;
      const double along = (p - corner_r).dot(across) / (width * width);
      least = std::min(least, along);
      greatest = std::max(greatest, along);
    }
    if (greatest - least > 0.5) return loop;
  }
  return {};
}

bool mouth_is_open(const TriMesh& mesh, const io::Landmarks& landmarks) {
  return !mouth_border(mesh, landmarks).empty();
}

Points lip_line_of_landmarks(const io::Landmarks& landmarks) {
  return as_rows(smoothed(resampled(lip_line(landmarks)), 0.0025));
}

std::optional<Points> lip_line_of_crease(const TriMesh& mesh, const io::Landmarks& landmarks) {
  const face::FaceFrame frame = face::face_frame(landmarks);
  Eigen::Matrix3d scan_from_face;
  scan_from_face << frame.x, frame.y, frame.z;
  const auto found = find_lip_line(mesh, lip_line_of_landmarks(landmarks), scan_from_face);
  if (!found) return {};
  // The heights jump where the lips gape; only the course seen from in front counts.
  std::vector<Vec3> crease = as_list(found->points);
  crease.front() = landmarks.at(face::ibug(48));
  crease.back() = landmarks.at(face::ibug(54));
  const std::vector<Vec3> fine = resampled(crease);
  std::vector<Vec3> line = smoothed(fine, 0.0015);
  constexpr double most_m = 0.0003;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec3 moved = line[i] - fine[i];
    const double across = std::abs(moved.dot(frame.y));
    if (across > most_m) line[i] = fine[i] + moved * (most_m / across);
  }
  return as_rows(line);
}

}  // namespace hyperex::anatomy
