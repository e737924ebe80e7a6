// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/mouth_opening.hpp"

#include <algorithm>

#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/rbf.hpp"
#include "hyperex/simulate/drive/drive.hpp"

namespace hyperex::simulate {
namespace {

/// Displacements of `places` (rows) by those of the points (columns), others being still.
Eigen::MatrixXd field_weights(const std::vector<DrivenPoint>& points,
                              const std::vector<Vec3>& still, const Points& places) {
  const auto count = static_cast<Eigen::Index>(points.size());
  Points centres(count + static_cast<Eigen::Index>(still.size()), 3);
  for (Eigen::Index i = 0; i < centres.rows(); ++i)
    centres.row(i) = i < count ? points[std::size_t(i)].rest.transpose()
                               : still[std::size_t(i - count)].transpose();
  return rbf_weights(centres, count, places);
}

}  // namespace

MouthOpening mouth_opening(const AlignedMotion& motion, const std::vector<std::string>& driven,
                           const io::Landmarks& landmarks, double gain) {
  std::vector<DrivenPoint> points;
  std::vector<int> rows;
  for (const std::string& name : driven)
    if (const int row = motion.motion.index_of(name);
        row >= 0 && !std::count(rows.begin(), rows.end(), row)) {
      rows.push_back(row);
      points.push_back({name, motion.rest.row(row).transpose()});
    }
  MouthOpening widest;
  widest.eyes_m = (landmarks.at(face::ibug(36)) - landmarks.at(face::ibug(45))).norm();
  if (points.empty()) return widest;
  constexpr int mouth[] = {51, 57, 48, 54};
  Points places(4, 3);
  for (int k = 0; k < 4; ++k) places.row(k) = landmarks.at(face::ibug(mouth[k])).transpose();
  const Eigen::MatrixXd weights = field_weights(points, still_places(points, landmarks), places);
  const auto distance = [](const Points& at, int a, int b) {
    return (at.row(a) - at.row(b)).norm();
  };
  for (const Points& at : motion.motion.positions) {
    const Points moved =
        places + gain * (weights * (at - motion.motion.positions.front())(rows, Eigen::all));
    const double opening = distance(moved, 0, 1) - distance(places, 0, 1);
    if (opening <= widest.opening_m) continue;
    widest.opening_m = opening;
    widest.corners_m = distance(moved, 2, 3) - distance(places, 2, 3);
  }
  return widest;
}

bool jaw_drops_alone(const MouthOpening& mouth) {
  return mouth.opening_m > kWideOpening * mouth.eyes_m &&
         mouth.corners_m < kCornersPart * mouth.eyes_m;
}

}  // namespace hyperex::simulate
