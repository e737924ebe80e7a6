// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/render/canvas.hpp"

#include <cairo.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/render/contact_sheet.hpp"

namespace hyperex::render {
namespace {

using testing::DoubleEq;
using testing::DoubleNear;
using testing::ElementsAre;

TEST(ColourMap, GoesFromPaleToDark) {
  EXPECT_EQ(moss(0), (Colour{0xe4 / 255.0, 0xe2 / 255.0, 0xd3 / 255.0}));
  EXPECT_EQ(moss(2), moss(1));
  EXPECT_EQ(moss(std::nan("")), moss(0));
  // Lightness must fall all along, or the map misleads.
  const auto luminance = [](const Colour& c) {
    return 0.2126 * linear_from_srgb(c.r) + 0.7152 * linear_from_srgb(c.g) +
           0.0722 * linear_from_srgb(c.b);
  };
  for (int i = 0; i < 100; ++i)
    EXPECT_GT(luminance(moss(i / 100.0)), luminance(moss((i + 1) / 100.0)));
}

TEST(ColourMap, TransferFunctionsAreInverse) {
  for (double v = 0; v <= 1; v += 0.01) EXPECT_NEAR(srgb_from_linear(linear_from_srgb(v)), v, 1e-5);
}

TEST(Ticks, AreRound) {
  EXPECT_THAT(ticks({0, 26}, 6), ElementsAre(0, 5, 10, 15, 20, 25));
  EXPECT_THAT(ticks({0, 1}, 5),
              ElementsAre(DoubleEq(0), DoubleNear(0.2, 1e-12), DoubleNear(0.4, 1e-12),
                          DoubleNear(0.6, 1e-12), DoubleNear(0.8, 1e-12), DoubleNear(1, 1e-12)));
  EXPECT_THAT(ticks({-3, 3}, 6), ElementsAre(-3, -2, -1, 0, 1, 2, 3));
  EXPECT_THAT(ticks({2, 2}, 6), ElementsAre(2));
}

TEST(Canvas, KeepsPixelsThroughDrawAndImage) {
  Image image(7, 5);
  for (size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = static_cast<std::uint8_t>(37 * i);
  EXPECT_EQ(Canvas(image).image().rgb, image.rgb);
  Canvas larger(20, 20);
  larger.draw(image, 15, -2);  // hangs over two borders
  EXPECT_EQ(larger.image().pixel(15, 0)[1], image.pixel(0, 2)[1]);
}

TEST(Canvas, WritesText) {
  Canvas canvas(200, 40);
  const double width = canvas.text(100, 25, "12.5 mm", {.size_px = 16, .align = Align::right});
  EXPECT_GT(width, 40);
  const Image image = canvas.image(), blank(200, 40);
  int left = 0, right = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 200; ++x)
      (x < 100 ? left : right) += image.pixel(x, y)[0] != blank.pixel(x, y)[0];
  EXPECT_GT(left, 100);
  EXPECT_LE(right, 5);
}

TEST(Canvas, ColourBarRunsFromLowAtTheFootToHighAtTheTop) {
  Canvas canvas(120, 140);
  canvas.colour_bar(10, 25, 100, {.range = {0, 5}, .label = "distance (mm)"});
  const Image image = canvas.image();
  EXPECT_NEAR(image.pixel(18, 26)[0], 255 * moss(0.985).r, 1);
  EXPECT_NEAR(image.pixel(18, 123)[2], 255 * moss(0.015).b, 1);
}

cairo_status_t next_bytes(void* from, unsigned char* to, unsigned int count) {
  auto& left = *static_cast<std::vector<std::uint8_t>*>(from);
  if (left.size() < count) return CAIRO_STATUS_READ_ERROR;
  std::copy_n(left.begin(), count, to);
  left.erase(left.begin(), left.begin() + count);
  return CAIRO_STATUS_SUCCESS;
}

// The file is read by another library (cairo with libpng, which verifies the checksums).
TEST(Png, HoldsThePicturesColours) {
  Image image(37, 21);
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    image.rgb[i] = static_cast<std::uint8_t>(i * i % 251 + i / 100);
  std::vector<std::uint8_t> bytes = png_bytes(image);
  cairo_surface_t* read = cairo_image_surface_create_from_png_stream(next_bytes, &bytes);
  ASSERT_EQ(cairo_surface_status(read), CAIRO_STATUS_SUCCESS);
  ASSERT_EQ(cairo_image_surface_get_width(read), 37);
  ASSERT_EQ(cairo_image_surface_get_height(read), 21);
  const unsigned char* pixels = cairo_image_surface_get_data(read);
  for (int y = 0; y < 21; ++y)
    for (int x = 0; x < 37; ++x) {
      std::uint32_t pixel = 0;
      std::memcpy(&pixel, pixels + y * cairo_image_surface_get_stride(read) + 4 * x, 4);
      for (int k = 0; k < 3; ++k)
        ASSERT_EQ((pixel >> (16 - 8 * k)) & 0xff, image.pixel(x, y)[k]) << x << ' ' << y;
    }
  cairo_surface_destroy(read);
  EXPECT_THROW(png_bytes(Image()), std::invalid_argument);
}

TEST(Png, IsOneAndIsRefusedWhereItCannotBe) {
  const auto bytes = png_bytes(Image(3, 2));
  EXPECT_EQ(std::string(bytes.begin() + 1, bytes.begin() + 4), "PNG");
  EXPECT_EQ(bytes[19], 3);  // width, big-endian
  EXPECT_EQ(bytes[23], 2);
  EXPECT_EQ(std::string(bytes.begin() + 37, bytes.begin() + 57),
            std::string("tEXtSoftware\0Hyperex", 20));
  EXPECT_THROW(write_png("/no/such/folder/a.png", Image(1, 1)), InputError);
  const auto file = std::filesystem::path(testing::TempDir()) / "hyperex_canvas_test.png";
  write_png(file, Image(3, 2));
  EXPECT_EQ(read_file(file), std::string(bytes.begin(), bytes.end()));
  std::filesystem::remove(file);
}

TEST(ContactSheet, HoldsItsPicturesInOrder) {
  const Image red(30, 20, {1, 0, 0}), green(30, 20, {0, 1, 0}), blue(30, 20, {0, 0, 1});
  const Image sheet = contact_sheet({.title = "Title",
                                     .pictures = {{red, "a"}, {green, "b"}, {blue, "c"}},
                                     .columns = 2,
                                     .bar = ColourBar{{0, 1}, "mm"}});
  const auto middle_of = [&](int channel) {
    double sum_x = 0, sum_y = 0, count = 0;
    for (int y = 0; y < sheet.height; ++y)
      for (int x = 0; x < sheet.width; ++x) {
        bool pure = true;
        for (int k = 0; k < 3; ++k) pure &= sheet.pixel(x, y)[k] == (k == channel ? 255 : 0);
        if (!pure) continue;
        sum_x += x;
        sum_y += y;
        ++count;
      }
    EXPECT_EQ(count, 600);
    return std::array{sum_x / count, sum_y / count};
  };
  EXPECT_LT(middle_of(0)[0], middle_of(1)[0]);
  EXPECT_EQ(middle_of(0)[1], middle_of(1)[1]);
  EXPECT_LT(middle_of(0)[1], middle_of(2)[1]);
  EXPECT_EQ(middle_of(0)[0], middle_of(2)[0]);
  EXPECT_THROW(contact_sheet({}), std::invalid_argument);
}

}  // namespace
}  // namespace hyperex::render
