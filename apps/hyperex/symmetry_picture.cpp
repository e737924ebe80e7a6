// SPDX-License-Identifier: GPL-3.0-or-later
#include "symmetry_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "hyperex/face/point_words.hpp"
#include "hyperex/render/time_plot.hpp"

namespace hyperex::cli {
namespace {

std::vector<metrics::PairExcursion> farthest(const metrics::Excursions& excursions) {
  constexpr size_t most = 10;
  const auto reach = [](const metrics::PairExcursion& p) {
    return std::max(p.left_side.excursion_mm, p.right_side.excursion_mm);
  };
  std::vector<metrics::PairExcursion> pairs = excursions.pairs;
  std::stable_sort(pairs.begin(), pairs.end(),
                   [&](const auto& a, const auto& b) { return reach(a) > reach(b); });
  // The same landmark under two names (cheilion and ibug68_48/54) is drawn only once.
  const auto same = [](const metrics::PairExcursion& a, const metrics::PairExcursion& b) {
    constexpr double alike_mm = 1e-6;
    return std::abs(a.left_side.excursion_mm - b.left_side.excursion_mm) < alike_mm &&
           std::abs(a.right_side.excursion_mm - b.right_side.excursion_mm) < alike_mm;
  };
  pairs.erase(std::unique(pairs.begin(), pairs.end(), same), pairs.end());
  if (pairs.size() > most) pairs.resize(most);
  return pairs;
}

void draw_bars(render::Canvas& canvas, double y, const std::vector<metrics::PairExcursion>& pairs) {
  constexpr double x = 300, width = 390, bar = 9;
  double top = 0.1;
  for (const auto& p : pairs)
    top = std::max({top, p.left_side.excursion_mm, p.right_side.excursion_mm});
  canvas.text(70, y, "Excursion, largest distance from rest (mm)", {.size_px = 13});
  double legend = x + width;
  legend -=
      canvas.text(legend, y, "left",
                  {.size_px = 13, .colour = render::left_colour(), .align = render::Align::right}) +
      16;
  canvas.text(legend, y, "right",
              {.size_px = 13, .colour = render::right_colour(), .align = render::Align::right});
  canvas.text(870, y, "R/L", {.size_px = 13, .align = render::Align::right});
  for (const auto& p : pairs) {
    y += 27;
    canvas.text(x - 10, y + 4, face::point_words(p.name),
                {.size_px = 12, .align = render::Align::right});
    for (const bool left : {false, true}) {
      const double mm = (left ? p.left_side : p.right_side).excursion_mm;
      const double bar_y = y - bar + (left ? bar + 1 : 0);
      canvas.rectangle(x, bar_y, width * mm / top, bar,
                       left ? render::left_colour() : render::right_colour());
      canvas.text(x + width * mm / top + 6, bar_y + bar, fmt::format("{:.2f}", mm),
                  {.size_px = 10, .colour = render::palette::faint_ink});
    }
    const std::string ratio = p.undecided               ? "undecided"
                              : !p.decided(p.undecided) ? "cannot tell"
                              : std::isfinite(p.excursion_ratio)
                                  ? fmt::format("{:.2f}", p.excursion_ratio)
                                  : "-";
    canvas.text(870, y + 4, ratio, {.size_px = 12, .align = render::Align::right});
  }
}

/// xi of both sides, and S with its noise floor under it, from y = 90 to 648.
void draw_curves_of(render::Canvas& canvas, const metrics::SymmetryCurve& curve) {
  const render::Range time{curve.time_s.front(),
                           std::max(curve.time_s.back(), curve.time_s.front() + 1e-3)};
  std::vector<double> floor;
  for (const double value : curve.noise) floor.push_back(std::log(value));
  const std::vector<render::PlotCurve> sides = {{curve.xi_right, render::right_colour(), "right"},
                                                {curve.xi_left, render::left_colour(), "left"}};
  std::vector<render::PlotCurve> s = {{curve.s, render::palette::ink, ""}};
  if (!floor.empty())
    s.push_back({floor, render::palette::cut,
                 fmt::format("undecided below: {:.2g} mm of jitter", 1e3 * curve.jitter_m)});
  const render::TimePlot upper{
      70, 90, 800, 230, time, render::span_of(sides), "xi, relative change of length"};
  const std::string label = fmt::format(
      "S = ln |xi_L - xi_R|, not below {:.2f}; smaller: both sides "
      "stretch more alike",
      std::log(curve.floor));
  const render::TimePlot lower{70, 380, 800, 230, time, render::span_of(s), label};
  render::draw_axes(canvas, upper);
  render::draw_curves(canvas, upper, curve.time_s, sides);
  render::draw_axes(canvas, lower);
  if (!floor.empty()) render::shade_under(canvas, lower, curve.time_s, floor);
  render::draw_curves(canvas, lower, curve.time_s, s);
  canvas.text(470, 648, "time (s)", {.size_px = 13, .align = render::Align::centre});
  double below = 656;
  for (const char* line : metrics::kWhatSCompares)
    canvas.text(70, below += 16, line, {.size_px = 12, .colour = render::palette::faint_ink});
}

}  // namespace

render::Image draw(const metrics::SymmetryMeasures& measures, const std::string& title) {
  const metrics::SymmetryCurve& curve = measures.curve;
  const auto pairs = farthest(measures.excursions);
  const double bars = curve.known() ? 722 : 110;
  const double end = bars + 27 * static_cast<double>(pairs.size()) + 24;
  render::Canvas canvas(900, static_cast<int>(end) + 24);
  canvas.text(70, 42, title, {.size_px = 20, .bold = true});
  if (curve.known())
    draw_curves_of(canvas, curve);
  else
    canvas.text(70, 72, "S and xi are left out: the recording lacks points that they need.",
                {.size_px = 13});
  if (!pairs.empty()) draw_bars(canvas, bars, pairs);
  canvas.text(70, end + 10, "No medical device: these figures diagnose nothing.",
              {.size_px = 12, .colour = render::palette::faint_ink});
  return canvas.image();
}

}  // namespace hyperex::cli
