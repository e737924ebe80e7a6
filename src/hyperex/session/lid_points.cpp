// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/lid_points.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/face/ibug.hpp"
#include "hyperex/tracking/scan/lid_edges.hpp"

namespace hyperex::session {
namespace {

constexpr double kMostRatio = 2;

/// A place between the lids of an eye, and the model's points that tell how the lids move there.
struct LidPlace {
  std::vector<int> upper, lower;  ///< iBUG
  std::vector<int> beside = {};   ///< iBUG: the place is half-way from the points to these
};

/// Places of one kind: of the right and of the left eye.
struct LidPlaces {
  std::size_t first_name;  ///< in kLidPoints
  double least_ratio;      ///< of the aperture there over that at the points
  std::array<LidPlace, 2> of_eye;
};

const std::array<LidPlaces, 2>& lid_places() {
  static const std::array<LidPlaces, 2> places = {
      LidPlaces{0, 1.25, {LidPlace{{37, 38}, {41, 40}}, LidPlace{{43, 44}, {47, 46}}}},
      LidPlaces{4, 0.65, {LidPlace{{38}, {40}, {39}}, LidPlace{{43}, {47}, {42}}}}};
  return places;
}

/// Rows of the points in a motion; nothing where one is missing.
std::optional<std::vector<int>> rows_of(const motion::Motion& motion,
                                        const std::vector<int>& points) {
  std::vector<int> rows;
  for (const int point : points) {
    rows.push_back(motion.index_of(face::ibug(point)));
    if (rows.back() < 0) return {};
  }
  return rows;
}

Vec3 mean(const Points& at, const std::vector<int>& rows) {
  return at(rows, Eigen::all).colwise().mean().transpose();
}

/// A point at `at` on the scan that moves by `ratio` times the mean of others.
void add_point(simulate::AlignedMotion& aligned, const std::string& name, const Vec3& at,
               double ratio, const std::vector<int>& rows) {
  const Vec3 rest = mean(aligned.rest, rows);
  const auto append = [](Points& points, const Vec3& place) {
    points.conservativeResize(points.rows() + 1, 3);
    points.bottomRows(1) = place.transpose();
  };
  for (Points& now : aligned.motion.positions) append(now, at + ratio * (mean(now, rows) - rest));
  append(aligned.rest, at);
  aligned.motion.names.push_back(name);
}

/// What a place of an eye adds.
struct AddedPair {
  tracking::LidEdges edges;
  double ratio;
  std::vector<int> upper, lower;  ///< rows
};

void add_of_kind(simulate::AlignedMotion& aligned, const TriMesh& scan,
                 const Eigen::Matrix3d& scan_from_face, const LidPlaces& kind) {
  const Vec3 up = scan_from_face.col(1);
  std::array<std::optional<AddedPair>, 2> pairs;
  double widest = 0;
  for (std::size_t side = 0; side < 2; ++side) {
    const LidPlace& place = kind.of_eye[side];
    const auto upper_rows = rows_of(aligned.motion, place.upper),
               lower_rows = rows_of(aligned.motion, place.lower),
               beside_rows = rows_of(aligned.motion, place.beside);
    if (!upper_rows || !lower_rows || !beside_rows) continue;
    const Vec3 upper = mean(aligned.rest, *upper_rows), lower = mean(aligned.rest, *lower_rows);
    Vec3 between = (upper + lower) / 2;
    if (!beside_rows->empty()) between = (between + mean(aligned.rest, *beside_rows)) / 2;
    const auto edges = tracking::lid_edges_at(between, scan, scan_from_face);
    if (!edges) return;
    const double ratio = (edges->upper - edges->lower).dot(up) / (upper - lower).dot(up);
    if (!(ratio > 0 && ratio < kMostRatio)) return;
    widest = std::max(widest, ratio);
    pairs[side] = {*edges, ratio, *upper_rows, *lower_rows};
  }
  if (widest < kind.least_ratio) return;
  for (std::size_t side = 0; side < 2; ++side) {
    if (!pairs[side]) continue;
    const std::size_t name = kind.first_name + 2 * side;
    add_point(aligned, kLidPoints[name], pairs[side]->edges.upper, pairs[side]->ratio,
              pairs[side]->upper);
    add_point(aligned, kLidPoints[name + 1], pairs[side]->edges.lower, pairs[side]->ratio,
              pairs[side]->lower);
  }
}

}  // namespace

void add_lid_points(simulate::AlignedMotion& aligned, const TriMesh& scan,
                    const Eigen::Matrix3d& scan_from_face) {
  for (const LidPlaces& kind : lid_places()) add_of_kind(aligned, scan, scan_from_face, kind);
}

}  // namespace hyperex::session
