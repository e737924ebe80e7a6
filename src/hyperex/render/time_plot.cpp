// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/render/time_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hyperex::render {
namespace {

double place_x(const TimePlot& plot, double time) {
  return plot.x + plot.width_px * share_in(plot.time, time);
}

double place_y(const TimePlot& plot, double value) {
  return plot.y + plot.height_px * (1 - share_in(plot.range, value));
}

}  // namespace

Range span_of(const std::vector<PlotCurve>& curves) {
  Range range{INFINITY, -INFINITY};
  for (const PlotCurve& curve : curves)
    for (const double value : curve.values)
      if (!std::isnan(value)) {
        range.low = std::min(range.low, value);
        range.high = std::max(range.high, value);
      }
  if (!(range.low <= range.high)) return {0, 1};
  const double pad = std::max(0.05 * (range.high - range.low), 1e-6);
  return {range.low - pad, range.high + pad};
}

void draw_axes(Canvas& canvas, const TimePlot& plot) {
  const Colour grid{0.86, 0.86, 0.87};
  const TextStyle right{.size_px = 12, .colour = palette::faint_ink, .align = Align::right};
  const TextStyle centred{.size_px = 12, .colour = palette::faint_ink, .align = Align::centre};
  canvas.rectangle(plot.x, plot.y, plot.width_px, plot.height_px, {1, 1, 1});
  if (plot.marked.high > plot.marked.low)
    canvas.rectangle(place_x(plot, plot.marked.low), plot.y,
                     place_x(plot, plot.marked.high) - place_x(plot, plot.marked.low),
                     plot.height_px, {0.93, 0.93, 0.89});
  for (const double value : ticks(plot.range, 5)) {
    const double y = place_y(plot, value);
    canvas.line(plot.x, y, plot.x + plot.width_px, y, grid);
    canvas.text(plot.x - 8, y + 4, fmt::format("{:.4g}", value), right);
  }
  for (const double value : ticks(plot.time, 8)) {
    const double x = place_x(plot, value);
    canvas.line(x, plot.y, x, plot.y + plot.height_px, grid);
    canvas.text(x, plot.y + plot.height_px + 16, fmt::format("{:.4g}", value), centred);
  }
  canvas.text(plot.x, plot.y - 8, plot.label, {.size_px = 13});
}

void draw_curves(Canvas& canvas, const TimePlot& plot, const std::vector<double>& time,
                 const std::vector<PlotCurve>& curves) {
  double legend = plot.x + plot.width_px;
  for (auto curve = curves.rbegin(); curve != curves.rend(); ++curve) {
    for (std::size_t i = 1; i < time.size(); ++i) {
      const double from = curve->values[i - 1], to = curve->values[i];
      const auto shown = [&](double v) { return v >= plot.range.low && v <= plot.range.high; };
      if (!shown(from) || !shown(to)) continue;  // true for a gap too
      canvas.line(place_x(plot, time[i - 1]), place_y(plot, from), place_x(plot, time[i]),
                  place_y(plot, to), curve->colour, 2);
    }
    if (curve->name.empty()) continue;
    legend -= canvas.text(legend, plot.y - 8, curve->name,
                          {.size_px = 13, .colour = curve->colour, .align = Align::right}) +
              16;
  }
}

void shade_under(Canvas& canvas, const TimePlot& plot, const std::vector<double>& time,
                 const std::vector<double>& values) {
  const Colour shade{0.93, 0.91, 0.86};
  const double bottom = plot.y + plot.height_px;
  for (std::size_t i = 1; i < time.size(); ++i) {
    if (std::isnan(values[i - 1]) || std::isnan(values[i])) continue;
    const double from = place_x(plot, time[i - 1]), to = place_x(plot, time[i]);
    const double top = place_y(plot, 0.5 * (values[i - 1] + values[i]));
    canvas.rectangle(from, top, to - from + 0.5, bottom - top, shade);
  }
}

Colour category_colour(std::size_t index, bool dark) {
  static constexpr std::array<int, category_count> on_light = {
      0x0072b2, 0xd55e00, 0x009e73, 0xb0569b, 0xb58900, 0x2f9bd0, 0x7a5230, 0x666666};
  static constexpr std::array<int, category_count> on_dark = {
      0x56b4e9, 0xff9248, 0x3ad6a4, 0xe497c9, 0xf0e442, 0x9ecbff, 0xd2a679, 0xb0b0b0};
  const int c = (dark ? on_dark : on_light)[index % category_count];
  return {(c >> 16 & 0xff) / 255.0, (c >> 8 & 0xff) / 255.0, (c & 0xff) / 255.0};
}

std::size_t face_category(std::size_t face) {
  // The base case is grey. Faces from the seventh on reuse the sides' colours, since there are no
  // others.
  static constexpr std::array<std::size_t, category_count> order = {
      7, 2, 3, 4, 6, 5, left_category, right_category};
  return order[face % category_count];
}

}  // namespace hyperex::render
