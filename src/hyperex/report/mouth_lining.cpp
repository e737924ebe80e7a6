// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/mouth_lining.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "hyperex/anatomy/teeth/dental_arch.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/report/mouth_colours.hpp"

namespace hyperex::report {
namespace {

using anatomy::FaceCorners;
using Eigen::Index;

constexpr double kPi = std::numbers::pi;

/// x to the subject's left, y up, z forward, from the middle of the lips' edge.
struct MouthFrame {
  Vec3 origin, x, y, z;

  MouthFrame(const Points& edge, const FaceCorners& corners)
      : origin(edge.colwise().mean().transpose()) {
    const Vec3 across = corners.mouth[1] - corners.mouth[0];
    z = corners.forward.normalized();
    x = (across - across.dot(z) * z).normalized();
    y = z.cross(x);
  }
  Vec3 local(const Vec3& p) const {
    const Vec3 q = p - origin;
    return {q.dot(x), q.dot(y), q.dot(z)};
  }
  Vec3 world(const Vec3& q) const { return origin + q.x() * x + q.y() * y + q.z() * z; }
};

/// Convex hulls of sections across the mouth, widened by the lining's clearance.
class Hulls {
 public:
  explicit Hulls(const std::vector<Vec3>& content) {
    front_ = -1;
    double rear = 1;
    for (const Vec3& p : content) {
      front_ = std::max(front_, p.z() + kLiningClearance_m);
      rear = std::min(rear, p.z());
    }
    back_ = rear - kBeyond_m;
    const auto slices = std::size_t(std::ceil((front_ - back_) / kStep_m)) + 1;
    support_.assign(slices, std::vector<double>(kTurns, -INFINITY));
    for (const Vec3& p : content) {
      // What ends the rows goes on behind them.
      const double from = p.z() + kLiningClearance_m;
      const double to = p.z() - kLiningClearance_m - (p.z() < rear + 0.006 ? kBeyond_m : 0);
      for (std::size_t i = 0; i < slices; ++i) {
        const double z = z_of(i);
        if (z > from || z < to) continue;
        for (std::size_t k = 0; k < kTurns; ++k)
          support_[i][k] = std::max(support_[i][k], normal(k).dot(p.head<2>()));
      }
    }
  }

  std::size_t count() const { return support_.size(); }
  double z_of(std::size_t slice) const { return std::max(back_, front_ - kStep_m * double(slice)); }
  double back() const { return back_; }

  /// How far a ray from `base` along `way` (unit length) goes until it has left a section; 0 where
  /// it does not meet it.
  double leaves(std::size_t slice, const Eigen::Vector2d& base, const Eigen::Vector2d& way) const {
    double from = 0, to = INFINITY;
    for (std::size_t k = 0; k < kTurns; ++k) {
      const double limit = support_[slice][k];
      if (!std::isfinite(limit)) return 0;
      const double left = limit + kLiningClearance_m - normal(k).dot(base);
      const double speed = normal(k).dot(way);
      if (speed > 1e-9) {
        to = std::min(to, left / speed);
      } else if (speed < -1e-9) {
        from = std::max(from, left / speed);
      } else if (left < 0) {
        return 0;
      }
    }
    return to > from ? std::max(0.0, to) : 0;
  }

 private:
  static constexpr double kStep_m = 0.0015, kBeyond_m = 0.008;
  static constexpr std::size_t kTurns = 64;
  static const Eigen::Vector2d& normal(std::size_t k) {
    static const std::array<Eigen::Vector2d, kTurns> all = [] {
      std::array<Eigen::Vector2d, kTurns> out;
      for (std::size_t turn = 0; turn < kTurns; ++turn) {
        const double angle = 2 * kPi * double(turn) / double(kTurns);
        out[turn] = {std::cos(angle), std::sin(angle)};
      }
      return out;
    }();
    return all[k];
  }

