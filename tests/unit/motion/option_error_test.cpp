// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/option_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "hyperex/motion/fill_gaps.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/motion/stabilise.hpp"

namespace hyperex::motion {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

Motion three_points(const std::string& prefix) {
  Motion m;
  m.source = "take.csv";
  m.names = {prefix + "a", prefix + "b", prefix + "c"};
  for (int k = 0; k < 11; ++k) {
    m.time_s.push_back(0.1 * k);
    m.positions.push_back(Points::Identity(3, 3));
  }
  return m;
}

template <class Call>
OptionError thrown_by(Call call) {
  try {
    call();
  } catch (const OptionError& error) {
    return error;
  }
  ADD_FAILURE() << "nothing was thrown";
  return {"", "", "", ""};
}

// The options are named as in the library; a caller with other names writes the sentence with
// those.
TEST(OptionError, OfAGapNamesTheOptionAsItIsCalled) {
  Motion m = three_points("");
  for (int k = 2; k < 9; ++k)
    m.positions[std::size_t(k)].row(1).setConstant(std::numeric_limits<double>::quiet_NaN());
  const OptionError error = thrown_by([&] { fill_gaps(m, {.max_gap_s = 0.2}); });
  EXPECT_STREQ(error.what(),
               "take.csv: point b is missing from 0.2 s on for 0.8 s: at most 0.2 s are "
               "interpolated (max_gap_s)");
  EXPECT_THAT(error.sentence("motion.max_gap_s"), EndsWith("interpolated (motion.max_gap_s)"));
}

TEST(OptionError, OfAHeadWithoutRigidPointsNamesTheOption) {
  const OptionError error = thrown_by([] { stabilise(three_points("marker_"), {}); });
  EXPECT_THAT(error.what(), HasSubstr("take.csv: head pose needs three points"));
  EXPECT_THAT(error.what(), HasSubstr("0 of them. rigid_points names others; "));
  EXPECT_THAT(error.sentence("KEY"), HasSubstr("0 of them. KEY names others; "));
}

/// Two samples of seven points of the mouth, and of others.
Motion mouth_and(const std::vector<std::string>& others) {
  Motion m;
  m.source = "take.csv";
  m.names = {"ibug68_48", "ibug68_54", "ibug68_51", "lower lip",
             "ibug68_8",  "ibug68_58", "ibug68_56"};
  m.names.insert(m.names.end(), others.begin(), others.end());
  m.time_s = {0, 0.1};
  m.positions.assign(2, Points::Random(Eigen::Index(m.names.size()), 3));
  return m;
}

// The answer comes alone: points of the mouth must not be named in their place.
TEST(OptionError, OfAHeadWithoutRigidPointsNamesThoseOfTheHeadAlone) {
  const auto refused = [](const Motion& m) {
    return std::string(thrown_by([&] { stabilise(m, {}); }).what());
  };
  EXPECT_THAT(refused(mouth_and({"ibug68_36", "head_1", "head_2"})),
              EndsWith("the motion has 1 of them. rigid_points names others; the motion's other "
                       "points, without those of mouth and chin, are head_1, head_2"));
  EXPECT_THAT(refused(mouth_and({"head_1", "head_2"})),
              EndsWith("the motion has 0 of them. rigid_points finds too few others, as the "
                       "motion's other points move with mouth and chin: record three such points "
                       "or more"));
}

TEST(OptionError, PointsOfTheMouthCarryNoHead) {
  const Motion m = mouth_and({"head_1", "head_2", "head_3"});
  EXPECT_THAT(
      thrown_by([&] {
        check_pose_points(m, {"ibug68_8", "lower lip", "head_1", "head_2"});
      }).what(),
      EndsWith(
          "rigid_points names points that move with mouth and chin: ibug68_8 (chin), lower lip"));
  EXPECT_NO_THROW(check_pose_points(m, {"ibug68_8", "head_3", "head_1", "head_2"}))
      << "three others carry it";
}

TEST(OptionError, OfATableOfExpressionsSaysWhichItIs) {
  const auto file = std::filesystem::path(::testing::TempDir()) / "expressions.csv";
  std::ofstream(file) << "time_s,jawOpen,mouthSmileLeft\n0,0,0\n";
  EXPECT_EQ(thrown_by([&] { read_motion(file); }).option(), "arkit");
  std::ofstream(file) << "time_s,mouthSmileLeft,mouthSmileRight\n0,0,0\n";  // no jaw among them
  EXPECT_EQ(thrown_by([&] { read_motion(file); }).option(), "arkit");
  std::ofstream(file) << "Timecode,BlendShapeCount,EyeBlinkLeft\n16:07:12:05.613,61,0\n";
  EXPECT_EQ(thrown_by([&] { read_motion(file); }).option(), "arkit");
  std::ofstream(file) << "frame,timestamp,AU12_r,AU26_r\n1,0,0,0\n";
  const OptionError error = thrown_by([&] { read_motion(file); });
  EXPECT_EQ(error.option(), "openface");
  EXPECT_EQ(error.sentence("motion.openface"),
            file.string() +
                ": a table of action units by OpenFace, not of points: expected it as "
                "motion.openface");
}

}  // namespace
}  // namespace hyperex::motion
