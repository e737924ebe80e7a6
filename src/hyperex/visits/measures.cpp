// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/visits/measures.hpp"

#include <cmath>
#include <numbers>

#include "hyperex/metrics/nan.hpp"

namespace hyperex::visits {
namespace {

using metrics::kNan;

/// To the subject's left, up and forward, m.
Vec3 movement(const FaceState& face, FacePoint point) {
  return face.axes * (at(face.peak, point) - at(face.rest, point));
}

Vec3 corner(const FaceState& face, Side side) {
  return movement(face, of_side(FacePoint::corner_R, side));
}

double outward(const Vec3& way, Side side) {
  return side == Side::left ? way.x() : -way.x();
}

double excursion(const FaceState& face, Side side) {
  const FacePoint point = of_side(FacePoint::corner_R, side);
  return (at(face.peak, point) - at(face.rest, point)).norm();
}

double smile_angle(const FaceState& face, Side side) {
  const Vec3 way = corner(face, side);
  if (!(std::hypot(way.x(), way.y()) >= kLeastMovement_m)) return kNan;
  return std::atan2(way.y(), outward(way, side)) * 180 / std::numbers::pi;
}

double follows(const FaceState& face, Side side) {
  const auto other = std::size_t(side == Side::left ? Side::right : Side::left);
  Vec3 way = face.first_direction[other];  // NaN where the other corner did not move
  way.x() = -way.x();
  return 100 * corner(face, side).dot(way) / face.first_excursion_m[other];
}

double eye_opening(const ByFacePoint<Vec3>& points, Side side) {
  return (at(points, of_side(FacePoint::upper_lid_R, side)) -
          at(points, of_side(FacePoint::lower_lid_R, side)))
      .norm();
}

double philtrum(const FaceState& face, const ByFacePoint<Vec3>& points) {
  return face.axes.row(0).dot(at(points, FacePoint::upper_lip) - at(points, FacePoint::subnasale));
}

double corner_height(const FaceState& face) {
  return face.axes.row(1).dot(at(face.rest, FacePoint::corner_R) -
                              at(face.rest, FacePoint::corner_L));
}

/// xi of metrics::SymmetryCurve: relative changes of the distances from the corner of the mouth.
double stretch(const FaceState& face, Side side) {
  double sum = 0;
  for (const FacePoint right : {FacePoint::outer_eye_R, FacePoint::lower_lid_R, FacePoint::alare_R,
                                FacePoint::crista_philtri_R}) {
    const auto distance = [&](const ByFacePoint<Vec3>& points) {
      return (at(points, of_side(FacePoint::corner_R, side)) - at(points, of_side(right, side)))
          .norm();
    };
    sum += distance(face.peak) / distance(face.rest) - 1;
  }
  return sum;
}

using BySide = double (*)(const FaceState&, Side);
constexpr const char *kMm = "mm", *kDegrees = "degrees", *kPercent = "%";

/// A length is given in metres and becomes millimetres.
void add_pair(std::vector<Measure>& all, const std::string& key, const std::string& words,
              const std::string& unit, BySide value) {
  const double scale = unit == kMm ? 1e3 : 1;
  for (const Side side : {Side::right, Side::left})
    all.push_back({key, words, side == Side::right ? "R" : "L", unit,
                   [=](const FaceState& face) { return scale * value(face, side); }});
}

void add_single(std::vector<Measure>& all, const std::string& key, const std::string& words,
                double (*value)(const FaceState&)) {
  all.push_back({key, words, "", kMm, [=](const FaceState& face) { return 1e3 * value(face); }});
}

void add_corners(std::vector<Measure>& all) {
  add_pair(all, "corner_excursion", "Corner of the mouth: excursion", kMm, excursion);
  add_pair(all, "corner_up", "Corner of the mouth: upward", kMm,
           [](const FaceState& face, Side side) { return corner(face, side).y(); });
  add_pair(all, "corner_outward", "Corner of the mouth: outward", kMm,
           [](const FaceState& face, Side side) { return outward(corner(face, side), side); });
  add_pair(all, "corner_forward", "Corner of the mouth: forward", kMm,
           [](const FaceState& face, Side side) { return corner(face, side).z(); });
  add_pair(all, "smile_angle", "Corner of the mouth: angle, 0 outward, 90 up", kDegrees,
           smile_angle);
  add_pair(all, "corner_along_first", "Corner of the mouth: along its first direction", kMm,
           [](const FaceState& face, Side side) {
             return corner(face, side).dot(face.first_direction[std::size_t(side)]);
           });
  add_pair(all, "corner_follows", "Corner: share of the other's way at first visit", kPercent,
           follows);
  add_single(all, "corner_difference", "Corners of the mouth: excursion R less L",
             [](const FaceState& face) {
               return excursion(face, Side::right) - excursion(face, Side::left);
             });
}

std::vector<Measure> all_measures() {
  std::vector<Measure> all;
  add_corners(all);
  all.push_back({"stretch_difference", "Stretch about the mouth: right less left", "", kPercent,
                 [](const FaceState& face) {
                   return 100 * (stretch(face, Side::right) - stretch(face, Side::left));
                 }});
  add_single(all, "lip_opening", "Lips: opening at the peak", [](const FaceState& face) {
    return (at(face.peak, FacePoint::inner_upper_lip) - at(face.peak, FacePoint::inner_lower_lip))
        .norm();
  });
  add_pair(all, "brow_raise", "Brow: upward", kMm, [](const FaceState& face, Side side) {
    return movement(face, of_side(FacePoint::brow_R, side)).y();
  });
  add_pair(all, "eye_opening", "Eye: opening at rest", kMm,
           [](const FaceState& face, Side side) { return eye_opening(face.rest, side); });
  add_pair(all, "eye_narrowing", "Eye: narrower at the peak", kMm,
           [](const FaceState& face, Side side) {
             return eye_opening(face.rest, side) - eye_opening(face.peak, side);
           });
  add_single(all, "philtrum_rest", "Philtrum: to the left at rest",
             [](const FaceState& face) { return philtrum(face, face.rest); });
  add_single(all, "philtrum_peak", "Philtrum: to the left at the peak",
             [](const FaceState& face) { return philtrum(face, face.peak); });
  add_single(all, "corner_height", "Corners of the mouth: R higher than L at rest", corner_height);
  return all;
}

}  // namespace

const std::vector<Measure>& measures() {
  static const std::vector<Measure> all = all_measures();
  return all;
}

}  // namespace hyperex::visits
