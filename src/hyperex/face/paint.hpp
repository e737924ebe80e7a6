// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Internal to the room: soft shapes painted on a square picture.
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace hyperex::face {

using Rgb = std::array<double, 3>;  ///< sRGB, 0 to 255
using Place = Eigen::Vector2d;      ///< across and down, 0 to 1 over the picture

/// Millimetres per unit of the canonical face's texture coordinates: half of its edges have 220 to
/// 256.
inline constexpr double kMillimetres = 235;

inline Rgb mixed(const Rgb& a, const Rgb& b, double share) {
  return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])};
}
inline Rgb scaled(const Rgb& a, double by) {
  return {a[0] * by, a[1] * by, a[2] * by};
}

/// Pseudo-random numbers from 0 to 1, the same on every machine.
class Random {
 public:
  explicit Random(std::uint32_t seed) : state_(seed * 2654435761U + 12345U) {}
  double next() {
    state_ = state_ * 1664525U + 1013904223U;
    return double(state_ >> 8) / double(1 << 24);
  }

 private:
  std::uint32_t state_;
};

/// Smooth noise from -1 to 1, with a wavelength of about one unit.
double noise(const Place& at);

/// A curve through all points, with `each` places from one to the next (Catmull-Rom spline).
std::vector<Place> smooth_line(const std::vector<Place>& points, int each);
std::vector<Place> smooth_loop(const std::vector<Place>& points, int each);

class Canvas {
 public:
  Canvas(int size_px, const Rgb& colour);

  std::vector<std::uint8_t> bytes() const;

  /// Calls `change` with the centre and the colour of every pixel.
  void each(const std::function<void(Place, Rgb&)>& change);
  /// An ellipse whose opacity decreases with distance from `share` to a seventh of it at the given
  /// widths (mm).
  void blend_spot(const Place& at, double across_mm, double down_mm, const Rgb& colour,
                  double share);
  /// Opacity decreases to 0 at `width_mm` from the line.
  void blend_near(const std::vector<Place>& line, double width_mm, const Rgb& colour, double share);
  /// Applies `paint` to the pixels inside a closed line, with a transition of `edge_mm` at the
  /// line.
  void fill_loop(const std::vector<Place>& loop, double edge_mm,
                 const std::function<Rgb(Place, Rgb)>& paint);
  /// A line whose width decreases to 0 at its end.
  void stroke(const std::vector<Place>& line, double width_mm, const Rgb& colour, double share);

 private:
  /// Calls `change` for the pixels within `margin_mm` of the points' bounding box.
  void around(const std::vector<Place>& points, double margin_mm,
              const std::function<void(Place, Rgb&)>& change);

  int size_;
  std::vector<Rgb> pixels_;
};

}  // namespace hyperex::face
