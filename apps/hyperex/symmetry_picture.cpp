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

}  // namespace

render::Image draw(const metrics::SymmetryCurve& curve, const std::string& title) {
  render::Canvas canvas(900, 660);
  canvas.text(70, 42, title, {.size_px = 20, .bold = true});
  const render::Range time{curve.time_s.front(),
                           std::max(curve.time_s.back(), curve.time_s.front() + 1e-3)};
  const std::vector<Line> sides = {{curve.xi_left, render::palette::driven, "left"},
                                   {curve.xi_right, render::palette::held, "right"}};
  const std::vector<Line> s = {{curve.s, render::palette::ink, ""}};
  const Panel upper{70, 90, 800, 230, time, span_of(sides), "xi, relative change of length"};
  const Panel lower{70,
                    380,
                    800,
                    230,
                    time,
                    span_of(s),
                    fmt::format("S = ln |xi_L - xi_R|, not below {:.2f}; smaller is more symmetric",
                                std::log(curve.floor))};
  draw_axes(canvas, upper);
  draw_lines(canvas, upper, curve.time_s, sides);
  draw_axes(canvas, lower);
  draw_lines(canvas, lower, curve.time_s, s);
  canvas.text(470, 648, "time (s)", {.size_px = 13, .align = render::Align::centre});
  return canvas.image();
}

}  // namespace hyperex::cli
