// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "hyperex/render/colour.hpp"
#include "hyperex/render/image.hpp"

namespace hyperex::render {

enum class Align { left, centre, right };

struct TextStyle {
  double size_px = 14;
  Colour colour = palette::ink;
  Align align = Align::left;
  bool bold = false;
};

/// A vertical colour scale of the map moss, with ticks at round numbers.
struct ColourBar {
  Range range;
  std::string label;      ///< above the bar, with the unit: "distance (mm)"
  bool open_end = false;  ///< some values exceed the top; they have its colour, and a mark shows it
};

/// Round tick values (steps of 1, 2 or 5 times a power of ten) within `range`, about `wanted`.
std::vector<double> ticks(const Range& range, int wanted);

/// A picture to draw on (cairo), in pixels, y down. Text is DejaVu Sans or the system's sans serif.
class Canvas {
 public:
  Canvas(int width_px, int height_px, const Colour& background = palette::background);
  explicit Canvas(const Image& image);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  int width() const;
  int height() const;
  void line(double x0, double y0, double x1, double y1, const Colour& colour, double width_px = 1);
  void disc(double x, double y, double radius_px, const Colour& colour);
  void rectangle(double x, double y, double width_px, double height_px, const Colour& colour);
  /// Fills all of these quadrilaterals (corners in order) at once, so that no seam shows between
  /// neighbours. `opacity`: 0 to 1.
  void fill(const std::vector<std::array<Eigen::Vector2d, 4>>& cells, const Colour& colour,
            double opacity);
  /// `y` is the base line. Returns the width of the text in pixels.
  double text(double x, double y, const std::string& utf8, const TextStyle& style = {});
  double text_width(const std::string& utf8, const TextStyle& style = {}) const;
  void draw(const Image& image, int x, int y);
  /// The bar is 16 px wide, with its ticks to the right (about 60 px). The label is above y and
  /// needs about 20 px there.
  void colour_bar(double x, double y, double height_px, const ColourBar& bar);
  Image image() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex::render