  std::vector<std::vector<double>> support_;  // per slice and turn
  double front_ = 0, back_ = 0;
};

/// Teeth, gums and tongue in the mouth's frame; average rows where there are none.
std::vector<Vec3> content_of(const anatomy::Teeth* teeth, const MouthFrame& frame,
                             const FaceCorners& corners) {
  std::vector<Vec3> out;
  const auto add = [&](const anatomy::Teeth& all, const auto& place) {
    for (const TriMesh* part :
         {&all.upper.crowns, &all.upper.gum, &all.lower.crowns, &all.lower.gum, &all.tongue})
      for (const auto& p : part->points.rowwise()) out.push_back(place(Vec3(p.transpose())));
  };
  if (teeth) add(*teeth, [&](const Vec3& p) { return frame.local(p); });
  if (!out.empty()) return out;
  constexpr double mean_breadth_m = 0.0895, under_m = 0.003, behind_m = 0.009;
  const double scale =
      std::clamp((corners.outer[1] - corners.outer[0]).norm() / mean_breadth_m, 0.7, 1.3);
  add(anatomy::dental_arches({.scale = scale, .breadth = 0.9}),
      [&](const Vec3& p) { return Vec3(p - Vec3(0, under_m, behind_m)); });
  return out;
}

/// Where on the lips' edge a vertex is: -1 at the right corner to 1 at the left one.
struct Place {
  double across;
  bool upper;
};

std::vector<Place> places_on(const std::vector<Vec3>& edge) {
  const std::size_t n = edge.size();
  const auto left_of = [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); };
  const auto right =
      std::size_t(std::min_element(edge.begin(), edge.end(), left_of) - edge.begin());
  const auto left = std::size_t(std::max_element(edge.begin(), edge.end(), left_of) - edge.begin());
  std::vector<Place> out(n);
  // The skin lies to the left of its border's way, so that the upper lip's goes to the left corner.
  for (const bool upper : {true, false}) {
    const std::size_t from = upper ? right : left, to = upper ? left : right;
    std::vector<double> way{0};
    for (std::size_t i = from; i != to; i = (i + 1) % n)
      way.push_back(way.back() + (edge[(i + 1) % n] - edge[i]).norm());
    for (std::size_t k = 0, i = from; k < way.size(); ++k, i = (i + 1) % n) {
      const double share = way.back() > 0 ? 2 * way[k] / way.back() - 1 : 0;
      out[i] = {upper ? share : -share, upper};
    }
  }
  return out;
}

/// The way in which the lining leaves the slit: up or down from its middle, aside at its corners.
Eigen::Vector2d way_of(const Place& place) {
  constexpr double straight = 0.45;
  const double beyond = std::max(0.0, std::abs(place.across) - straight) / (1 - straight);
  const double turn = kPi / 2 * (1 - beyond);
  return {std::copysign(std::cos(turn), place.across), (place.upper ? 1 : -1) * std::sin(turn)};
}

/// The shortest way around a section along the mouth: depths and how far out, from the edge on.
std::vector<Eigen::Vector2d> taut(const Hulls& hulls, const Vec3& edge,
                                  const Eigen::Vector2d& way) {
  std::vector<Eigen::Vector2d> line{{edge.z(), 0}};
  for (std::size_t i = 0; i < hulls.count(); ++i) {
    const double z = hulls.z_of(i);
    if (z > edge.z() - 1e-3) continue;
    const Eigen::Vector2d next(z, hulls.leaves(i, edge.head<2>(), way));
    const auto inside = [&] {  // the last corner lies under the line past it
      const Eigen::Vector2d a = line[line.size() - 2], b = line.back();
      return (b.y() - a.y()) * (a.x() - next.x()) <= (next.y() - a.y()) * (a.x() - b.x());
    };
    while (line.size() > 1 && inside()) line.pop_back();
    line.push_back(next);
  }
  return line;
}

double out_at(const std::vector<Eigen::Vector2d>& line, double z) {
  for (std::size_t i = 1; i < line.size(); ++i)
    if (z >= line[i].x()) {
      const double share = (line[i - 1].x() - z) / (line[i - 1].x() - line[i].x());
      return line[i - 1].y() + share * (line[i].y() - line[i - 1].y());
    }
  return line.back().y();
}

/// Shares of the way to where the lining first meets the rows, then from there to its end.
constexpr std::array kBefore = {0.3, 0.65, 1.0};
constexpr std::array kBehind = {0.2, 0.45, 0.7, 1.0};
constexpr std::size_t kRings = kBefore.size() + kBehind.size();

using Room = std::function<double(double)>;

/// The rings behind one vertex of the edge.
std::array<Vec3, kRings> rings_behind(const Hulls& hulls, const Room& room, const Vec3& edge,
                                      const Place& place) {
  constexpr double latest = 0.45;  // of the depth
  const Eigen::Vector2d way = way_of(place);
  const std::vector<Eigen::Vector2d> line = taut(hulls, edge, way);
  double end = hulls.back();
  for (int pass = 0; pass < 2; ++pass)  // what ends earlier may end elsewhere
    end = std::max(end, -room(edge.y() + out_at(line, end) * way.y()));
  end = std::min(end, edge.z() - 0.004);
  const double meets = line.size() > 1 ? std::max(line[1].x(), edge.z() + latest * (end - edge.z()))
                                       : edge.z() + latest * (end - edge.z());
  std::array<Vec3, kRings> out;
  const auto put = [&](std::size_t ring, double z) {
    const Eigen::Vector2d at = edge.head<2>() + out_at(line, z) * way;
    out[ring] = {at.x(), at.y(), z};
  };
  for (std::size_t r = 0; r < kBefore.size(); ++r)
    put(r, edge.z() + kBefore[r] * (meets - edge.z()));
  for (std::size_t r = 0; r < kBehind.size(); ++r)
    put(kBefore.size() + r, meets + kBehind[r] * (end - meets));
  return out;
}

/// The triangles near `rest`. What lies farther away is far behind all of the skin.
TriMesh near_part(const TriMesh& skin, const Points& rest) {
  constexpr double around_m = 0.02;
  const Eigen::Array3d low = rest.colwise().minCoeff().transpose().array() - around_m,
                       high = rest.colwise().maxCoeff().transpose().array() + around_m;
  std::vector<char> near(std::size_t(skin.points.rows()));
  for (Index v = 0; v < skin.points.rows(); ++v) {
    const Eigen::Array3d p = skin.points.row(v).transpose().array();
    near[std::size_t(v)] = (p >= low).all() && (p <= high).all();
  }
  std::vector<Index> rows;
  for (Index t = 0; t < skin.triangles.rows(); ++t)
    if (near[std::size_t(skin.triangles(t, 0))] || near[std::size_t(skin.triangles(t, 1))] ||
        near[std::size_t(skin.triangles(t, 2))])
      rows.push_back(t);
  return {skin.points, skin.triangles(rows, Eigen::all)};
}

/// Sets vertices back that come through the skin. The triangles at the edge do not determine which
/// side is inside.
void keep_behind(Points& rest, Index edge, const TriMesh& skin) {
  constexpr double behind_m = 0.0015, looks_along = 0.7;
  const TriMesh near = near_part(skin, rest);
  const SurfaceTree tree(near);
  const Points normals = vertex_normals(skin);
  const std::vector<ClosestPoint> nearest = tree.query_all(rest);
  for (Index v = edge; v < rest.rows(); ++v) {
    const ClosestPoint& at = nearest[std::size_t(v)];
    Vec3 out = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
      out += at.weights[k] * normals.row(near.triangles(at.triangle, k)).transpose();
    out.normalize();
    const Vec3 off = rest.row(v).transpose() - at.point;
    const double beyond = off.dot(out);
    if (std::abs(beyond) < looks_along * off.norm() || beyond < -behind_m) continue;
    rest.row(v) = (at.point - behind_m * out).transpose();
  }
}

/// Mucosa in the light that is left so far behind the edge.
Srgb lit(double way_m) {
  constexpr double falls_m = 0.023, least = 0.12;
  const double light = least + (1 - least) * std::exp(-std::pow(way_m / falls_m, 1.4));
  Srgb out{};
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = std::uint8_t(std::lround(kMucosaColour[k] * (k == 0 ? light : std::pow(light, 1.15))));
  return out;
}

}  // namespace

