// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/reading_warnings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "hyperex/core/add_rest.hpp"
#include "hyperex/face/same_place.hpp"

namespace hyperex::session {
namespace {

constexpr std::size_t kNamedReadings = 3;

/// "FILE:LINE, point NAME at 0.467 s: 300 mm", of the first ones, and how many more there are.
std::string first_readings(const motion::Motion& m,
                           const std::vector<motion::WildSample>& readings) {
  std::vector<std::string> named;
  for (const motion::WildSample& reading : readings)
    if (named.size() < kNamedReadings)
      named.push_back(fmt::format("{}: {:.4g} mm",
                                  motion::place_of(m, reading.point, reading.sample),
                                  1e3 * reading.off_m));
  add_rest(named, readings.size());
  return fmt::format("{}", fmt::join(named, "; "));
}

/// "FILE:LINE, point NAME at 0.467 s to 1.200 s", of the first ones, and how many more there are.
std::string first_held(const motion::Motion& m, const std::vector<motion::HeldReadings>& held) {
  std::vector<std::string> named;
  for (const motion::HeldReadings& run : held)
    if (named.size() < kNamedReadings)
      named.push_back(fmt::format("{} to {:.3f} s", motion::place_of(m, run.point, run.first),
                                  m.time_s[run.last]));
  add_rest(named, held.size());
  return fmt::format("{}", fmt::join(named, "; "));
}

/// The farthest that a point goes, m. The mandible opens by 40 to 60 mm, a corner of the mouth
/// goes 10 to 20 mm in a smile and as much downwards with the jaw. Points whose part is not known
/// have the bound of the mandible.
double reach_m(const std::string& point) {
  const auto k = face::ibug_number_of_place(point);
  constexpr double mandible = 0.075, corner = 0.038, upper_lip = 0.03, brow = 0.025, nose = 0.02;
  if (!k || (*k >= 3 && *k <= 13)) return mandible;
  if (*k <= 16) return upper_lip;  // before the ears, beside the condyles
  if (*k <= 26) return brow;
  if (*k <= 47) return nose;  // and eyes: lids 12 mm
  if (*k == 48 || *k == 54 || *k == 60 || *k == 64) return corner;
  const bool upper = *k <= 53 || (*k >= 61 && *k <= 63);
  return upper ? upper_lip : mandible;
}

}  // namespace

std::vector<Note> reading_warnings(const motion::MendedMotion& mended) {
  std::vector<Note> notes;
  const auto add = [&](const char* id, const std::vector<motion::WildSample>& readings,
                       const std::string& what) {
    if (!readings.empty())
      notes.push_back(
          make_warning(id, fmt::format("{}: {}", what, first_readings(mended.motion, readings))));
  };
  add("recording.wild_samples", mended.wild,
      fmt::format(
          "a point jumps away and back, or away at an end of the recording, which no face does; {} "
          "such reading{} left out and interpolated",
          mended.wild.size(), mended.wild.size() > 1 ? "s were" : " was"));
  add("recording.zeros", mended.zeros,
      fmt::format("{} reading{} of (0, 0, 0) {} taken as missing, as the point is never near there "
                  "otherwise",
                  mended.zeros.size(), mended.zeros.size() > 1 ? "s" : "",
                  mended.zeros.size() > 1 ? "are" : "is"));
  add("recording.lone_samples", mended.lone,
      "a point jumps away and back in a single reading; kept, as a face could do so between "
      "readings that are so far apart in time, so look at it");
  add("recording.jumps", mended.jumps,
      "a point jumps between two readings as no face does; kept as it is, so correct it or leave "
      "its cells empty");
  if (!mended.held.empty())
    notes.push_back(make_warning(
        "recording.held_points",
        fmt::format("a point stays at exactly one place while the points beside it move, as a "
                    "marker does that was lost; kept as it is, so correct its readings or leave "
                    "their cells empty: {}",
                    first_held(mended.motion, mended.held))));
  add("recording.end_samples", mended.ends,
      "cannot tell whether a point that jumps at an end of the recording is read wrongly or moves "
      "like that; kept, so look at it, and leave its cells empty if it is wrong");
  return notes;
}

std::optional<Note> far_points_warning(const motion::Motion& steady, Readings readings) {
  std::vector<motion::WildSample> far;
  std::vector<std::string> bounds;
  for (std::size_t p = 0; p < steady.names.size(); ++p) {
    const auto row = Eigen::Index(p);
    motion::WildSample most{steady.names[p], 0, 0};
    std::optional<Eigen::RowVector3d> first;
    for (std::size_t k = 0; k < steady.positions.size(); ++k) {
      if (!steady.positions[k].row(row).allFinite()) continue;
      if (!first) first = steady.positions[k].row(row);
      const double far_m = (steady.positions[k].row(row) - *first).norm();
      if (far_m > most.off_m) most = {steady.names[p], k, far_m};
    }
    if (most.off_m > reach_m(most.point)) far.push_back(most);
  }
  if (far.empty()) return std::nullopt;
  std::ranges::stable_sort(far, std::ranges::greater{}, [](const motion::WildSample& reading) {
    return reading.off_m / reach_m(reading.point);
  });
  const motion::WildSample& worst = far.front();
  return make_warning(
      "recording.far_points",
      fmt::format(
          "a point goes farther from its first place than this part of a face can (for {}: "
          "{:g} mm); {}: {}",
          worst.point, 1e3 * reach_m(worst.point),
          readings == Readings::of_weights
              ? "shapes of a rig or face model move it there, so correct the weights or the "
                "rig's shapes and landmarks"
              : "correct the readings or leave their cells empty",
          first_readings(steady, far)));
}

}  // namespace hyperex::session
