// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/insert_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>

#include "hyperex/geometry/geodesic.hpp"

namespace hyperex {
namespace {
using Edge = std::pair<int, int>;
using Vec2 = Eigen::Vector2d;

constexpr double snap_share = 0.15;
constexpr double band_share = 0.15;
constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

Edge edge_of(int a, int b) {
  return {std::min(a, b), std::max(a, b)};
}

/// A polyline projected along one direction.
class SeenLine {
 public:
  SeenLine(const Points& line, const Vec3& towards_viewer)
      : u_(towards_viewer.unitOrthogonal()), v_(towards_viewer.cross(u_)) {
    for (Eigen::Index i = 0; i < line.rows(); ++i) {
      const Vec3 p = line.row(i);
      if (!corners_.empty() && (seen(p) - seen(corners_.back())).norm() < 1e-9) continue;
      corners_.push_back(p);
    }
    if (corners_.size() < 2) throw std::invalid_argument("the line has no length");
    for (std::size_t i = 0; i + 1 < corners_.size(); ++i)
      length_ += (corners_[i + 1] - corners_[i]).norm();
  }

  double length() const { return length_; }

  double distance(const Vec3& p) const {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < corners_.size(); ++i) {
      const Vec3 e = corners_[i + 1] - corners_[i];
      const double t = std::clamp((p - corners_[i]).dot(e) / e.squaredNorm(), 0.0, 1.0);
      best = std::min(best, (p - corners_[i] - t * e).squaredNorm());
    }
    return std::sqrt(best);
  }

  /// Signed distance from the line in the projection, positive on its left. The line is extended
  /// straight beyond its ends.
  double offset(const Vec3& p) const {
    double best = std::numeric_limits<double>::infinity(), off = 0;
    for (std::size_t i = 0; i + 1 < corners_.size(); ++i) {
      const Vec2 a = seen(corners_[i]), e = seen(corners_[i + 1]) - a, d = seen(p) - a;
      double t = d.dot(e) / e.squaredNorm();
      if (i > 0) t = std::max(t, 0.0);
      if (i + 2 < corners_.size()) t = std::min(t, 1.0);
      const double distance = (d - t * e).norm();
      const double across = (e.x() * d.y() - e.y() * d.x()) / e.norm();
      // If a corner of the line is closest, two segments have the same distance. The sign is then
      // taken from the one whose extension is farther away.
      const bool tie = std::abs(distance - best) < 1e-9 * length_;
      if (tie ? std::abs(across) > std::abs(off) : distance < best) {
        off = across;
        best = distance;
      }
    }
    return std::copysign(best, off);
  }

 private:
  Vec2 seen(const Vec3& p) const { return {p.dot(u_), p.dot(v_)}; }
  Vec3 u_, v_;
  std::vector<Vec3> corners_;
  double length_ = 0;
};

/// Offsets from the line of the vertices near it (NaN for others). The offset is set to 0 if the
/// line crosses an edge close to the vertex.
std::vector<double> snapped_offsets(const TriMesh& mesh, const SeenLine& line) {
  std::vector<double> offset(mesh.points.rows(), nowhere);
  for (std::size_t v = 0; v < offset.size(); ++v)
    if (const Vec3 p = mesh.points.row(v); line.distance(p) < band_share * line.length())
      offset[v] = line.offset(p);
  std::vector<double> snapped = offset;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      for (const auto& [a, b] : {Edge{mesh.triangles(f, k), mesh.triangles(f, (k + 1) % 3)},
                                 Edge{mesh.triangles(f, (k + 1) % 3), mesh.triangles(f, k)}})
        if (offset[a] * offset[b] <= 0 &&
            std::abs(offset[a]) <= snap_share * std::abs(offset[a] - offset[b]))
          snapped[a] = 0;
  return snapped;
}

using EdgeVertices = std::map<Edge, int>;  // edge -> its appended vertex

/// Splits a triangle that has appended vertices on one or two edges; appends its pieces to
/// `pieces`.
void split(const TriMesh& mesh, Eigen::Index f, const EdgeVertices& on_edge, const Points& points,
           std::vector<std::array<int, 3>>& pieces) {
  const auto at = [&](int a, int b) {
    const auto it = on_edge.find(edge_of(a, b));
    return it == on_edge.end() ? -1 : it->second;
  };
  std::array<int, 3> corner{}, middle{};
  int count = 0;
  for (int k = 0; k < 3; ++k) corner[k] = mesh.triangles(f, k);
  for (int k = 0; k < 3; ++k) {
    middle[k] = at(corner[k], corner[(k + 1) % 3]);
    count += middle[k] >= 0;
  }
  if (count > 2) throw std::logic_error("a line cannot cross all edges of a triangle");
  for (int k = 0; k < 3; ++k) {
    const int a = corner[k], b = corner[(k + 1) % 3], c = corner[(k + 2) % 3];
    const int p = middle[k], q = middle[(k + 2) % 3];  // on (a, b) and (c, a)
    if (count == 1 && p >= 0) {
      pieces.push_back({a, p, c});
      pieces.push_back({p, b, c});
    } else if (count == 2 && p >= 0 && q >= 0) {
      pieces.push_back({a, p, q});
      const bool from_p = (points.row(p) - points.row(c)).squaredNorm() <
                          (points.row(b) - points.row(q)).squaredNorm();
      pieces.push_back({p, b, from_p ? c : q});
      pieces.push_back({from_p ? p : b, c, q});
    }
  }
}

LinedSurface refined(const TriMesh& mesh, std::vector<EdgePoint> points) {
  LinedSurface out;
  const Eigen::Index old = mesh.points.rows();
  EdgeVertices on_edge;
  out.mesh.points.resize(old + static_cast<Eigen::Index>(points.size()), 3);
  out.mesh.points.topRows(old) = mesh.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto v = old + static_cast<Eigen::Index>(i);
    on_edge[edge_of(points[i].a, points[i].b)] = static_cast<int>(v);
    out.mesh.points.row(v) = points[i].on(mesh.points).transpose();
  }
  out.appended = std::move(points);
  out.source_triangle.resize(mesh.triangles.rows());
  std::iota(out.source_triangle.begin(), out.source_triangle.end(), 0);
  out.mesh.triangles = mesh.triangles;
  std::vector<std::array<int, 3>> more;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    std::vector<std::array<int, 3>> pieces;
    split(mesh, f, on_edge, out.mesh.points, pieces);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (i == 0) {
        out.mesh.triangles.row(f) << pieces[0][0], pieces[0][1], pieces[0][2];
      } else {
        more.push_back(pieces[i]);
        out.source_triangle.push_back(static_cast<int>(f));
      }
    }
  }
  const Eigen::Index kept = mesh.triangles.rows();
  out.mesh.triangles.conservativeResize(kept + static_cast<Eigen::Index>(more.size()), 3);
  for (std::size_t i = 0; i < more.size(); ++i)
    out.mesh.triangles.row(kept + static_cast<Eigen::Index>(i)) << more[i][0], more[i][1],
        more[i][2];
  return out;
}

