// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/scan/lid_edges.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hyperex/face/ibug.hpp"
#include "hyperex/render/render.hpp"

namespace hyperex::tracking {
namespace {

/// How far the edge is looked for, and how fine.
constexpr double kMostAside_m = 4e-3, kStep_m = 1e-4;
/// A surface this far in front of a landmark hides it; the edge lies at most kMostAhead_m in front.
constexpr double kHides_m = 1e-3, kMostAhead_m = 6e-3;

/// A landmark of a lid and that of the other lid.
using LidPoints = std::pair<std::string, std::string>;

std::vector<LidPoints> lid_points() {
  std::vector<LidPoints> points;
  for (const auto& [upper, lower] :
       {std::pair{37, 41}, std::pair{38, 40}, std::pair{43, 47}, std::pair{44, 46}}) {
    points.emplace_back(face::ibug(upper), face::ibug(lower));
    points.emplace_back(face::ibug(lower), face::ibug(upper));
  }
  points.emplace_back("palpebrale_inferius_R", face::ibug(37));
  points.emplace_back("palpebrale_inferius_L", face::ibug(44));
  return points;
}

/// Looks at the scan from the front, at places given in the scan's frame.
class FrontView {
 public:
  FrontView(const TriMesh& scan, const Vec3& target, const Eigen::Matrix3d& scan_from_face)
      : surface_{{.mesh = scan}},
        camera_{target, scan_from_face.col(2), scan_from_face.col(1), kHeight_m} {}

  std::vector<std::optional<render::Picked>> at(const std::vector<Vec3>& places) const {
    Eigen::MatrixX2d in_picture(Eigen::Index(places.size()), 2);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const render::Projected p = render::project(camera_, kPixels, kPixels, places[i]);
      in_picture.row(Eigen::Index(i)) << p.x, p.y;
    }
    return render::pick(surface_, camera_, kPixels, kPixels, in_picture);
  }

 private:
  static constexpr double kHeight_m = 0.2;
  static constexpr int kPixels = 1000;
  std::vector<render::Surface> surface_;
  render::Camera camera_;
};

/// The last place of the lid among those seen from the landmark on; nothing where the landmark is
/// not hidden, or where no edge follows.
std::optional<Vec3> edge_of(const Vec3& landmark, const Vec3& forward,
                            const std::vector<std::optional<render::Picked>>& seen) {
  std::optional<Vec3> last;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const double ahead_m = seen[i] ? (seen[i]->point - landmark).dot(forward) : -1;
    const bool lid = seen[i] && seen[i]->facing > 0 && ahead_m > -kHides_m;
    if (i == 0 && !(lid && ahead_m > kHides_m)) return std::nullopt;
    if (!lid) return last;
    if (ahead_m > kMostAhead_m) return std::nullopt;
    last = seen[i]->point;
  }
  return std::nullopt;
}

}  // namespace

void lids_to_edges(io::Landmarks& landmarks, const TriMesh& scan,
                   const Eigen::Matrix3d& scan_from_face) {
  const Vec3 forward = scan_from_face.col(2);
  constexpr auto steps = std::size_t(kMostAside_m / kStep_m) + 1;
  std::vector<std::string> names;
  std::vector<Vec3> places;
  for (const auto& [name, opposite] : lid_points()) {
    const auto from = landmarks.find(name), to = landmarks.find(opposite);
    if (from == landmarks.end() || to == landmarks.end()) continue;
    const Vec3 way = to->second - from->second;
    const Vec3 across = (way - way.dot(forward) * forward).normalized();
    names.push_back(name);
    for (std::size_t i = 0; i < steps; ++i)
      places.emplace_back(from->second + double(i) * kStep_m * across);
  }
  if (names.empty()) return;
  const auto seen = FrontView(scan, places.front(), scan_from_face).at(places);
  for (std::size_t n = 0; n < names.size(); ++n) {
    const auto first = seen.begin() + std::ptrdiff_t(n * steps);
    Vec3& landmark = landmarks.at(names[n]);
    if (const auto edge = edge_of(landmark, forward, {first, first + std::ptrdiff_t(steps)}))
      landmark = *edge;
  }
}

}  // namespace hyperex::tracking
