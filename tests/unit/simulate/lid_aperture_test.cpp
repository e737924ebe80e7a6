// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/lid_aperture.hpp"

#include <gtest/gtest.h>

namespace hyperex::simulate {
namespace {

constexpr double kRecorded_mm = 8, kOwn_mm = 11;

/// The right eye's inner pair of lids with the given aperture, and a point of the mouth; the upper
/// lid moves by -7 mm x course, the lower by 1 mm x course.
motion::Motion blinking(double aperture_mm, const std::vector<double>& course) {
  motion::Motion m;
  m.names = {"ibug68_38", "ibug68_48", "ibug68_40"};
  for (std::size_t k = 0; k < course.size(); ++k) {
    m.time_s.push_back(0.1 * double(k));
    Points at(3, 3);
    at << 30, aperture_mm - 7 * course[k], 20 - course[k], 25, -60, 10, 30, course[k], 20;
    m.positions.push_back(1e-3 * at);
  }
  return m;
}

AlignedMotion aligned_as(const motion::Motion& own) {
  AlignedMotion aligned;
  aligned.motion = own;
  aligned.rest = own.positions[0];
  return aligned;
}

double aperture_mm(const Points& at) {
  return 1e3 * (at(0, 1) - at(2, 1));
}

TEST(LidAperture, ClosesByTheSameShareOfAnEyeThatIsWider) {
  const std::vector<double> course = {0, 0.25, 1, 2, -0.5};
  const motion::Motion recorded = blinking(kRecorded_mm, course);
  AlignedMotion aligned = aligned_as(blinking(kOwn_mm, course));
  match_lid_apertures(aligned, recorded);
  const double expected_mm[] = {kOwn_mm, 0.75 * kOwn_mm, 0, 0, 1.5 * kOwn_mm};
  for (std::size_t k = 0; k < course.size(); ++k) {
    const Points& at = aligned.motion.positions[k];
    EXPECT_NEAR(aperture_mm(at), expected_mm[k], 1e-9) << course[k];
    EXPECT_EQ(at.row(1), recorded.positions[k].row(1)) << "the mouth";
    EXPECT_NEAR(at(0, 2), 20e-3 - 1e-3 * course[k], 1e-12) << "along the aperture alone";
  }
  // Seven eighths of the way are the upper lid's.
  EXPECT_NEAR(1e3 * aligned.motion.positions[2](2, 1), kOwn_mm / 8, 1e-9);
}

/// Both pairs of the left eye, and the middle of its lower lid between them. In a squint the lower
/// lid rises by 3 mm all along.
TEST(LidAperture, TheMiddleOfALidGoesWithThePointsBesideIt) {
  const auto squinting = [](double aperture_mm) {
    motion::Motion m;
    m.names = {"ibug68_43", "ibug68_44", "ibug68_46", "ibug68_47", "palpebrale_inferius_L"};
    for (const double lower_mm : {0, 3}) {
      Points at(5, 3);
      at << 30, aperture_mm, 20, 40, aperture_mm, 19, 40, lower_mm, 19, 30, lower_mm, 20, 35,
          lower_mm - 1, 20;
      m.time_s.push_back(lower_mm);
      m.positions.push_back(1e-3 * at);
    }
    return m;
  };
  AlignedMotion aligned = aligned_as(squinting(kOwn_mm));
  match_lid_apertures(aligned, squinting(kRecorded_mm));
  const Points moved_mm = 1e3 * (aligned.motion.positions[1] - aligned.rest);
  EXPECT_NEAR(moved_mm(3, 1), 3 * kOwn_mm / kRecorded_mm, 1e-9);
  EXPECT_NEAR(moved_mm(4, 1), moved_mm(3, 1), 1e-9) << "no dip in the middle of the lid";
}

TEST(LidAperture, LeavesWhatCannotBeCompared) {
  const std::vector<double> course = {0, 1};
  const auto unchanged = [&](const motion::Motion& own, const motion::Motion& recorded) {
    AlignedMotion aligned = aligned_as(own);
    match_lid_apertures(aligned, recorded);
    return aligned.motion.positions[1] == own.positions[1];
  };
  const motion::Motion recorded = blinking(kRecorded_mm, course);
  EXPECT_TRUE(unchanged(blinking(1.9, course), recorded)) << "closed at rest";
  EXPECT_TRUE(unchanged(blinking(17, course), recorded)) << "another point, probably";
  EXPECT_FALSE(unchanged(blinking(15, course), recorded));
  motion::Motion lacks = recorded;
  lacks.names[2] = "ibug68_41";
  EXPECT_TRUE(unchanged(blinking(kOwn_mm, course), lacks));
}

}  // namespace
}  // namespace hyperex::simulate
