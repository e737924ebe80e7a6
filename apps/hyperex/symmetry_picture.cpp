// SPDX-License-Identifier: GPL-3.0-or-later
#include "symmetry_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "hyperex/render/canvas.hpp"

namespace hyperex::cli {
namespace {

struct Line {
  const std::vector<double>& values;
  render::Colour colour;
  std::string name;
};

struct Panel {
  double x, y, width, height;
  render::Range time, range;
  std::string label;
};

// The values' interval, widened by a twentieth.
render::Range span_of(const std::vector<Line>& lines) {
  render::Range range{INFINITY, -INFINITY};
  for (const Line& line : lines)
    for (const double value : line.values)
      if (!std::isnan(value)) {
        range.low = std::min(range.low, value);
        range.high = std::max(range.high, value);
      }
  if (!(range.low <= range.high)) return {0, 1};
  const double pad = std::max(0.05 * (range.high - range.low), 1e-6);
  return {range.low - pad, range.high + pad};
}

void draw_axes(render::Canvas& canvas, const Panel& panel) {
  const render::Colour grid{0.86, 0.86, 0.87};
  const render::TextStyle small{.size_px = 12, .colour = render::palette::faint_ink};
  canvas.rectangle(panel.x, panel.y, panel.width, panel.height, {1, 1, 1});
  for (const double value : render::ticks(panel.range, 5)) {
    const double y = panel.y + panel.height * (1 - render::share_in(panel.range, value));
    canvas.line(panel.x, y, panel.x + panel.width, y, grid);
    render::TextStyle right = small;
    right.align = render::Align::right;
    canvas.text(panel.x - 8, y + 4, fmt::format("{:.4g}", value), right);
  }
  for (const double value : render::ticks(panel.time, 8)) {
    const double x = panel.x + panel.width * render::share_in(panel.time, value);
    canvas.line(x, panel.y, x, panel.y + panel.height, grid);
    render::TextStyle centred = small;
    centred.align = render::Align::centre;
    canvas.text(x, panel.y + panel.height + 16, fmt::format("{:.4g}", value), centred);
  }
  canvas.text(panel.x, panel.y - 8, panel.label, {.size_px = 13});
}

void draw_lines(render::Canvas& canvas, const Panel& panel, const std::vector<double>& time_s,
                const std::vector<Line>& lines) {
  double legend = panel.x + panel.width;
  for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
    for (size_t i = 1; i < time_s.size(); ++i) {
      const double values[2] = {line->values[i - 1], line->values[i]};
      if (std::isnan(values[0]) || std::isnan(values[1])) continue;
      double x[2], y[2];
      for (int k = 0; k < 2; ++k) {
        x[k] = panel.x + panel.width * render::share_in(panel.time, time_s[i - 1 + k]);
        y[k] = panel.y + panel.height * (1 - render::share_in(panel.range, values[k]));
      }
      canvas.line(x[0], y[0], x[1], y[1], line->colour, 2);
    }
    if (line->name.empty()) continue;
    legend -= canvas.text(legend, panel.y - 8, line->name,
                          {.size_px = 13, .colour = line->colour, .align = render::Align::right}) +
              16;
  }
}

/// What lies under the noise floor, shaded, and the floor itself.
void draw_floor(render::Canvas& canvas, const Panel& panel, const std::vector<double>& time_s,
                const std::vector<double>& floor) {
  const render::Colour shade{0.93, 0.91, 0.86};
  const double bottom = panel.y + panel.height;
  for (size_t i = 1; i < time_s.size(); ++i) {
    if (std::isnan(floor[i - 1]) || std::isnan(floor[i])) continue;
    const double from = panel.x + panel.width * render::share_in(panel.time, time_s[i - 1]);
    const double to = panel.x + panel.width * render::share_in(panel.time, time_s[i]);
    const double mean = 0.5 * (floor[i - 1] + floor[i]);
    const double top = panel.y + panel.height * (1 - render::share_in(panel.range, mean));
    canvas.rectangle(from, top, to - from + 0.5, bottom - top, shade);
  }
}

std::vector<metrics::PairExcursion> farthest(const metrics::Excursions& excursions) {
  constexpr size_t most = 10;
  const auto reach = [](const metrics::PairExcursion& p) {
    return std::max(p.left_side.excursion_mm, p.right_side.excursion_mm);
  };
  std::vector<metrics::PairExcursion> pairs = excursions.pairs;
  std::stable_sort(pairs.begin(), pairs.end(),
                   [&](const auto& a, const auto& b) { return reach(a) > reach(b); });
  // A landmark under two names, cheilion and ibug68_48/54, is drawn once.
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
  constexpr double x = 250, width = 440, bar = 9;
  double top = 0.1;
  for (const auto& p : pairs)
    top = std::max({top, p.left_side.excursion_mm, p.right_side.excursion_mm});
  canvas.text(70, y, "Excursion, largest distance from rest (mm)", {.size_px = 13});
  double legend = x + width;
  legend -=
      canvas.text(legend, y, "right",
                  {.size_px = 13, .colour = render::palette::held, .align = render::Align::right}) +
      16;
  canvas.text(legend, y, "left",
              {.size_px = 13, .colour = render::palette::driven, .align = render::Align::right});
  canvas.text(870, y, "R/L", {.size_px = 13, .align = render::Align::right});
  for (const auto& p : pairs) {
    y += 27;
    canvas.text(x - 10, y + 4, p.name, {.size_px = 12, .align = render::Align::right});
    for (const bool left : {true, false}) {
      const double mm = (left ? p.left_side : p.right_side).excursion_mm;
      const double bar_y = y - bar + (left ? 0 : bar + 1);
      canvas.rectangle(x, bar_y, width * mm / top, bar,
                       left ? render::palette::driven : render::palette::held);
      canvas.text(x + width * mm / top + 6, bar_y + bar, fmt::format("{:.2f}", mm),
                  {.size_px = 10, .colour = render::palette::faint_ink});
    }
    const std::string ratio = p.undecided ? "undecided"
                              : std::isfinite(p.excursion_ratio)
                                  ? fmt::format("{:.2f}", p.excursion_ratio)
                                  : "-";
    canvas.text(870, y + 4, ratio, {.size_px = 12, .align = render::Align::right});
  }
}

}  // namespace