std::vector<EdgePoint> crossings(const TriMesh& mesh, const std::vector<double>& offset) {
  std::map<Edge, EdgePoint> found;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = edge_of(mesh.triangles(f, k), mesh.triangles(f, (k + 1) % 3));
      if (offset[a] * offset[b] < 0) found[{a, b}] = {a, b, offset[a] / (offset[a] - offset[b])};
    }
  std::vector<EdgePoint> points;
  for (const auto& entry : found) points.push_back(entry.second);
  return points;
}

/// The path over vertices of the line only.
std::vector<int> walk(const TriMesh& mesh, const std::vector<char>& on_line, const Points& line) {
  const auto nearest = [&](const Vec3& p) {
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t v = 0; v < on_line.size(); ++v)
      if (const double d = (mesh.points.row(v).transpose() - p).squaredNorm();
          on_line[v] && d < least) {
        least = d;
        best = static_cast<int>(v);
      }
    return best;
  };
  const int from = nearest(line.row(0)), to = nearest(line.row(line.rows() - 1));
  constexpr double forbidden = 1e9;
  const auto cost = [&](int a, int b) {
    const double length = (mesh.points.row(a) - mesh.points.row(b)).norm();
    return on_line[a] && on_line[b] ? length : forbidden;
  };
  std::vector<int> path;
  if (from >= 0 && to >= 0) path = EdgePaths(mesh).cheapest(from, to, cost);
  for (int v : path)
    if (!on_line[v]) path.clear();
  if (path.size() < 3)
    throw std::invalid_argument("the line cannot be followed on the surface from end to end");
  return path;
}

}  // namespace

LinedSurface insert_line(const TriMesh& mesh, const Points& line, const Vec3& towards_viewer) {
  const std::vector<double> offset = snapped_offsets(mesh, SeenLine(line, towards_viewer));
  const LinedSurface all = refined(mesh, crossings(mesh, offset));
  std::vector<char> on_line(all.mesh.points.rows(), 1);
  for (std::size_t v = 0; v < offset.size(); ++v) on_line[v] = offset[v] == 0;
  const std::vector<int> path = walk(all.mesh, on_line, line);

  // Refines again with the vertices of the path only, as the line may also cross other sheets and
  // extend beyond the path.
  const auto old = static_cast<int>(mesh.points.rows());
  std::vector<EdgePoint> wanted;
  std::vector<int> kept_path;
  for (int v : path) {
    kept_path.push_back(v < old ? v : old + static_cast<int>(wanted.size()));
    if (v >= old) wanted.push_back(all.appended[v - old]);
  }
  LinedSurface out = refined(mesh, std::move(wanted));
  out.path = std::move(kept_path);
  return out;
}

}  // namespace hyperex
