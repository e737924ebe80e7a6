// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/face/paint.hpp"

#include <cmath>

#include "hyperex/geometry/smooth_step.hpp"

namespace hyperex::face {
namespace {

/// A number for each whole place, -1 to 1.
double at_corner(int x, int y) {
  auto h = std::uint32_t(x) * 374761393U + std::uint32_t(y) * 668265263U;
  h = (h ^ (h >> 13)) * 1274126177U;
  return double((h ^ (h >> 16)) & 0xffffU) / 32767.5 - 1;
}

struct Nearest {
  double distance_mm;
  double along;  ///< share of the pieces passed, 0 to 1
};

Nearest nearest_on(const std::vector<Place>& line, bool closed, const Place& p) {
  Nearest best{INFINITY, 0};
  const std::size_t pieces = line.size() - (closed ? 0 : 1);
  for (std::size_t i = 0; i < pieces; ++i) {
    const Place a = line[i], d = line[(i + 1) % line.size()] - a;
    const double t = std::clamp((p - a).dot(d) / std::max(d.squaredNorm(), 1e-18), 0.0, 1.0);
    const double distance_mm = kMillimetres * (p - a - t * d).norm();
    if (distance_mm < best.distance_mm) best = {distance_mm, (double(i) + t) / double(pieces)};
  }
  return best;
}

bool is_inside(const std::vector<Place>& loop, const Place& p) {
  bool inside = false;
  for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++)
    if ((loop[i].y() > p.y()) != (loop[j].y() > p.y()) &&
        p.x() < (loop[j].x() - loop[i].x()) * (p.y() - loop[i].y()) / (loop[j].y() - loop[i].y()) +
                    loop[i].x())
      inside = !inside;
  return inside;
}

/// Between b and c.
Place on_curve(const Place& a, const Place& b, const Place& c, const Place& d, double t) {
  return 0.5 * (2 * b + t * (c - a) + t * t * (2 * a - 5 * b + 4 * c - d) +
                t * t * t * (3 * b - 3 * c + d - a));
}

}  // namespace

double noise(const Place& at) {
  const double fx = std::floor(at.x()), fy = std::floor(at.y());
  const int x = int(fx), y = int(fy);
  const double u = smooth_step(at.x() - fx), v = smooth_step(at.y() - fy);
  return std::lerp(std::lerp(at_corner(x, y), at_corner(x + 1, y), u),
                   std::lerp(at_corner(x, y + 1), at_corner(x + 1, y + 1), u), v);
}

std::vector<Place> smooth_line(const std::vector<Place>& points, int each) {
  std::vector<Place> out;
  const std::size_t last = points.size() - 1;
  for (std::size_t i = 0; i < last; ++i)
    for (int k = 0; k < each; ++k)
      out.push_back(on_curve(points[i > 0 ? i - 1 : 0], points[i], points[i + 1],
                             points[std::min(i + 2, last)], double(k) / each));
  out.push_back(points.back());
  return out;
}

std::vector<Place> smooth_loop(const std::vector<Place>& points, int each) {
  std::vector<Place> out;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i)
    for (int k = 0; k < each; ++k)
      out.push_back(on_curve(points[(i + n - 1) % n], points[i], points[(i + 1) % n],
                             points[(i + 2) % n], double(k) / each));
  return out;
}

Canvas::Canvas(int size_px, const Rgb& colour)
    : size_(size_px), pixels_(std::size_t(size_px) * std::size_t(size_px), colour) {}

std::vector<std::uint8_t> Canvas::bytes() const {
  std::vector<std::uint8_t> out;
  out.reserve(3 * pixels_.size());
  for (const Rgb& pixel : pixels_)
    for (const double value : pixel)
      out.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0))));
  return out;
}

void Canvas::each(const std::function<void(Place, Rgb&)>& change) {
  around({{0, 0}, {1, 1}}, 0, change);
}

void Canvas::around(const std::vector<Place>& points, double margin_mm,
                    const std::function<void(Place, Rgb&)>& change) {
  Place low = points.front(), high = low;
  for (const Place& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double margin = margin_mm / kMillimetres;
  const auto pixel = [&](double at) {
    return std::clamp(int(std::floor(at * size_)), 0, size_ - 1);
  };
  for (int y = pixel(low.y() - margin); y <= pixel(high.y() + margin); ++y)
    for (int x = pixel(low.x() - margin); x <= pixel(high.x() + margin); ++x)
      change(Place(x + 0.5, y + 0.5) / size_,
             pixels_[std::size_t(y) * std::size_t(size_) + std::size_t(x)]);
}

void Canvas::blend_spot(const Place& at, double across_mm, double down_mm, const Rgb& colour,
                        double share) {
  around({at}, 2.2 * std::max(across_mm, down_mm), [&](Place p, Rgb& pixel) {
    const Place off = kMillimetres * (p - at);
    const double square = std::pow(off.x() / across_mm, 2) + std::pow(off.y() / down_mm, 2);
    pixel = mixed(pixel, colour, share * std::exp(-2 * square));
  });
}

void Canvas::blend_near(const std::vector<Place>& line, double width_mm, const Rgb& colour,
                        double share) {
  around(line, width_mm, [&](Place p, Rgb& pixel) {
    const double near = 1 - nearest_on(line, true, p).distance_mm / width_mm;
    if (near > 0) pixel = mixed(pixel, colour, share * smooth_step(near));
  });
}

void Canvas::fill_loop(const std::vector<Place>& loop, double edge_mm,
                       const std::function<Rgb(Place, Rgb)>& paint) {
  around(loop, edge_mm, [&](Place p, Rgb& pixel) {
    const double distance_mm = nearest_on(loop, true, p).distance_mm;
    const double inside_mm = is_inside(loop, p) ? distance_mm : -distance_mm;
    const double share = smooth_step(0.5 + inside_mm / edge_mm);
    if (share > 0) pixel = mixed(pixel, paint(p, pixel), share);
  });
}

void Canvas::stroke(const std::vector<Place>& line, double width_mm, const Rgb& colour,
                    double share) {
  // A pixel is wider than a hair: what it covers of the pixel is what counts.
  const double pixel_mm = kMillimetres / size_;
  around(line, width_mm + pixel_mm, [&](Place p, Rgb& pixel) {
    const auto [distance_mm, along] = nearest_on(line, false, p);
    const double half_mm = 0.5 * width_mm * (1 - 0.7 * along);
    const double covered =
        std::clamp((half_mm + 0.5 * pixel_mm - distance_mm) / pixel_mm, 0.0, 1.0);
    if (covered > 0) pixel = mixed(pixel, colour, share * covered);
  });
}

}  // namespace hyperex::face
