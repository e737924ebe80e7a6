// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/soft_tissue_moves.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "hyperex/core/files.hpp"
#include "hyperex/face/face_frame.hpp"

namespace hyperex::metrics {
namespace {
using simulate::BonePart;

constexpr std::array kLandmarks = {
    "pronasale", "subnasale",  "labiale_superius", "stomion", "labiale_inferius",
    "pogonion",  "cheilion_R", "cheilion_L",       "alare_R", "alare_L"};
/// A movement below this has no ratio, mm.
constexpr double kLeastMove_mm = 0.5;

constexpr const char* kTabulated =
    "studies tabulated by Gupta and Schendel, in Peterson's Principles of Oral and Maxillofacial "
    "Surgery (2022), ch. 67";

/// The movement along an axis where one segment alone moves along it, mm; else 0.
double sole_move_mm(const std::vector<simulate::BoneMove>& moves, int axis,
                    simulate::BonePart part) {
  double by = 0;
  for (const simulate::BoneMove& move : moves) {
    const double mm = 1e3 * move.move_m[std::size_t(axis)];
    if (mm == 0) continue;
    if (move.part != part || by != 0) return 0;
    by = mm;
  }
  return std::abs(by) < kLeastMove_mm ? 0 : by;
}

void add_ratio(const std::vector<simulate::BoneMove>& moves, SoftTissueMove& of) {
  for (const PublishedRatio& one : published_ratios()) {
    if (one.landmark != of.landmark) continue;
    const double by = sole_move_mm(moves, one.axis, one.part);
    if (by * one.sign <= 0) continue;
    of.published = &one;
    of.ratio = of.at_rest[one.axis] / by;
    return;
  }
}

std::string three_decimals(double value) {
  return std::isfinite(value) ? fmt::format("{:.3f}", value) : "";
}

}  // namespace

const std::vector<PublishedRatio>& published_ratios() {
  static const std::vector<PublishedRatio> table = {
      {BonePart::mandible, 2, 1, "labiale_inferius", 0.57, 0.26, 0.85, kTabulated},
      {BonePart::mandible, 2, 1, "pogonion", 1.0, 0.80, 1.33,
       "20 papers in Hallulli and Sjoestroem, BMC Oral Health (2026)"},
      {BonePart::mandible, 2, 1, "labiale_superius", 0, -0.02, 0, kTabulated},
      {BonePart::mandible, 2, -1, "labiale_inferius", 0.90, 0.75, 1.02, kTabulated},
      {BonePart::mandible, 2, -1, "pogonion", 0.95, 0.83, 1.05, kTabulated},
      {BonePart::mandible, 2, -1, "labiale_superius", 0.2, 0, 0.32, kTabulated},
      {BonePart::maxilla, 2, 1, "pronasale", 0.28, 0.17, 0.36, kTabulated},
      {BonePart::maxilla, 2, 1, "subnasale", 0.50, 0.30, 0.60, kTabulated},
      {BonePart::maxilla, 2, 1, "labiale_superius", 0.60, 0.50, 0.90, kTabulated},
      {BonePart::maxilla, 1, 1, "pronasale", 0.16, 0.15, 0.16, kTabulated},
      {BonePart::maxilla, 1, 1, "subnasale", 0.20, 0.20, 0.29, kTabulated},
      {BonePart::maxilla, 1, 1, "labiale_superius", 0.33, 0.06, 0.51, kTabulated},
      {BonePart::chin, 2, 1, "pogonion", 0.90, 0.57, 1.05, kTabulated},
      {BonePart::chin, 2, -1, "pogonion", 0.50, 0.33, 0.75, kTabulated},
  };
  return table;
}

std::vector<SoftTissueMove> soft_tissue_moves(const simulate::Performance& before,
                                              const simulate::Performance& after,
                                              const io::Landmarks& landmarks,
                                              const std::vector<simulate::BoneMove>& moves) {
  const Eigen::Matrix3d to_face = face::face_frame(landmarks).face_from_scan();
  const motion::Motion &own = before.landmarks, &then = after.landmarks;
  const auto peak = std::size_t(before.peak_frame);
  std::vector<SoftTissueMove> out;
  for (const char* name : kLandmarks) {
    const int a = own.index_of(name), b = then.index_of(name);
    if (a < 0 || b < 0) continue;
    const auto at = [](const motion::Motion& of, std::size_t sample, int row) -> Vec3 {
      return of.positions[sample].row(row).transpose();
    };
    SoftTissueMove one;
    one.landmark = name;
    one.at_rest = 1e3 * (to_face * (at(then, 0, b) - at(own, 0, a)));
    one.expression_before = 1e3 * (to_face * (at(own, peak, a) - at(own, 0, a)));
    one.expression_after = 1e3 * (to_face * (at(then, peak, b) - at(then, 0, b)));
    add_ratio(moves, one);
    out.push_back(std::move(one));
  }
  return out;
}

double change_of_nose_width_mm(const simulate::Performance& before,
                               const simulate::Performance& after) {
  const auto width = [](const motion::Motion& of) {
    const int left = of.index_of("alare_L"), right = of.index_of("alare_R");
    if (left < 0 || right < 0) return std::numeric_limits<double>::quiet_NaN();
    return (of.positions.front().row(left) - of.positions.front().row(right)).norm();
  };
  return 1e3 * (width(after.landmarks) - width(before.landmarks));
}

namespace {

/// The skin at rest.
Points at_rest(const simulate::Performance& of) {
  if (of.neutral_displacement_m.rows() == 0) return of.skin_rest.points;
  return of.skin_rest.points + of.neutral_displacement_m.cast<double>();
}

}  // namespace

double change_of_volume_ml(const simulate::Performance& before,
                           const simulate::Performance& after) {
  const Points from = at_rest(before), to = at_rest(after);
  double volume_m3 = 0;
  for (const auto& t : before.skin_rest.triangles.rowwise()) {
    const auto area = [&](double share) -> Vec3 {
      const auto at = [&](int k) -> Vec3 {
        return (1 - share) * from.row(t[k]) + share * to.row(t[k]);
      };
      return (at(1) - at(0)).cross(at(2) - at(0)) / 2;
    };
    Vec3 by = Vec3::Zero();
    for (int k = 0; k < 3; ++k) by += (to.row(t[k]) - from.row(t[k])).transpose() / 3;
    // The area vector is quadratic along the way: Simpson's rule is exact for it.
    volume_m3 += by.dot(area(0) + 4 * area(0.5) + area(1)) / 6;
  }
  return 1e6 * volume_m3;
}

double greatest_change_at_rest_mm(const simulate::Performance& before,
                                  const simulate::Performance& after) {
  return 1e3 * (at_rest(after) - at_rest(before)).rowwise().norm().maxCoeff();
}

void write_soft_tissue_csv(const std::filesystem::path& file,
                           const std::vector<SoftTissueMove>& moves) {
  write_file_atomically(file, [&](std::ostream& out) {
    out << "landmark,rest_left_mm,rest_up_mm,rest_forward_mm,before_left_mm,before_up_mm,"
           "before_forward_mm,after_left_mm,after_up_mm,after_forward_mm,soft_per_bone,"
           "published_usual,published_low,published_high\n";
    for (const SoftTissueMove& m : moves) {
      out << m.landmark;
      for (const Vec3& v : {m.at_rest, m.expression_before, m.expression_after})
        for (const double mm : v) out << ',' << three_decimals(mm);
      out << ',' << three_decimals(m.ratio);
      for (const double value :
           {m.published ? m.published->usual : NAN, m.published ? m.published->low : NAN,
            m.published ? m.published->high : NAN})
        out << ',' << three_decimals(value);
      out << '\n';
    }
  });
}

nlohmann::ordered_json json_of(const std::vector<SoftTissueMove>& moves) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  const auto vector = [](const Vec3& v) { return nlohmann::ordered_json{v.x(), v.y(), v.z()}; };
  for (const SoftTissueMove& m : moves) {
    nlohmann::ordered_json one{{"landmark", m.landmark},
                               {"at_rest_mm", vector(m.at_rest)},
                               {"expression_before_mm", vector(m.expression_before)},
                               {"expression_after_mm", vector(m.expression_after)}};
    if (m.published) {
      one["soft_per_bone"] = m.ratio;
      one["published"] = {{"usual", m.published->usual},
                          {"low", m.published->low},
                          {"high", m.published->high},
                          {"source", m.published->source}};
    }
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace hyperex::metrics
