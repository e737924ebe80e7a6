// SPDX-License-Identifier: GPL-3.0-or-later
#include "symmetry_print.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/face/point_words.hpp"
#include "hyperex/run/corner_words.hpp"

namespace hyperex::cli {
namespace {

std::string cell(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:10.{}f}", value, digits)
                              : fmt::format("{:>10}", "-");
}

/// Names the figures of a pair that may be due to noise alone, and those of which that is not
/// known.
std::string doubt_note(const metrics::PairExcursion& p) {
  std::vector<std::string> undecided, unknown;
  const auto judge = [&](const char* figure, bool below_floor) {
    const std::optional<bool> decided = p.decided(below_floor);
    if (!decided)
      unknown.emplace_back(figure);
    else if (!*decided)
      undecided.emplace_back(figure);
  };
  judge("excursion", p.undecided);
  judge("speed", p.peak_speed_undecided);
  judge("correlation", p.speed_correlation_undecided);
  std::string note;
  if (!undecided.empty()) note = fmt::format("  undecided: {}", fmt::join(undecided, ", "));
  if (unknown.size() == 3) return "  cannot tell";
  if (!unknown.empty()) note += fmt::format("  cannot tell: {}", fmt::join(unknown, ", "));
  return note;
}

/// Why figures above their floors are not decided.
void print_unknown(const metrics::KnownNoise& known) {
  if (known.all()) return;
  const std::string jitter = "the jitter of the points is not known",
                    head = "the head's motion is in the points";
  std::cout << fmt::format("cannot tell: {} may make such a difference\n",
                           known.head     ? jitter + " and"
                           : known.jitter ? head + " and"
                                          : head + ", " + jitter + ", and both");
}

/// What a clinician reads first: corners of the mouth, eyes, brows; last the outline of the jaw.
int reading_order(const metrics::PairExcursion& pair) {
  const std::string words = face::point_words(pair.name);
  constexpr std::array<const char*, 9> first_words = {"corner of the mouth",
                                                      "eyelid",
                                                      "corner of the eye",
                                                      "brow",
                                                      "lip",
                                                      "nostril",
                                                      "nose",
                                                      "cheek",
                                                      "of the jaw"};
  constexpr int kOthers = 8;  // before the jaw
  for (std::size_t i = 0; i < first_words.size(); ++i)
    if (words.find(first_words[i]) != std::string::npos)
      return int(i) < kOthers ? int(i) : kOthers + 1;
  return kOthers;
}

}  // namespace

void print_curve(const metrics::SymmetryCurve& curve) {
  constexpr std::size_t rows = 20;
  const std::size_t count = curve.time_s.size(), every = (count + rows - 1) / rows;
  std::cout << fmt::format("{:>10} {:>10} {:>10} {:>10} {:>10}\n", "time (s)", "xi_R", "xi_L",
                           "S (ln)", "S_floor");
  for (std::size_t i = 0; i < count; i += every)
    std::cout << fmt::format("{:10.4f} {} {} {} {}{}\n", curve.time_s[i],
                             cell(curve.xi_right[i], 5), cell(curve.xi_left[i], 5),
                             cell(curve.s[i], 5),
                             cell(curve.noise.empty() ? NAN : std::log(curve.noise[i]), 3),
                             i > 0 && curve.undecided(i) ? "  undecided" : "");
  if (every > 1)
    std::cout << fmt::format("one in {} of {} samples; --out FILE.csv writes all\n", every, count);
  std::cout << fmt::format("floor: |xi_L - xi_R| = {:.3g}, S = {:.3f}\n", curve.floor,
                           std::log(curve.floor));
  std::cout << fmt::format("{}\n", fmt::join(metrics::kWhatSCompares, " "));
}