render::Image draw(const metrics::SymmetryMeasures& measures, const std::string& title) {
  const metrics::SymmetryCurve& curve = measures.curve;
  const auto pairs = farthest(measures.excursions);
  const double bars = 700, end = bars + 27 * static_cast<double>(pairs.size()) + 24;
  render::Canvas canvas(900, static_cast<int>(end) + 24);
  canvas.text(70, 42, title, {.size_px = 20, .bold = true});
  const render::Range time{curve.time_s.front(),
                           std::max(curve.time_s.back(), curve.time_s.front() + 1e-3)};
  std::vector<double> floor;
  for (const double value : curve.noise) floor.push_back(std::log(value));
  const std::vector<Line> sides = {{curve.xi_left, render::palette::driven, "left"},
                                   {curve.xi_right, render::palette::held, "right"}};
  std::vector<Line> s = {{curve.s, render::palette::ink, ""}};
  if (!floor.empty())
    s.push_back({floor, render::palette::cut,
                 fmt::format("noise floor of {:.2g} mm jitter; below it: undecided",
                             1e3 * curve.jitter_m)});
  const Panel upper{70, 90, 800, 230, time, span_of(sides), "xi, relative change of length"};
  const std::string label = fmt::format(
      "S = ln |xi_L - xi_R|, not below {:.2f}; smaller is more "
      "symmetric",
      std::log(curve.floor));
  const Panel lower{70, 380, 800, 230, time, span_of(s), label};
  draw_axes(canvas, upper);
  draw_lines(canvas, upper, curve.time_s, sides);
  draw_axes(canvas, lower);
  if (!floor.empty()) draw_floor(canvas, lower, curve.time_s, floor);
  draw_lines(canvas, lower, curve.time_s, s);
  canvas.text(470, 648, "time (s)", {.size_px = 13, .align = render::Align::centre});
  if (!pairs.empty()) draw_bars(canvas, bars, pairs);
  canvas.text(70, end + 10, "No medical device: these figures diagnose nothing.",
              {.size_px = 12, .colour = render::palette::faint_ink});
  return canvas.image();
}

}  // namespace hyperex::cli
