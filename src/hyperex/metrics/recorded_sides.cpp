// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/recorded_sides.hpp"

#include <algorithm>

#include "hyperex/face/ibug.hpp"
#include "hyperex/face/optional_landmarks.hpp"
#include "hyperex/face/same_place.hpp"
#include "hyperex/metrics/nan.hpp"

namespace hyperex::metrics {
namespace {

bool has_place(const motion::Motion& recorded, const std::string& name) {
  const std::string place = face::place_name(name);
  return std::ranges::any_of(
      recorded.names, [&](const std::string& one) { return face::place_name(one) == place; });
}

double shows_m(const std::string& name) {
  return face::is_known_landmark(face::full_name(name)) ? kLandmarkShows_m : kMarkerShows_m;
}

void forget(std::vector<double>& values) {
  std::ranges::fill(values, kNan);
}

void forget_side(SideExcursion& side, double& twin_mm) {
  side.excursion_mm = side.path_mm = side.peak_speed_mm_s = kNan;
  twin_mm = kNan;
}

void withhold(PairExcursion& pair, bool of_corners) {
  const bool both = pair.left_recorded && pair.right_recorded;
  if (both || (!of_corners && pair.left_recorded == pair.right_recorded)) return;
  if (!pair.left_recorded) forget_side(pair.left_side, pair.twin_left_mm);
  if (!pair.right_recorded) forget_side(pair.right_side, pair.twin_right_mm);
  pair.excursion_ratio = pair.path_ratio = pair.speed_ratio = pair.speed_correlation = kNan;
}

void withhold(Commissure& mouth, bool left_recorded, bool right_recorded) {
  if (!left_recorded) {
    forget(mouth.left_mm);
    forget(mouth.left_mm_s);
    mouth.left_from_midlip_mm = kNan;
    mouth.twin_left_track_mm.resize(0, 3);
  }
  if (!right_recorded) {
    forget(mouth.right_mm);
    forget(mouth.right_mm_s);
    mouth.right_from_midlip_mm = kNan;
    mouth.twin_right_track_mm.resize(0, 3);
  }
}

void withhold(SymmetryCurve& curve, bool left_recorded, bool right_recorded) {
  if (left_recorded && right_recorded) return;
  if (!left_recorded) forget(curve.xi_left);
  if (!right_recorded) forget(curve.xi_right);
  forget(curve.s);
  curve.noise.clear();
  curve.mesh_noise.clear();
  curve.mesh_remainder.clear();
}

}  // namespace

bool is_recorded(const motion::Motion& recorded, const std::string& name, const Vec3& rest) {
  if (has_place(recorded, name)) return true;
  const Points& first = recorded.positions.front();
  for (Eigen::Index p = 0; p < first.rows(); ++p)
    if ((first.row(p).transpose() - rest).norm() <= shows_m(recorded.names[std::size_t(p)]))
      return true;
  return false;
}

void withhold_unrecorded(SymmetryMeasures& measures, const motion::Motion& landmarks,
                         const motion::Motion& recorded) {
  const auto name_of = [&](int column) { return landmarks.names[std::size_t(column)]; };
  const auto shows_corner = [&](int column) {
    return is_recorded(recorded, name_of(column),
                       landmarks.positions.front().row(column).transpose());
  };
  const std::string corner = face::place_name("cheilion_L");
  for (PairExcursion& pair : measures.excursions.pairs) {
    if (pair.left < 0 || pair.right < 0) continue;
    const bool of_corners = face::place_name(name_of(pair.left)) == corner;
    const auto shows = [&](int column) {
      return of_corners ? shows_corner(column) : has_place(recorded, name_of(column));
    };
    pair.left_recorded = shows(pair.left);
    pair.right_recorded = shows(pair.right);
    withhold(pair, of_corners);
  }
  Commissure& mouth = measures.excursions.commissure;
  if (mouth.left < 0 || mouth.right < 0) return;
  const bool left = shows_corner(mouth.left), right = shows_corner(mouth.right);
  withhold(mouth, left, right);
  withhold(measures.curve, left, right);
}

}  // namespace hyperex::metrics