void line_mouth(Opening& opening, const TriMesh& skin, const FaceCorners& corners,
                const anatomy::Teeth* teeth, const Room& room) {
  const auto n = Index(opening.loop.size());
  const Points edge = skin.points(opening.loop, Eigen::all);
  const MouthFrame frame(edge, corners);
  std::vector<Vec3> local;
  for (const auto& p : edge.rowwise()) local.push_back(frame.local(p.transpose()));
  const std::vector<Vec3> content = content_of(teeth, frame, corners);
  const Hulls hulls(content);
  const std::vector<Place> places = places_on(local);

  opening.rest.resize(Index(kRings + 1) * n + 1, 3);
  opening.rest.topRows(n) = edge;
  opening.jaw.resize(n);
  for (Index i = 0; i < n; ++i) {
    const Place& place = places[std::size_t(i)];
    const double corner = std::max(0.0, std::abs(place.across) - 0.8) / 0.2 / 2;
    opening.jaw[i] = place.upper ? corner : 1 - corner;
    const auto rings = rings_behind(hulls, room, local[std::size_t(i)], place);
    for (std::size_t r = 0; r < kRings; ++r)
      opening.rest.row(Index(r + 1) * n + i) = frame.world(rings[r]).transpose();
  }
  const Eigen::RowVector3d last = opening.rest.middleRows(Index(kRings) * n, n).colwise().mean();
  Vec3 end = frame.local(last.transpose());
  end.z() = std::min(end.z(), std::max(hulls.back(), -room(end.y())));
  opening.depth_m = -end.z();
  opening.rest.row(Index(kRings + 1) * n) = frame.world(end).transpose();
  keep_behind(opening.rest, n, skin);
  for (std::size_t r = 0; r < kRings; ++r) {
    const double edge_share = r < kBefore.size() ? 1 - kBefore[r] : 0;
    opening.rings.push_back({edge_share, 0, 1 - edge_share});
  }
  opening.rings.push_back({0, 0, 1});
  for (Index v = 0; v < opening.rest.rows(); ++v) {
    const Vec3 at = frame.local(opening.rest.row(v).transpose());
    const Vec3 from = v == Index(kRings + 1) * n ? Vec3(0, 0, 0) : local[std::size_t(v % n)];
    opening.colours.push_back(lit((at - from).norm()));
  }
}

}  // namespace hyperex::report
