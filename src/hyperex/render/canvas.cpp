// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/render/canvas.hpp"

#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace hyperex::render {

Image::Image(int width_px, int height_px, const Colour& fill)
    : width(width_px), height(height_px), rgb(3 * std::size_t(width_px) * height_px) {
  const std::uint8_t bytes[3] = {static_cast<std::uint8_t>(std::lround(255 * fill.r)),
                                 static_cast<std::uint8_t>(std::lround(255 * fill.g)),
                                 static_cast<std::uint8_t>(std::lround(255 * fill.b))};
  for (std::size_t i = 0; i < rgb.size(); i += 3) std::copy_n(bytes, 3, rgb.data() + i);
}

struct Canvas::Impl {
  cairo_surface_t* surface;
  cairo_t* cairo;

  Impl(int width_px, int height_px)
      : surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_px, height_px)),
        cairo(cairo_create(surface)) {
    if (cairo_status(cairo) != CAIRO_STATUS_SUCCESS)
      throw std::invalid_argument(
          fmt::format("render: no picture of {} x {} pixels can be made", width_px, height_px));
  }
  ~Impl() {
    cairo_destroy(cairo);
    cairo_surface_destroy(surface);
  }
  void colour(const Colour& c) const { cairo_set_source_rgb(cairo, c.r, c.g, c.b); }
  void font(const TextStyle& style) const {
    cairo_select_font_face(cairo, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo, style.size_px);
  }
};

Canvas::Canvas(int width_px, int height_px, const Colour& background)
    : impl_(std::make_unique<Impl>(width_px, height_px)) {
  impl_->colour(background);
  cairo_paint(impl_->cairo);
}

Canvas::Canvas(const Image& image) : impl_(std::make_unique<Impl>(image.width, image.height)) {
  draw(image, 0, 0);
}

Canvas::~Canvas() = default;

int Canvas::width() const {
  return cairo_image_surface_get_width(impl_->surface);
}
int Canvas::height() const {
  return cairo_image_surface_get_height(impl_->surface);
}

void Canvas::line(double x0, double y0, double x1, double y1, const Colour& colour,
                  double width_px) {
  impl_->colour(colour);
  cairo_set_line_width(impl_->cairo, width_px);
  cairo_set_line_cap(impl_->cairo, CAIRO_LINE_CAP_ROUND);
  cairo_move_to(impl_->cairo, x0, y0);
  cairo_line_to(impl_->cairo, x1, y1);
  cairo_stroke(impl_->cairo);
}

void Canvas::disc(double x, double y, double radius_px, const Colour& colour) {
  impl_->colour(colour);
  cairo_new_path(impl_->cairo);
  cairo_arc(impl_->cairo, x, y, radius_px, 0, 2 * M_PI);
  cairo_fill(impl_->cairo);
}

void Canvas::rectangle(double x, double y, double width_px, double height_px,
                       const Colour& colour) {
  impl_->colour(colour);
  cairo_rectangle(impl_->cairo, x, y, width_px, height_px);
  cairo_fill(impl_->cairo);
}

void Canvas::fill(const std::vector<std::array<Eigen::Vector2d, 4>>& cells, const Colour& colour,
                  double opacity) {
  cairo_set_source_rgba(impl_->cairo, colour.r, colour.g, colour.b, opacity);
  cairo_new_path(impl_->cairo);
  for (auto corners : cells) {
    // Cells of opposite orientation that overlap would cancel.
    const Eigen::Vector2d a = corners[2] - corners[0], b = corners[3] - corners[1];
    if (a.x() * b.y() < a.y() * b.x()) std::ranges::reverse(corners);
    cairo_move_to(impl_->cairo, corners[0].x(), corners[0].y());
    for (std::size_t k = 1; k < corners.size(); ++k)
      cairo_line_to(impl_->cairo, corners[k].x(), corners[k].y());
    cairo_close_path(impl_->cairo);
  }
  cairo_fill(impl_->cairo);
}

double Canvas::text_width(const std::string& utf8, const TextStyle& style) const {
  impl_->font(style);
  cairo_text_extents_t extents;
  cairo_text_extents(impl_->cairo, utf8.c_str(), &extents);
  return extents.x_advance;
}

double Canvas::text(double x, double y, const std::string& utf8, const TextStyle& style) {
  const double width_px = text_width(utf8, style);
  if (style.align == Align::centre) x -= width_px / 2;
  if (style.align == Align::right) x -= width_px;
  impl_->colour(style.colour);
  cairo_move_to(impl_->cairo, x, y);
  cairo_show_text(impl_->cairo, utf8.c_str());
  cairo_new_path(impl_->cairo);
  return width_px;
}

void Canvas::draw(const Image& image, int x, int y) {
  cairo_surface_flush(impl_->surface);
  unsigned char* data = cairo_image_surface_get_data(impl_->surface);
  const int stride = cairo_image_surface_get_stride(impl_->surface);
  for (int row = std::max(0, -y); row < std::min(image.height, height() - y); ++row)
    for (int column = std::max(0, -x); column < std::min(image.width, width() - x); ++column) {
      const std::uint8_t* from = image.pixel(column, row);
      const std::uint32_t packed = 0xff000000u | from[0] << 16 | from[1] << 8 | from[2];
      std::memcpy(data + std::ptrdiff_t(y + row) * stride + 4 * (x + column), &packed, 4);
    }
  cairo_surface_mark_dirty(impl_->surface);
}

Image Canvas::image() const {
  cairo_surface_flush(impl_->surface);
  Image out(width(), height());
  const unsigned char* data = cairo_image_surface_get_data(impl_->surface);
  const int stride = cairo_image_surface_get_stride(impl_->surface);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      std::uint32_t packed;
      std::memcpy(&packed, data + std::ptrdiff_t(y) * stride + 4 * x, 4);
      for (int k = 0; k < 3; ++k)
        out.pixel(x, y)[k] = static_cast<std::uint8_t>(packed >> (16 - 8 * k));
    }
  return out;
}

std::vector<double> ticks(const Range& range, int wanted) {
  const double rough = (range.high - range.low) / std::max(1, wanted);
  if (!(rough > 0) || !std::isfinite(rough)) return {range.low};
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10 * decade;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * decade >= rough * (1 - 1e-9)) step = factor * decade;
  std::vector<double> values;
  const double slack = 1e-9 * step;
  for (double k = std::ceil((range.low - slack) / step); k * step <= range.high + slack; ++k)
    values.push_back(k == 0 ? 0 : k * step);
  return values;
}

void Canvas::colour_bar(double x, double y, double height_px, const ColourBar& bar) {
  constexpr double width_px = 16;
  for (int row = 0; row < static_cast<int>(height_px); ++row)
    rectangle(x, y + row, width_px, 1, moss(1 - (row + 0.5) / height_px));
  const TextStyle small{.size_px = 12, .colour = palette::faint_ink};
  text(x, y - 12, bar.label, {.size_px = 12, .colour = palette::ink});
  const std::vector<double> values = ticks(bar.range, 6);
  const double step = values.size() > 1 ? values[1] - values[0] : 1;
  const int decimals = std::clamp(-static_cast<int>(std::floor(std::log10(step) + 1e-9)), 0, 9);
  for (const double value : values) {
    const double at = y + height_px * (1 - share_in(bar.range, value));
    line(x + width_px, at, x + width_px + 4, at, palette::faint_ink, 1);
    const bool top = bar.open_end && value > bar.range.high - 1e-6 * step;
    text(x + width_px + 8, at + 4, fmt::format("{}{:.{}f}", top ? "\u2265 " : "", value, decimals),
         small);
  }
}

}  // namespace hyperex::render
