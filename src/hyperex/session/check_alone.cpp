// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/check_alone.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "hyperex/core/add_rest.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/face/point_words.hpp"
#include "hyperex/session/misplaced_points.hpp"
#include "hyperex/session/plausible.hpp"
#include "hyperex/session/unit_that_fits.hpp"
#include "hyperex/simulate/drive/common_points.hpp"

namespace hyperex::session {
namespace {

// Measured: 0.89 to 1.16 at rest, by all points, by seven or twelve of the mouth and by four, in
// six people. By seven of the mouth 0.91 to 1.50 in every sample of a phone's take whose mouth
// opens wide. Small children are about 0.7. The units of length and the inch are 2.54 times apart
// or more.
constexpr double kSmallest = 0.5, kLargest = 1.8;
/// How far a person's size may be from the average one, as a factor, where a unit is to be found.
constexpr double kPeopleDiffer = 1.35;
/// How far a point must be from its place on the average face, m. People and trackers differ by
/// less.
constexpr double kElsewhere_m = 0.015;
/// Points that are closer together say nothing of size, m.
constexpr double kLeastSpread_m = 0.01;

/// The first sample with the most measured points, with those alone, by their full names.
motion::Motion fullest_sample(const motion::Motion& m) {
  const auto measured = [](const Points& sample) {
    Eigen::Index count = 0;
    for (Eigen::Index p = 0; p < sample.rows(); ++p) count += sample.row(p).allFinite() ? 1 : 0;
    return count;
  };
  const auto fullest = std::ranges::max_element(m.positions, {}, measured);
  const auto k = std::size_t(fullest - m.positions.begin());
  motion::Motion out;
  out.source = m.source;
  out.unit_note = m.unit_note;
  out.time_s = {m.time_s[k]};
  out.positions.emplace_back(measured(*fullest), 3);
  for (std::size_t p = 0; p < m.names.size(); ++p) {
    const auto row = fullest->row(Eigen::Index(p));
    const std::string name = face::full_name(m.names[p]);
    if (!row.allFinite() || std::ranges::count(out.names, name) > 0) continue;
    out.positions[0].row(Eigen::Index(out.names.size())) = row;
    out.names.push_back(name);
  }
  out.positions[0].conservativeResize(Eigen::Index(out.names.size()), 3);
  return out;
}

double spread_m(const Points& points) {
  return std::sqrt((points.rowwise() - points.colwise().mean()).rowwise().squaredNorm().mean());
}

/// What to do about a size of `ratio` that was read in this unit.
std::string advice(double ratio, const std::string& unit_note) {
  if (const auto unit =
          unit_that_fits(ratio, unit_note, kPeopleDiffer, "correct the unit there or state it"))
    return *unit;
  return "check its unit" + (unit_note.empty() ? "" : ", which was read as " + unit_note) +
         ", and that names and points belong together";
}

std::optional<Note> size_warning_of(const motion::Motion& sample) {
  const FaceAtRest average = average_face();
  const auto [names, recorded, expected] = simulate::common_points(sample, average.landmarks);
  if (names.size() < 2 || spread_m(expected) < kLeastSpread_m) return std::nullopt;
  const double ratio = spread_m(recorded) / spread_m(expected);
  if (ratio >= kSmallest && ratio <= kLargest) return std::nullopt;
  return make_warning(
      "recording.size_implausible",
      fmt::format("the recording has not the size of a face: its {} points with known names lie "
                  "{:.3g} times as far apart as on {} (expected: {:g} to {:g}); {}",
                  names.size(), ratio, average.whose, kSmallest, kLargest,
                  advice(ratio, sample.unit_note)));
}

/// Names up to three points that lie far from their places on the average face.
std::optional<Note> elsewhere_warning(const motion::Motion& sample) {
  constexpr std::size_t most_named = 3;
  const FaceAtRest average = average_face();
  std::vector<MisplacedPoints::Point> points = misplaced_points(sample, average.landmarks).points;
  std::erase_if(points, [](const auto& point) { return point.off_m < kElsewhere_m; });
  const std::size_t count = points.size();
  if (count == 0) return std::nullopt;
  std::vector<std::string> named;
  for (const auto& point : std::span(points).first(std::min(count, most_named)))
    named.push_back(fmt::format("{} lies {:.0f} mm off{}", face::name_in_words(point.name),
                                1e3 * point.off_m, exchanged_axes_words(point)));
  add_rest(named, count);
  const bool one = count == 1;
  const bool by_axes =
      std::ranges::none_of(points, [](const auto& point) { return point.exchanged_axes.empty(); });
  return make_warning(
      "recording.point_off",
      fmt::format("{} of the recording {} not where {} has {}: {};{} correct {} in the recording, "
                  "or leave {} out",
                  one ? "one point" : fmt::format("{} points", count), one ? "is" : "are",
                  average.whose, one ? "it" : "them", fmt::join(named, ", "),
                  by_axes ? ""
                  : one   ? " its name may be exchanged:"
                          : " their names may be exchanged:",
                  one ? "it" : "them", one ? "it" : "them"));
}

}  // namespace

std::vector<Note> check_alone(const motion::Motion& m, Readings readings) {
  std::vector<Note> warnings;
  const motion::Motion sample = fullest_sample(m);
  check_sides(sample, average_face());
  check_pairs(sample, average_face());
  add(warnings, sides_warning(sample, average_face()));
  add(warnings, exchanged_warning(sample, average_face()));
  add(warnings, size_warning_of(sample));
  add(warnings, elsewhere_warning(sample));
  add(warnings, timing_warning(m, readings));
  return warnings;
}

std::optional<Note> size_warning(const motion::Motion& m) {
  return size_warning_of(fullest_sample(m));
}

std::optional<Note> point_off_warning(const motion::Motion& m) {
  return elsewhere_warning(fullest_sample(m));
}

bool doubts_figures(const Note& warning) {
  static const std::vector<std::string> ids = {
      "sides.doubtful",         "sides.exchanged_pair",           "recording.size_implausible",
      "recording.point_off",    "recording.starts_in_expression", "recording.ends_in_expression",
      "recording.nothing_moves"};
  return std::ranges::count(ids, warning.id) > 0;
}

std::string guessed_unit(const motion::Motion& m) {
  return m.unit_note.find("(guessed") == std::string::npos ? "" : m.unit_note;
}

}  // namespace hyperex::session
