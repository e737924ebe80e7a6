// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/mouth_opening.hpp"

#include <gtest/gtest.h>

#include "simulate/small_face.hpp"

namespace hyperex::simulate {
namespace {

class MouthOpeningTest : public testing::Test {
 protected:
  /// Upper lip and corners as given, the lower lip and chin down; the second of three samples.
  AlignedMotion opening(double down_m, double corner_m) const {
    return test::motion_of(face_.landmarks, 3, 30,
                           [=](const std::string& name, const Vec3&, int k) {
                             Vec3 way = Vec3::Zero();
                             if (name == "ibug68_48") way.x() = -corner_m / 2;
                             if (name == "ibug68_54") way.x() = corner_m / 2;
                             if (name == "ibug68_57" || name == "ibug68_8") way.y() = -down_m;
                             return Vec3(k == 0 ? 0 * way : k == 1 ? way : 0.3 * way);
                           });
  }
  MouthOpening of(const AlignedMotion& motion, const std::vector<std::string>& points,
                  double gain = 1) const {
    return mouth_opening(motion, points, face_.landmarks, gain);
  }
  const test::SmallFace face_ = test::small_face();
};

TEST_F(MouthOpeningTest, IsThatOfTheWidestSample) {
  const MouthOpening mouth = of(opening(0.02, -0.006), test::seven_points());
  // The lips' midpoints lie one above the other but for some millimetres of depth.
  EXPECT_NEAR(mouth.opening_m, 0.02, 5e-4);
  EXPECT_NEAR(mouth.corners_m, -0.006, 2e-4);
  EXPECT_NEAR(mouth.eyes_m,
              (face_.landmarks.at("ibug68_36") - face_.landmarks.at("ibug68_45")).norm(), 1e-15);
  EXPECT_NEAR(of(opening(0.02, -0.006), test::seven_points(), 0.5).corners_m, -0.003, 1e-4);
  const MouthOpening none = of(opening(-0.01, 0.01), test::seven_points());
  EXPECT_EQ(none.opening_m, 0);
  EXPECT_EQ(of(opening(0.02, 0), {}).opening_m, 0);
  EXPECT_EQ(of(opening(0.02, 0), {"nobody"}).opening_m, 0);
}

/// Markers bear other names and lie beside the landmarks.
TEST_F(MouthOpeningTest, IsReadFromAnyPoints) {
  const io::Landmarks& at = face_.landmarks;
  const Vec3 beside(0.003, -0.002, 0);
  const io::Landmarks markers = {{"up", at.at("ibug68_51") + beside},
                                 {"down", at.at("ibug68_57") + beside},
                                 {"end_R", at.at("ibug68_48") + beside},
                                 {"end_L", at.at("ibug68_54") + beside}};
  const AlignedMotion motion =
      test::motion_of(markers, 2, 30, [](const std::string& name, const Vec3&, int k) {
        return Vec3(name.starts_with("end") ? (name.back() == 'R' ? 0.003 : -0.003) * k : 0,
                    name == "down" ? -0.03 * k : 0, 0);
      });
  const MouthOpening mouth = of(motion, {"up", "down", "end_R", "end_L"});
  EXPECT_NEAR(mouth.opening_m, 0.03, 0.007);
  EXPECT_NEAR(mouth.corners_m, -0.006, 0.0015);
  EXPECT_TRUE(jaw_drops_alone(mouth));
}

TEST(JawDropsAlone, WhereTheMouthIsWideAndItsCornersDoNotPart) {
  EXPECT_TRUE(jaw_drops_alone({0.021, -0.003, 0.1}));
  EXPECT_TRUE(jaw_drops_alone({0.021, 0.0003, 0.1}));
  EXPECT_FALSE(jaw_drops_alone({0.019, -0.003, 0.1})) << "not wide";
  EXPECT_FALSE(jaw_drops_alone({0.021, 0.0005, 0.1})) << "muscles part the corners";
  EXPECT_TRUE(jaw_drops_alone({0.041, 0.0005, 0.2})) << "of a larger face";
  EXPECT_FALSE(jaw_drops_alone({0.021, -0.003, 0.2})) << "of a larger face";
}

}  // namespace
}  // namespace hyperex::simulate
