// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/face/complexion.hpp"

#include <gtest/gtest.h>

#include "hyperex/face/canonical_face.hpp"
#include "hyperex/face/paint.hpp"

namespace hyperex::face {
namespace {

/// The mean around a vertex of the canonical face, over 3 mm.
Rgb around(const SkinPicture& skin, double u, double v) {
  Rgb mean{};
  for (int i = -3; i <= 3; ++i)
    for (int k = -3; k <= 3; ++k) {
      const auto pixel = skin.at(u + 0.002 * i, v + 0.002 * k);
      for (std::size_t c = 0; c < 3; ++c) mean[c] += pixel[c] / 49.0;
    }
  return mean;
}
Rgb around(const SkinPicture& skin, int vertex) {
  const auto& uv = canonical_face().uv;
  return around(skin, uv(vertex, 0), uv(vertex, 1));
}
double redness(const Rgb& c) {
  return c[0] / (c[0] + c[1] + c[2]);
}
double lightness(const Rgb& c) {
  return (c[0] + c[1] + c[2]) / 3;
}

class PaintedSkin : public testing::TestWithParam<SkinTone> {};

TEST_P(PaintedSkin, HasLipsBrowsAndFlushedCheeksWhereTheFaceHasThem) {
  const SkinPicture& skin = painted_skin(GetParam());
  ASSERT_EQ(skin.rgb.size(), 3u * 1024 * 1024);
  constexpr int lower_lip = 16, upper_lip = 12, forehead = 151, brow_R = 105, brow_L = 334;
  constexpr int cheek_R = 205, cheek_L = 425, temple = 139;
  const Rgb plain = around(skin, forehead);
  for (const int lip : {lower_lip, upper_lip}) {
    EXPECT_GT(redness(around(skin, lip)), redness(plain) + 0.03);
    EXPECT_LT(lightness(around(skin, lip)), lightness(plain));
  }
  for (const int brow : {brow_R, brow_L})
    EXPECT_LT(lightness(around(skin, brow)), 0.9 * lightness(plain)) << "vertex " << brow;
  for (const int cheek : {cheek_R, cheek_L})
    EXPECT_GT(redness(around(skin, cheek)), redness(around(skin, temple)) + 0.003);
}

TEST_P(PaintedSkin, IsOfItsTone) {
  const auto tone = tone_colour(GetParam());
  const Rgb temple = around(painted_skin(GetParam()), 139);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(temple[k], tone[k], 14);
}

INSTANTIATE_TEST_SUITE_P(All, PaintedSkin,
                         testing::Values(SkinTone::light, SkinTone::medium, SkinTone::dark));

TEST(SkinPicture, ReadsBetweenPixels) {
  const SkinPicture two{2, {0, 0, 0, 100, 0, 0, 0, 40, 0, 100, 40, 200}};
  EXPECT_EQ(two.at(0.25, 0.25), (std::array<std::uint8_t, 3>{0, 0, 0}));
  EXPECT_EQ(two.at(0.5, 0.25), (std::array<std::uint8_t, 3>{50, 0, 0}));
  EXPECT_EQ(two.at(0.5, 0.5), (std::array<std::uint8_t, 3>{50, 20, 50}));
  EXPECT_EQ(two.at(7, 7), (std::array<std::uint8_t, 3>{100, 40, 200})) << "clamped";
  EXPECT_EQ(two.at(-1, 0.75), (std::array<std::uint8_t, 3>{0, 40, 0}));
}

TEST(Paint, ALoopIsFilledInsideAndAStrokeTapers) {
  Canvas canvas(100, {0, 0, 0});
  const std::vector<Place> square = {{0.2, 0.2}, {0.6, 0.2}, {0.6, 0.6}, {0.2, 0.6}};
  canvas.fill_loop(square, 1, [](Place, Rgb) { return Rgb{255, 0, 0}; });
  canvas.stroke({{0.1, 0.8}, {0.9, 0.8}}, 12, {0, 255, 0}, 1);
  const std::vector<std::uint8_t> bytes = canvas.bytes();
  const auto pixel = [&](int x, int y, int k) { return bytes[std::size_t(3 * (100 * y + x) + k)]; };
  EXPECT_EQ(pixel(40, 40, 0), 255);
  EXPECT_EQ(pixel(10, 40, 0), 0);
  EXPECT_EQ(pixel(40, 10, 0), 0);
  EXPECT_NEAR(pixel(20, 40, 0), 128, 128) << "on the edge";
  const auto width = [&](int x) {
    int count = 0;
    for (int y = 65; y < 95; ++y) count += pixel(x, y, 1) > 128 ? 1 : 0;
    return count;
  };
  EXPECT_GT(width(15), width(85));
  EXPECT_GT(width(85), 0);
}

}  // namespace
}  // namespace hyperex::face
