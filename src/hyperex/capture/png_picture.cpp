// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/png_picture.hpp"

#include <png.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace hyperex::capture {
namespace {

/// On failure, libpng leaves by longjmp. Objects with destructors must therefore not be created
/// after the call of setjmp; they are members of this struct and of Writing.
struct Reading {
  std::span<const unsigned char> left;
  PngPicture result;
  std::vector<png_bytep> rows;
};

void fail(png_structp png, png_const_charp words) {
  static_cast<Reading*>(png_get_error_ptr(png))->result.fault = words;
  png_longjmp(png, 1);
}
void keep_quiet(png_structp, png_const_charp) {}

void give_bytes(png_structp png, png_bytep to, std::size_t count) {
  auto& left = static_cast<Reading*>(png_get_io_ptr(png))->left;
  if (count > left.size()) png_error(png, "ends too early");
  std::memcpy(to, left.data(), count);
  left = left.subspan(count);
}

void to_bgr(png_structp png, png_infop info) {
  const int colours = png_get_color_type(png, info);
  png_set_expand(png);  // palettes, fewer than 8 bits, a transparent colour
  if (png_get_bit_depth(png, info) == 16) png_set_scale_16(png);
  if ((colours & PNG_COLOR_MASK_COLOR) == 0) png_set_gray_to_rgb(png);
  png_set_strip_alpha(png);
  png_set_bgr(png);
}

void to_stored_grey(png_structp png, png_infop info) {
  if (png_get_color_type(png, info) == PNG_COLOR_TYPE_GRAY && png_get_bit_depth(png, info) == 16) {
    png_set_swap(png);  // stored with the high byte first
    return;
  }
  to_bgr(png, info);
}

void read(png_structp png, png_infop info, PngAs as, double most_pixels, Reading& reading) {
  png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
  png_set_read_fn(png, &reading, give_bytes);
  png_read_info(png, info);
  const auto width = png_get_image_width(png, info), height = png_get_image_height(png, info);
  if (double(width) * height > most_pixels) png_error(png, "size beyond reason");
  as == PngAs::bgr ? to_bgr(png, info) : to_stored_grey(png, info);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  const int channels = png_get_channels(png, info);
  const int depth = png_get_bit_depth(png, info) == 16 ? CV_16U : CV_8U;
  reading.result.picture.create(int(height), int(width), CV_MAKETYPE(depth, channels));
  reading.rows.resize(height);
  for (png_uint_32 y = 0; y < height; ++y) reading.rows[y] = reading.result.picture.ptr(int(y));
  png_read_image(png, reading.rows.data());
  png_read_end(png, nullptr);
}

struct Writing {
  std::string bytes, fault;
};

void fail_writing(png_structp png, png_const_charp words) {
  static_cast<Writing*>(png_get_error_ptr(png))->fault = words;
  png_longjmp(png, 1);
}
void take_bytes(png_structp png, png_bytep from, std::size_t count) {
  static_cast<Writing*>(png_get_io_ptr(png))
      ->bytes.append(reinterpret_cast<const char*>(from), count);
}
void no_flush(png_structp) {}

void write(png_structp png, png_infop info, const cv::Mat& grey, Writing& writing) {
  png_set_write_fn(png, &writing, take_bytes, no_flush);
  png_set_IHDR(png, info, png_uint_32(grey.cols), png_uint_32(grey.rows), 16, PNG_COLOR_TYPE_GRAY,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  png_set_swap(png);  // stored with the high byte first
  for (int y = 0; y < grey.rows; ++y) png_write_row(png, grey.ptr(y));
  png_write_end(png, info);
}

}  // namespace

bool is_png(std::span<const unsigned char> bytes) {
  return bytes.size() >= 4 && png_sig_cmp(bytes.data(), 0, 4) == 0;
}

cv::Size png_size(std::span<const unsigned char> bytes) {
  // Offsets within IHDR, the first chunk.
  constexpr std::size_t width_at = 16, height_at = 20, end = 24;
  if (!is_png(bytes) || bytes.size() < end || std::memcmp(&bytes[12], "IHDR", 4) != 0) return {};
  const std::uint32_t width = png_get_uint_32(&bytes[width_at]),
                      height = png_get_uint_32(&bytes[height_at]);
  if (width > PNG_UINT_31_MAX || height > PNG_UINT_31_MAX) return {};
  return {int(width), int(height)};
}

PngPicture read_png(std::span<const unsigned char> bytes, PngAs as, double most_pixels) {
  Reading reading{bytes, {}, {}};
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reading, fail, keep_quiet);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  if (info == nullptr)
    reading.result.fault = "no memory";
  else if (setjmp(png_jmpbuf(png)) == 0)
    read(png, info, as, most_pixels, reading);
  png_destroy_read_struct(&png, &info, nullptr);
  if (!reading.result.fault.empty()) reading.result.picture.release();
  return std::move(reading.result);
}

std::string png_of_grey(const cv::Mat& picture) {
  if (picture.type() != CV_16UC1) throw std::invalid_argument("png_of_grey: expected CV_16UC1");
  Writing writing;
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, &writing, fail_writing, keep_quiet);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  if (info == nullptr)
    writing.fault = "no memory";
  else if (setjmp(png_jmpbuf(png)) == 0)
    write(png, info, picture, writing);
  png_destroy_write_struct(&png, &info);
  if (!writing.fault.empty()) throw std::runtime_error("PNG: " + writing.fault);
  return std::move(writing.bytes);
}

}  // namespace hyperex::capture
