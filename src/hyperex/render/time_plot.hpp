// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/render/canvas.hpp"

namespace hyperex::render {

/// A curve of a plot; NaN is a gap.
struct PlotCurve {
  const std::vector<double>& values;
  Colour colour;
  std::string name;  ///< in the legend; left out of it where empty
};

/// Curves over time in a rectangle of a canvas.
struct TimePlot {
  double x, y, width_px, height_px;  ///< of the rectangle; ticks left of it and below
  Range time, range;
  std::string label;   ///< above it, on the left; the legend stands on the right
  Range marked{0, 0};  ///< a stretch of time that is shaded; none where empty
};

/// The interval of all values, widened by a twentieth; 0 to 1 where there are none.
Range span_of(const std::vector<PlotCurve>& curves);

/// Paper, grid, ticks and label.
void draw_axes(Canvas& canvas, const TimePlot& plot);

/// One value per time in each curve; the first is drawn last, over the others. What leaves the
/// plot's range is not drawn.
void draw_curves(Canvas& canvas, const TimePlot& plot, const std::vector<double>& time,
                 const std::vector<PlotCurve>& curves);

/// Shades what lies under `values`: curves there are below the noise.
void shade_under(Canvas& canvas, const TimePlot& plot, const std::vector<double>& time,
                 const std::vector<double>& values);

/// Colours that distinguish things of one kind, for colour-blind readers too, after M. Okabe
/// and K. Ito; `dark`: lighter ones, for dark paper. Written into the pages (report/page_data.cpp).
Colour category_colour(std::size_t index, bool dark = false);
inline constexpr std::size_t category_count = 8;

/// Places of the subject's own sides among the categories, the same in every picture and page: blue
/// and orange.
inline constexpr std::size_t left_category = 0, right_category = 1;
inline Colour left_colour() {
  return category_colour(left_category);
}
inline Colour right_colour() {
  return category_colour(right_category);
}

/// Category of base (0) or a variant: the categories that are not a side's come first.
std::size_t face_category(std::size_t face);
inline Colour face_colour(std::size_t face) {
  return category_colour(face_category(face));
}

}  // namespace hyperex::render
