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
  std::string name;  ///< in the legend; empty: not in the legend
};

/// Curves over time in a rectangle of a canvas.
struct TimePlot {
  double x, y, width_px, height_px;  ///< of the rectangle; ticks left of it and below
  Range time, range;
  std::string label;   ///< above it, on the left; the legend stands on the right
  Range marked{0, 0};  ///< a time interval that is shaded; none where empty
};

/// The interval of all values, widened by a twentieth; 0 to 1 where there are no values.
Range span_of(const std::vector<PlotCurve>& curves);

/// Draws background, grid, ticks and label.
void draw_axes(Canvas& canvas, const TimePlot& plot);

/// Each curve has one value per time. The first curve is drawn last, over the others. Parts outside
/// the plot's range are not drawn.
void draw_curves(Canvas& canvas, const TimePlot& plot, const std::vector<double>& time,
                 const std::vector<PlotCurve>& curves);

/// Shades the area under `values`, where curves are below the noise.
void shade_under(Canvas& canvas, const TimePlot& plot, const std::vector<double>& time,
                 const std::vector<double>& values);

/// Colours that distinguish categories, also for colour-blind readers, after M. Okabe and K. Ito.
/// `dark`: lighter ones, for a dark background. The pages get the same colours
/// (report/page_data.cpp).
Colour category_colour(std::size_t index, bool dark = false);
inline constexpr std::size_t category_count = 8;

/// The categories of the subject's own sides, the same in every picture and page: blue and orange.
inline constexpr std::size_t left_category = 0, right_category = 1;
inline Colour left_colour() {
  return category_colour(left_category);
}
inline Colour right_colour() {
  return category_colour(right_category);
}

/// Category of the base case (0) or a variant. Categories that are not used for a side come first.
std::size_t face_category(std::size_t face);
inline Colour face_colour(std::size_t face) {
  return category_colour(face_category(face));
}

}  // namespace hyperex::render
