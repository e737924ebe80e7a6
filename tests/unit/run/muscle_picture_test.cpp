// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/muscle_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hyperex/render/time_plot.hpp"
#include "unit/muscles/a_face.hpp"

namespace hyperex::run {
namespace {

/// Two samples; activation is greatest in the second.
simulate::MuscleCourse course(double left, double right, double sigma = 0.02) {
  simulate::MuscleCourse course;
  course.names = {"zyg_major_L", "zyg_major_R"};
  course.time_s = {0, 0.1};
  course.activation.resize(2, 2);
  course.activation << 0, left, 0, right;
  course.sigma.setConstant(2, 2, sigma);
  return course;
}

int pixels_of(const render::Image& image, const render::Colour& colour, double from, double to) {
  const auto near = [](std::uint8_t byte, double value) {
    return std::abs(byte - 255 * value) < 3;
  };
  int count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = int(from * image.width); x < int(to * image.width); ++x) {
      const std::uint8_t* p = image.pixel(x, y);
      count += near(p[0], colour.r) && near(p[1], colour.g) && near(p[2], colour.b);
    }
  return count;
}

TEST(MusclePicture, AMuscleIsAsBroadAsItIsActiveOnItsOwnSide) {
  const muscles::test::AFace& face = muscles::test::a_face();
  const auto draw = [&](double left, double right) {
    return draw_muscles(face.mesh, face.landmarks, course(left, right));
  };
  const render::Image weak = draw(0.05, 0.05), left = draw(0.9, 0.05);
  ASSERT_EQ(weak.width, left.width);
  const render::Colour zygomatic = render::face_colour(1);
  // From the left: the right side, in front, the left side, the names.
  const double cell = 440.0 / weak.width;
  const auto added = [&](double from, double to) {
    return pixels_of(left, zygomatic, from, to) - pixels_of(weak, zygomatic, from, to);
  };
  EXPECT_EQ(added(0, 0.9 * cell), 0) << "the right side draws no left muscle";
  EXPECT_GT(added(cell, 2 * cell), 200);
  EXPECT_GT(added(2.2 * cell, 3.1 * cell), 200);
}

TEST(MusclePicture, AMuscleThatMayBeAtRestIsPale) {
  const muscles::test::AFace& face = muscles::test::a_face();
  const render::Colour zygomatic = render::face_colour(1);
  const auto full = [&](double sigma) {
    const auto image = draw_muscles(face.mesh, face.landmarks, course(0.9, 0.9, sigma));
    return pixels_of(image, zygomatic, 0, 1);
  };
  const int known = full(0.4), unknown = full(0.5);  // 0.9 is 2.2 and 1.8 standard deviations
  EXPECT_GT(known, unknown + 400);
  EXPECT_EQ(full(0.02), known) << "it is one or the other";
}

/// Between the line of zygomaticus major and the fold lies its sheet, in the view from its side.
TEST(MusclePicture, AMuscleThatEndsInTheFoldHasASheet) {
  const muscles::test::AFace& face = muscles::test::a_face();
  muscles::MuscleTable table = {*muscles::find_muscle("zyg_major")};
  const auto draw = [&] {
    return draw_muscles(face.mesh, face.landmarks, course(0.9, 0.9), table);
  };
  const render::Image with = draw();
  table[0].fold_from = table[0].fold_to = 0;
  const render::Image without = draw();
  ASSERT_EQ(with.width, without.width);
  int tinted = 0, other = 0;
  for (int y = 0; y < with.height; ++y)
    for (int x = 0; x < with.width; ++x) {
      const std::uint8_t *a = with.pixel(x, y), *b = without.pixel(x, y);
      if (std::equal(a, a + 3, b)) continue;
      const render::Colour zygomatic = render::face_colour(1);
      const double wanted[] = {255 * zygomatic.r, 255 * zygomatic.g, 255 * zygomatic.b};
      bool between = true;
      for (int k = 0; k < 3; ++k)
        between &= a[k] + 2 >= std::min<double>(b[k], wanted[k]) &&
                   a[k] - 2 <= std::max<double>(b[k], wanted[k]);
      (between ? tinted : other) += 1;
    }
  EXPECT_GT(tinted, 2000) << "two sheets from in front, one from either side";
  EXPECT_LT(other, tinted / 50) << "towards the colour of the branch";
}

TEST(MusclePicture, AStarInTheListMarksWhatThePriorChose) {
  const muscles::test::AFace& face = muscles::test::a_face();
  const auto draw = [&](double prior_sigma) {
    simulate::MuscleCourse drawn = course(0.9, 0.9, 0.2);
    drawn.prior_sigma.setConstant(2, 2, prior_sigma);
    return draw_muscles(face.mesh, face.landmarks, drawn);
  };
  const render::Image determined = draw(0.3), chosen = draw(0.22);
  ASSERT_EQ(determined.width, chosen.width);
  int faces = 0, list = 0;
  for (int y = 0; y < chosen.height; ++y)
    for (int x = 0; x < chosen.width; ++x) {
      const bool differs =
          !std::equal(chosen.pixel(x, y), chosen.pixel(x, y) + 3, determined.pixel(x, y));
      (x < 3 * 440 ? faces : list) += differs;
    }
  EXPECT_EQ(faces, 0);
  EXPECT_GT(list, 10);
  EXPECT_LT(list, 400) << "two stars";
}

/// -0.001 is printed as 0.00, and -0.3 with a line below the list that says what it means.
TEST(MusclePicture, SaysWhatAnActivationBelowZeroMeans) {
  const muscles::test::AFace& face = muscles::test::a_face();
  const auto draw = [&](double right) {  // 0.5: all are pale alike
    return draw_muscles(face.mesh, face.landmarks, course(0.9, right, 0.5));
  };
  const render::Image none = draw(0), rounded = draw(-0.001), relaxed = draw(-0.3);
  ASSERT_EQ(none.height, relaxed.height);
  int first = none.height, last = -1;
  bool all_equal = true;
  for (int y = 0; y < none.height; ++y)
    for (int x = 0; x < none.width; ++x) {
      all_equal &= std::equal(none.pixel(x, y), none.pixel(x, y) + 3, rounded.pixel(x, y));
      if (std::equal(none.pixel(x, y), none.pixel(x, y) + 3, relaxed.pixel(x, y))) continue;
      first = std::min(first, y);
      last = std::max(last, y);
    }
  EXPECT_TRUE(all_equal);
  EXPECT_GT(last - first, 100) << "the figure in its row, and the line below the list";
}

TEST(MusclePicture, HasADiscForEachMuscle) {
  const muscles::test::AFace& face = muscles::test::a_face();
  const render::Image image = draw_muscles(face.mesh, face.landmarks, course(0, 0));
  for (std::size_t branch = 0; branch < 5; ++branch)
    EXPECT_GT(pixels_of(image, render::face_colour(branch), 0, 1), 250) << branch;
}

}  // namespace
}  // namespace hyperex::run