void print_excursions(const metrics::Excursions& excursions) {
  std::cout << fmt::format("\n{:<43}{:>32}{:>33}{:>13}\n", "", "excursion (mm)  ",
                           "peak speed (mm/s)  ", "correlation");
  std::cout << fmt::format("{:<43} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10} {:>12}\n", "point",
                           "R", "L", "R/L", "R", "L", "R/L", "of speeds");
  std::vector<metrics::PairExcursion> pairs = excursions.pairs;
  std::ranges::stable_sort(pairs, {}, reading_order);
  for (const metrics::PairExcursion& p : pairs)
    std::cout << fmt::format("{:<43} {} {} {} {} {} {}   {}{}\n", face::point_words(p.name),
                             cell(p.right_side.excursion_mm, 2), cell(p.left_side.excursion_mm, 2),
                             cell(p.excursion_ratio, 3), cell(p.right_side.peak_speed_mm_s, 1),
                             cell(p.left_side.peak_speed_mm_s, 1), cell(p.speed_ratio, 3),
                             cell(p.speed_correlation, 3), doubt_note(p));
  if (excursions.lowpass_hz > 0)
    std::cout << fmt::format("excursions and speeds smoothed with a cut-off of {:g} Hz\n",
                             excursions.lowpass_hz);
  if (std::ranges::any_of(pairs, [](const auto& p) {
        return doubt_note(p).find("undecided") != std::string::npos;
      }))
    std::cout << "undecided: within what jitter and, for excursions, the head's pose make\n";
  if (const double mm = excursions.pairs.empty() ? 0 : excursions.pairs[0].repetition_floor_mm;
      mm > 0)
    std::cout << fmt::format(
        "repetition: differences of excursions below {:.1f} mm are undecided, as stated; all "
        "reasons together as the root of the sum of their squares\n",
        mm);
  print_unknown(excursions.known);
}

void print_head_uncertainty(const motion::StabilisedMotion& steady,
                            const session::RecordedJitter& jitter) {
  if (steady.shift_uncertainty_m.empty()) return;
  const double shift_mm = 1e3 * std::ranges::max(steady.shift_uncertainty_m),
               turn_deg = std::ranges::max(steady.turn_uncertainty_rad) * 180 / std::numbers::pi;
  const auto prints_as_none = [&](double unit) {
    return shift_mm < unit / 2 && turn_deg < unit / 2;
  };
  if (!prints_as_none(0.01))
    std::cout << fmt::format(
        "head's pose: uncertain by up to {0:.{2}f} mm and {1:.{2}f} degrees (95 %): differences of "
        "excursions below what this makes are undecided\n",
        shift_mm, turn_deg, prints_as_none(0.1) ? 2 : 1);
  else if (jitter.known && jitter.jitter_m == 0)
    std::cout << "head's pose: exact, as the points are\n";
  else
    std::cout << "head's pose: no noise is seen in the points that hold it, so that its "
                 "uncertainty is not known\n";
}

void print_summary(const metrics::SymmetryMeasures& all, const session::RecordedJitter& jitter,
                   bool doubtful) {
  const metrics::SymmetryCurve& curve = all.curve;
  size_t undecided = 0;
  for (size_t i = 1; i < curve.time_s.size(); ++i) undecided += curve.undecided(i);
  std::cout << '\n';
  if (curve.known()) std::cout << "stretch: " << metrics::verdict_of(curve);
  if (curve.jitter_m > 0)
    std::cout << fmt::format("; jitter {:.2f} mm leaves {} of {} samples undecided",
                             1e3 * curve.jitter_m, undecided, curve.time_s.size() - 1);
  if (curve.known()) std::cout << (doubtful ? run::kDoubtfulEnding : "") << '\n';
  if (jitter.known) std::cout << jitter.how << '\n';  // else a warning has said it
  if (all.map && !all.map->frames.empty()) {
    const auto& worst = all.map->frames[static_cast<size_t>(all.map->worst_frame)];
    std::cout << fmt::format(
        "asymmetry of the surface at {:.3f} s: face rms {:.2f} mm, 95 % below {:.2f} mm; mouth rms "
        "{:.2f} mm, 95 % below {:.2f} mm (at rest, taken out: rms {:.2f} mm)\n",
        curve.time_s[static_cast<size_t>(all.map->worst_frame)], worst.face_rms_mm,
        worst.face_p95_mm, worst.mouth_rms_mm, worst.mouth_p95_mm, all.map->rest_rms_mm);
  }
  std::cout << "This is no medical device: the figures describe a motion and diagnose nothing.\n";
}

}  // namespace hyperex::cli
