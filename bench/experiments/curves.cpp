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
  double end_s = 0;
  for (const Curve& curve : panel.curves) end_s = std::max(end_s, curve.time_s.back());
  const render::TimePlot plot{x0, y0, kWidth, kHeight, {0, end_s}, panel.range, "", panel.marked};
  render::draw_axes(canvas, plot);
  canvas.text(
      x0 + kWidth / 2, y0 + kHeight + 38, "time (s)",
      {.size_px = 12, .colour = render::palette::faint_ink, .align = render::Align::centre});
  canvas.text(x0, y0 - 34, panel.title, {.size_px = 15, .bold = true});
  canvas.text(x0, y0 - 12, panel.unit, {.size_px = 12, .colour = render::palette::faint_ink});
  double legend =
      panel.legend_on_top ? y0 + 3 + 17.0 * double(panel.curves.size()) : y0 + kHeight - 12;
  for (auto curve = panel.curves.rbegin(); curve != panel.curves.rend(); ++curve) {
    render::draw_curves(canvas, plot, curve->time_s, {{curve->value, curve->colour, ""}});
    if (curve->name.empty()) continue;
    const auto align = panel.legend_on_top ? render::Align::left : render::Align::right;
    canvas.text(panel.legend_on_top ? x0 + 10 : x0 + kWidth - 10, legend, curve->name,
                {.size_px = 12, .colour = curve->colour, .align = align, .bold = true});
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
  std::vector<render::PlotCurve> plotted;
  for (const Curve& curve : curves) plotted.push_back({curve.value, curve.colour, ""});
  return render::span_of(plotted);
}

}  // namespace hyperex::bench
