// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/lid_middles.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "hyperex/face/ibug.hpp"
#include "hyperex/tracking/scan/lid_edges.hpp"

namespace hyperex::session {
namespace {

constexpr double kLeastRatio = 1.25, kMostRatio = 2;

/// Rows of the motion: two points of the upper lid, and those below them.
struct EyeRows {
  std::array<int, 2> upper, lower;
  bool complete() const { return upper[0] >= 0 && upper[1] >= 0 && lower[0] >= 0 && lower[1] >= 0; }
};

Vec3 mean(const Points& at, const std::array<int, 2>& rows) {
  return (at.row(rows[0]) + at.row(rows[1])).transpose() / 2;
}

/// A point at `at` on the scan that moves by `ratio` times the mean of two others.
void add_point(simulate::AlignedMotion& aligned, const std::string& name, const Vec3& at,
               double ratio, const std::array<int, 2>& rows) {
  const Vec3 rest = mean(aligned.rest, rows);
  const auto append = [](Points& points, const Vec3& place) {
    points.conservativeResize(points.rows() + 1, 3);
    points.bottomRows(1) = place.transpose();
  };
  for (Points& now : aligned.motion.positions) append(now, at + ratio * (mean(now, rows) - rest));
  append(aligned.rest, at);
  aligned.motion.names.push_back(name);
}

}  // namespace

void add_lid_middles(simulate::AlignedMotion& aligned, const TriMesh& scan,
                     const Eigen::Matrix3d& scan_from_face) {
  const auto row = [&](int number) { return aligned.motion.index_of(face::ibug(number)); };
  const std::array<EyeRows, 2> eyes = {EyeRows{{row(37), row(38)}, {row(41), row(40)}},
                                       EyeRows{{row(43), row(44)}, {row(47), row(46)}}};
  const Vec3 up = scan_from_face.col(1);
  std::array<std::optional<tracking::LidEdges>, 2> edges;
  std::array<double, 2> ratio{};
  for (std::size_t side = 0; side < 2; ++side) {
    const EyeRows& eye = eyes[side];
    if (!eye.complete()) continue;
    const Vec3 upper = mean(aligned.rest, eye.upper), lower = mean(aligned.rest, eye.lower);
    edges[side] = tracking::lid_edges_at((upper + lower) / 2, scan, scan_from_face);
    if (!edges[side]) return;
    ratio[side] = (edges[side]->upper - edges[side]->lower).dot(up) / (upper - lower).dot(up);
    if (!(ratio[side] > 0 && ratio[side] < kMostRatio)) return;
  }
  if (std::max(ratio[0], ratio[1]) < kLeastRatio) return;
  for (std::size_t side = 0; side < 2; ++side) {
    if (!edges[side]) continue;
    add_point(aligned, kLidMiddles[2 * side], edges[side]->upper, ratio[side], eyes[side].upper);
    add_point(aligned, kLidMiddles[2 * side + 1], edges[side]->lower, ratio[side],
              eyes[side].lower);
  }
}

}  // namespace hyperex::session
