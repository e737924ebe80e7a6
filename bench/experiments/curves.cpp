// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiments/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hyperex::bench {
namespace {

constexpr double kWidth = 420, kHeight = 260, kLeft = 72, kTop = 62, kRight = 22, kBottom = 58;

void draw_panel(render::Canvas& canvas, const CurvePanel& panel, double left, double top) {
  const double x0 = left + kLeft, y0 = top + kTop;
  const render::TextStyle small{.size_px = 12, .colour = render::palette::faint_ink};
  render::TextStyle right = small, centred = small;
  right.align = render::Align::right;
  centred.align = render::Align::centre;
  double end_s = 0;
  for (const Curve& curve : panel.curves) end_s = std::max(end_s, curve.time_s.back());
  const render::Range time{0, end_s};
  const auto x_of = [&](double t) { return x0 + kWidth * render::share_in(time, t); };
  const auto y_of = [&](double v) { return y0 + kHeight * (1 - render::share_in(panel.range, v)); };

  canvas.rectangle(x0, y0, kWidth, kHeight, {1, 1, 1});
  if (panel.marked.high > panel.marked.low)
    canvas.rectangle(x_of(panel.marked.low), y0, x_of(panel.marked.high) - x_of(panel.marked.low),
                     kHeight, {0.93, 0.93, 0.89});
  for (const double v : render::ticks(panel.range, 6)) {
    canvas.line(x0, y_of(v), x0 + kWidth, y_of(v), {0.87, 0.87, 0.88});
    canvas.text(x0 - 8, y_of(v) + 4, fmt::format("{:.4g}", v), right);
  }
  for (const double t : render::ticks(time, 7)) {
    canvas.line(x_of(t), y0 + kHeight, x_of(t), y0 + kHeight + 4, render::palette::faint_ink);
    canvas.text(x_of(t), y0 + kHeight + 18, fmt::format("{:.4g}", t), centred);
  }
  canvas.text(x0 + kWidth / 2, y0 + kHeight + 38, "time (s)", centred);
  canvas.text(x0, y0 - 34, panel.title, {.size_px = 15, .bold = true});
  canvas.text(x0, y0 - 12, panel.unit, small);
  double legend =
      panel.legend_on_top ? y0 + 3 + 17.0 * double(panel.curves.size()) : y0 + kHeight - 12;
  for (auto curve = panel.curves.rbegin(); curve != panel.curves.rend(); ++curve) {
    for (std::size_t i = 1; i < curve->time_s.size(); ++i) {
      const double a = curve->value[i - 1], b = curve->value[i];
      const auto inside = [&](double v) { return v >= panel.range.low && v <= panel.range.high; };
      if (inside(a) && inside(b))
        canvas.line(x_of(curve->time_s[i - 1]), y_of(a), x_of(curve->time_s[i]), y_of(b),
                    curve->colour, 2);
    }
    if (curve->name.empty()) continue;
    render::TextStyle name{.size_px = 12, .colour = curve->colour, .bold = true};
    name.align = panel.legend_on_top ? render::Align::left : render::Align::right;
    canvas.text(panel.legend_on_top ? x0 + 10 : x0 + kWidth - 10, legend, curve->name, name);
    legend -= 17;
  }
}

}  // namespace

render::Image draw_curves(const std::vector<CurvePanel>& panels, int columns) {
  const int rows = (int(panels.size()) + columns - 1) / columns;
  const double width = kLeft + kWidth + kRight, height = kTop + kHeight + kBottom;
  render::Canvas canvas(int(columns * width), int(rows * height));
  for (std::size_t i = 0; i < panels.size(); ++i)
    draw_panel(canvas, panels[i], double(int(i) % columns) * width,
               double(int(i) / columns) * height);
  return canvas.image();
}

render::Range range_of(const std::vector<Curve>& curves) {
  double low = INFINITY, high = -INFINITY;
  for (const Curve& curve : curves)
    for (const double v : curve.value)
      if (std::isfinite(v)) {
        low = std::min(low, v);
        high = std::max(high, v);
      }
  if (!(low < high)) return {low - 1, low + 1};
  const double pad = 0.06 * (high - low);
  return {low - pad, high + pad};
}

render::Colour curve_colour(int n) {
  static const render::Colour colours[] = {
      {0, 0, 0}, {0.835, 0.369, 0}, {0, 0.447, 0.698}, {0, 0.62, 0.451}, {0.8, 0.475, 0.655}};
  return colours[n % 5];
}

}  // namespace hyperex::bench
