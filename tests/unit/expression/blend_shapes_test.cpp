// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/expression/blend_shapes.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "hyperex/expression/arkit_names.hpp"
#include "hyperex/expression/tables.hpp"
#include "hyperex/expression/timecode.hpp"
#include "hyperex/expression/weight_doubts.hpp"
#include "hyperex/motion/resample.hpp"
#include "unit/io/io_testing.hpp"

namespace hyperex::expression {
namespace {
using BlendShapesFile = io::testing::FileTest;

/// Checks that reading is refused in one line that begins with the file and contains all `parts`.
template <class Read>
void expect_refused(const std::filesystem::path& file, const std::vector<std::string>& parts,
                    const Read& read) {
  for (const auto& part : parts) io::testing::expect_refused(file, part, [&] { read(file); });
}

/// Displacement of a landmark from frame 0 to `frame` (m).
Vec3 moved(const motion::Motion& motion, const std::string& name, std::size_t frame) {
  const int i = motion.index_of(name);
  return (motion.positions[frame].row(i) - motion.positions[0].row(i)).transpose();
}

motion::Motion moved_by(const BlendShapes& shapes) {
  std::vector<std::string> notes;
  return motion_of(shapes, canonical_model(), notes);
}

TEST_F(BlendShapesFile, ABlinkClosesTheEyeAndAWideEyeIsWiderByAThird) {
  const motion::Motion motion =
      moved_by(read_arkit(write("e.csv", "time_s,eyeBlinkLeft,eyeWideRight\n0,0,0\n0.1,1,1\n")));
  const auto aperture_mm = [&](const char* upper, const char* lower, std::size_t frame) {
    const Points& at = motion.positions[frame];
    return 1e3 * (at(motion.index_of(upper), 1) - at(motion.index_of(lower), 1));
  };
  EXPECT_GT(aperture_mm("ibug68_44", "ibug68_46", 0), 5);
  EXPECT_NEAR(aperture_mm("ibug68_43", "ibug68_47", 1), 0, 0.5);
  EXPECT_NEAR(aperture_mm("ibug68_44", "ibug68_46", 1), 0, 0.5);
  const double before = aperture_mm("ibug68_37", "ibug68_41", 0);
  EXPECT_NEAR(aperture_mm("ibug68_37", "ibug68_41", 1) / before, 4.0 / 3, 0.05);
}

TEST_F(BlendShapesFile, OpenTheJawAndSmileOnTheRightSide) {
  const auto shapes = read_arkit(
      write("a.csv", "time_s,jawOpen,mouthSmileRight\n0,0,0\n0.1,0.5,0\n0.2,1,0\n0.3,0,1\n"));
  EXPECT_EQ(shapes.names, (std::vector<std::string>{"jawOpen", "mouthSmileRight"}));
  const motion::Motion motion = moved_by(shapes);
  EXPECT_EQ(motion.time_s, (std::vector<double>{0, 0.1, 0.2, 0.3}));
  const Vec3 chin = moved(motion, "ibug68_8", 2);
  EXPECT_LT(chin.y(), -0.015) << "the chin drops";
  EXPECT_NEAR((moved(motion, "ibug68_8", 1) - 0.5 * chin).norm(), 0, 1e-12) << "in proportion";
  EXPECT_LT(moved(motion, "ibug68_27", 2).norm(), 1e-9) << "the bridge of the nose stays";
  // ibug68_48 is the subject's right corner of the mouth, which lies at negative x.
  const Vec3 right = moved(motion, "ibug68_48", 3), left = moved(motion, "ibug68_54", 3);
  EXPECT_LT(motion.positions[0](motion.index_of("ibug68_48"), 0), 0);
  EXPECT_GT(right.y(), 0.003);
  EXPECT_LT(right.x(), -0.002) << "outwards";
  EXPECT_LT(left.norm(), 0.1 * right.norm());
}

TEST_F(BlendShapesFile, ReadsWhatLiveLinkFaceWrites) {
  const auto shapes =
      read_arkit(write("a.csv",
                       "Timecode,BlendShapeCount,EyeBlinkRight,JawOpen,HeadYaw\n"
                       "15:46:35:58.500,61,0.1,0.2,0.05\n15:46:36:00.000,61,-0.01,1.02,0.05\n"));
  EXPECT_EQ(shapes.names, (std::vector<std::string>{"eyeBlinkRight", "jawOpen"}));
  ASSERT_EQ(shapes.time_s.size(), 2u);
  EXPECT_EQ(shapes.time_s[0], 0);
  EXPECT_NEAR(shapes.time_s[1], 1.5 / 60, 1e-9);
  EXPECT_EQ(shapes.weights(1, 0), 0);
  EXPECT_EQ(shapes.weights(1, 1), 1);
  ASSERT_EQ(shapes.notes.size(), 2u);
  EXPECT_NE(shapes.notes[0].find("60 frames"), std::string::npos);
  EXPECT_NE(shapes.notes[1].find("BlendShapeCount, HeadYaw"), std::string::npos);
}

TEST_F(BlendShapesFile, NamesTheShapeThatAColumnWasMeantToBe) {
  const auto shapes = read_arkit(write(
      "a.csv",
      "time_s,jawOpen,mouthSmilRight,jawOpn,browdownleft,HeadYaw\n0,0,0,0,0,0\n1,1,1,1,1,1\n"));
  ASSERT_EQ(shapes.misspelt.size(), 2u) << "jawOpen is there already";
  EXPECT_EQ(shapes.misspelt[0],
            "column mouthSmilRight is no blend shape of ARKit and is left out; did you mean "
            "mouthSmileRight?");
  EXPECT_NE(shapes.misspelt[1].find("did you mean browDownLeft?"), std::string::npos);
  ASSERT_EQ(shapes.notes.size(), 1u);
  EXPECT_EQ(shapes.notes[0], "columns left out: jawOpn, HeadYaw");
}

TEST_F(BlendShapesFile, MouthCloseUndoesWhatJawOpenParts) {
  const motion::Motion motion = moved_by(read_arkit(
      write("c.csv", "time_s,jawOpen,mouthClose\n0,0,0\n1,0.7,0\n2,0.7,0.7\n3,0.3,0.3\n")));
  for (const auto& [upper, lower] : {std::pair{"ibug68_61", "ibug68_67"},
                                     {"ibug68_62", "ibug68_66"},
                                     {"ibug68_63", "ibug68_65"}}) {
    const auto parted_mm = [&](std::size_t frame) {
      return 1e3 * (moved(motion, upper, frame) - moved(motion, lower, frame)).norm();
    };
    EXPECT_GT(parted_mm(1), 10) << upper;
    EXPECT_LT(parted_mm(2), 0.6) << upper;
    EXPECT_LT(parted_mm(3), 0.3) << upper;
  }
  EXPECT_LT((moved(motion, "ibug68_8", 2) - moved(motion, "ibug68_8", 1)).norm(), 1e-4)
      << "the chin stays down";
}

TEST_F(BlendShapesFile, EveryShapeOfTheSkinMovesTheFace) {
  ASSERT_EQ(arkit_shapes().size(), 52u);
  for (const std::string& shape : arkit_shapes()) {
    if (shape.starts_with("eyeLookIn") || shape.starts_with("eyeLookOut") || shape == "tongueOut")
      continue;
    const motion::Motion motion =
        moved_by(read_arkit(write("s.csv", "time_s," + shape + "\n0,0\n1,1\n")));
    double most_m = 0, right_m = 0;
    for (const std::string& name : motion.names) {
      const double far_m = moved(motion, name, 1).norm();
      most_m = std::max(most_m, far_m);
      if (motion.positions[0](motion.index_of(name), 0) < -0.012)
        right_m = std::max(right_m, far_m);
    }
    EXPECT_GT(most_m, 1e-3) << shape;
    if (shape.ends_with("Left") && shape != "jawLeft" && shape != "mouthLeft") {
      EXPECT_LT(right_m, 0.1 * most_m) << shape;
    }
  }
}

TEST_F(BlendShapesFile, NamesTheShapesThatTheFaceLacks) {
  const auto shapes = read_arkit(write("a.csv",
                                       "time_s,jawOpen,tongueOut,cheekPuff,eyeLookUpLeft\n"
                                       "0,0.9,0.1,0.2,0\n82.5,0,0.65,0.3,0.9\n83,0,0.2,0,0\n"));
  EXPECT_EQ(lost_shapes(shapes, canonical_model()), "tongueOut up to 0.65 at 82.50 s");
  EXPECT_EQ(lost_shapes(shapes, canonical_model(), 0, 82), "") << "another part is run";
  EXPECT_EQ(lost_shapes(shapes, canonical_model(), 82.6), "");
  EXPECT_NE(lost_shapes(shapes, canonical_model(), 82.5, 82.5), "");
}

/// 4 s at 10 Hz: a smile over the first second, a pucker from the third second on.
BlendShapes smile_then_pucker(double smile, double pucker) {
  BlendShapes shapes;
  shapes.names = {"mouthSmileLeft", "mouthPucker", "eyeLookUpLeft"};
  shapes.weights = Eigen::MatrixXd::Zero(41, 3);
  for (int k = 0; k < 41; ++k) {
    shapes.time_s.push_back(7 + 0.1 * k);
    if (k < 10) shapes.weights(k, 0) = smile;
    if (k >= 30) shapes.weights(k, 1) = pucker;
    if (k < 20) shapes.weights(k, 2) = 1;
  }
  return shapes;
}

TEST(RestInWeights, IsWhereTheyAreLeast) {
  const auto rest = rest_in_weights(smile_then_pucker(0.8, 0.6));
  ASSERT_TRUE(rest);
  EXPECT_NEAR(rest->from_s, 1, 0.11) << "from the first sample; gaze does not count";
  EXPECT_NEAR(rest->to_s - rest->from_s, 0.3, 1e-9);
  EXPECT_EQ(rest->shape, "mouthSmileLeft");
  EXPECT_NEAR(rest->weight_at_start, 0.8, 1e-9);
  EXPECT_NEAR(rest->weight_then, 0, 1e-9);
}

TEST(RestInWeights, IsNotProposedWithoutNeed) {
  EXPECT_FALSE(rest_in_weights(smile_then_pucker(0.2, 0.6))) << "nearly at rest at the start";
  BlendShapes held = smile_then_pucker(0.8, 0.6);
  held.weights.col(1).setConstant(0.4);
  EXPECT_FALSE(rest_in_weights(held)) << "nowhere at rest";
}

TEST(Timecode, TellsItsRateByItsFrames) {
  EXPECT_EQ(timecode_frames("01:00:02:07.5"), 1000.0 * 3602 + 7.5);
  EXPECT_EQ(timecode_frames("01:00:02"), std::nullopt);
  EXPECT_EQ(timecode_frames("01:60:02:00"), std::nullopt);
  EXPECT_EQ(timecode_frames("noon"), std::nullopt);
  EXPECT_EQ(frame_rate_of({1000 + 23, 2000}), 24);
  EXPECT_EQ(frame_rate_of({1000 + 29, 2000}), 30);
  EXPECT_EQ(frame_rate_of({1000 + 59, 2000}), 60);
  EXPECT_DOUBLE_EQ(timecode_seconds(7000 + 15, 30), 7.5);
}

TEST_F(BlendShapesFile, OpenFaceIntensitiesBecomeWeights) {
  const auto shapes = read_openface(write("o.csv",
                                          "frame, timestamp, success, AU12_r, AU26_r, AU12_c\n"
                                          "1, 0, 1, 0, 0, 0\n2, 0.04, 1, 5, 2.5, 1\n"
                                          "3, 0.08, 0, 5, 5, 1\n"));
  const auto weight = [&](const std::string& name, int frame) {
    for (std::size_t c = 0; c < shapes.names.size(); ++c)
      if (shapes.names[c] == name) return shapes.weights(frame, static_cast<Eigen::Index>(c));
    ADD_FAILURE() << name;
    return -1.0;
  };
  EXPECT_EQ(weight("mouthSmileLeft", 1), 1);
  EXPECT_EQ(weight("mouthSmileRight", 1), 1);
  EXPECT_EQ(weight("jawOpen", 1), 0.25) << "half an intensity, half a jaw";
  EXPECT_TRUE(std::isnan(weight("jawOpen", 2))) << "no success";
  const motion::Motion motion = moved_by(shapes);
  EXPECT_TRUE(motion.positions[2].array().isNaN().all());
  const Vec3 right = moved(motion, "ibug68_48", 1), left = moved(motion, "ibug68_54", 1);
  EXPECT_NEAR(right.x(), -left.x(), 1e-6);
  EXPECT_NEAR(right.y(), left.y(), 1e-6);
}

TEST(OpenFaceTable, NamesUnitsThatTheFaceHas) {
  BlendShapes all;
  all.time_s = {0, 1};
  all.weights.resize(2, 0);
  for (const auto& row : table_rows(openface_arkit_table(), "action_unit,blend_shape,share")) {
    ASSERT_EQ(row.size(), 3u);
    EXPECT_GT(table_number(row[2]), 0);
    EXPECT_LE(table_number(row[2]), 1);
    std::string name = row[1];
    if (name.back() == '*') name.replace(name.size() - 1, 1, "Left");
    all.names.push_back(name);
  }
  all.weights = Eigen::MatrixXd::Ones(2, static_cast<Eigen::Index>(all.names.size()));
  std::vector<std::string> notes;
  motion_of(all, canonical_model(), notes);
  EXPECT_TRUE(notes.empty()) << notes.front();
}

TEST_F(BlendShapesFile, AMissingSideIsToldWhereOthersHaveBoth) {
  const auto missing = [&](const std::string& table) {
    return missing_sides(read_arkit(write("sides.csv", table)));
  };
  const MissingSides told =
      missing("time_s,EyeBlinkLeft,EyeBlinkRight,MouthSmileRight\n0,0,0,0\n1,0,0,0.92\n");
  EXPECT_THAT(told.text, testing::HasSubstr("MouthSmileLeft (MouthSmileRight reaches 0.92)"));
  EXPECT_TRUE(told.doubtful);
  const MissingSides one_sided = missing("time_s,mouthSmileRight,jawOpen\n0,0,0\n1,1,1\n");
  EXPECT_THAT(one_sided.text, testing::HasSubstr("mouthSmileLeft"));
  EXPECT_FALSE(one_sided.doubtful) << "it may be meant";
  const MissingSides still =
      missing("time_s,eyeBlinkLeft,eyeBlinkRight,mouthSmileRight\n0,0,0,0\n1,1,1,0.04\n");
  EXPECT_EQ(still.text, "");
  EXPECT_FALSE(still.doubtful);
  EXPECT_EQ(missing("time_s,eyeBlinkLeft,eyeBlinkRight,jawLeft,mouthRight,eyeLookOutLeft\n"
                    "0,0,0,0,0,0\n1,1,1,1,1,1\n")
                .text,
            "")
      << "directions";
}

TEST_F(BlendShapesFile, ShapesThatAWholeCaptureLacksAreNamed) {
  const auto notes = [&](std::size_t without) {
    std::string head = "time_s", zero = "0", one = "1";
    for (std::size_t i = 0; i < arkit_shapes().size() - without; ++i)
      head += "," + arkit_shapes()[i], zero += ",0", one += ",0.5";
    std::string all;
    for (const std::string& note :
         read_arkit(write("all.csv", head + "\n" + zero + "\n" + one + "\n")).notes)
      all += note;
    return all;
  };
  EXPECT_EQ(notes(0), "");
  EXPECT_EQ(notes(1), "1 of ARKit's 52 blend shapes have no column and count as 0: tongueOut");
  EXPECT_EQ(notes(13), "") << "a table of 39";
}

TEST_F(BlendShapesFile, SemicolonsSeparateAndADecimalCommaIsNamed) {
  const BlendShapes shapes =
      read_arkit(write("semi.csv", "Timecode;JawOpen\n13:14:04:31.166;0.1\n13:14:04:32.166;0.2\n"));
  EXPECT_EQ(shapes.weights(1, 0), 0.2);
  expect_refused(write("comma.csv", "Timecode;JawOpen\n13:14:04:31,166;0.1\n"),
                 {":2: ", "Timecode", "a point, not a comma"}, read_arkit);
}

TEST_F(BlendShapesFile, WeightsAreHeldBetweenEqualKeys) {
  const motion::Motion motion = moved_by(
      read_arkit(write("keys.csv", "time_s,jawOpen\n0,0\n0.2,0\n0.3,1\n1.3,1\n1.5,0\n2,0\n")));
  const motion::MotionCurve curve(motion);
  EXPECT_LT((curve.at(0.8) - motion.positions[2]).cwiseAbs().maxCoeff(), 1e-12);
  const double at_rest = motion.positions[0](motion.index_of("ibug68_8"), 1);
  const double open = motion.positions[2](motion.index_of("ibug68_8"), 1);
  EXPECT_LT(open, at_rest - 0.01);
  for (double t = 0; t < 2; t += 0.01) {
    const double y = curve.at(t)(motion.index_of("ibug68_8"), 1);
    EXPECT_TRUE(y >= open - 1e-12 && y <= at_rest + 1e-12) << t;
  }
}

TEST_F(BlendShapesFile, RefusesWhatItCannotRead) {
  expect_refused(write("a.csv", "jawOpen\n0\n1\n"), {"time"}, read_arkit);
  expect_refused(write("b.csv", "time_s,jaw\n0,0\n1,1\n"), {"jawOpen"}, read_arkit);
  expect_refused(write("c.csv", "time_s,jawOpen\n0,0\n1,55\n"), {":3: ", "jawOpen", "55", "0 to 1"},
                 read_arkit);
  expect_refused(write("d.csv", "time_s,jawOpen\n1,0\n1,0.5\n"), {":3: ", "later"}, read_arkit);
  expect_refused(write("e.csv", "time_s,jawOpen\n1,0\n"), {"two rows"}, read_arkit);
  expect_refused(write("f.csv", "Timecode,JawOpen\nnoon,0\n"), {":2: ", "Timecode", "noon"},
                 read_arkit);
  expect_refused(write("o.csv", "timestamp,gaze\n0,0\n1,1\n"), {"AU01_r"}, read_openface);
  expect_refused(write("p.csv", "timestamp,AU26_r\n0,0\n1,7\n"), {":3: ", "AU26_r", "7", "0 to 5"},
                 read_openface);
  expect_refused(write("units.csv", "timestamp,AU12_r\n0,0\n1,1\n"),
                 {"action units by OpenFace", "expected it as openface"}, read_arkit);
  expect_refused(write("shapes.csv", "time_s,JawOpen\n0,0\n1,1\n"),
                 {"ARKit's blend shapes", "expected it as arkit"}, read_openface);
  for (const auto read : {read_arkit, read_openface})
    expect_refused(write("scan.ply", "ply\nformat ascii 1.0\n"), {"is a scan", "table of weights"},
                   read);
  expect_refused(write("slips.csv", "time_s,jawOpn,mouthSmilleLeft\n0,0,0\n1,1,1\n"),
                 {"column jawOpn: did you mean jawOpen?",
                  "column mouthSmilleLeft: did you mean mouthSmileLeft?"},
                 read_arkit);
  expect_refused(write("t.csv", "time_s,tongueOut\n0,0\n1,1\n"), {"canonical", "tongueOut"},
                 [](const std::filesystem::path& file) { moved_by(read_arkit(file)); });
}

TEST(OpenFaceRecording, OfAPersonTalkingMovesTheMouth) {
  const std::filesystem::path file =
      std::filesystem::path(HYPEREX_SHARED_DIR) / "data/motion/openface_au_19_3.csv";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no shared data at " << file;
  const auto shapes = read_openface(file);
  EXPECT_EQ(shapes.time_s.size(), 301u);
  const motion::Motion motion = moved_by(shapes);
  double most = 0;
  for (std::size_t k = 0; k < motion.time_s.size(); ++k)
    most = std::max(most, moved(motion, "ibug68_57", k).norm());
  EXPECT_GT(most, 0.002);
  EXPECT_LT(most, 0.04);
}

}  // namespace
}  // namespace hyperex::expression
