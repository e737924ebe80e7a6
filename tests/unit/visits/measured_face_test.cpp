// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/visits/measured_face.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "hyperex/core/error.hpp"
#include "hyperex/motion/lowpass.hpp"
#include "hyperex/visits/scale_between.hpp"
#include "smiling_face.hpp"

namespace hyperex::visits {
namespace {
using testing::HasSubstr;

double value_of(const MeasuredFace& face, const std::string& key, const std::string& side = "") {
  return measure_named(key, side).value(face.state);
}

MeasuredFace exact(const Smile& smile, const MeasuredFace* first = nullptr) {
  return measure(recording_of(smile), visits_of(2), 0.0, first);
}

TEST(MeasuredFace, HasTheDirectionsOfTheSmile) {
  const MeasuredFace face = exact({});
  // The other corner's share at this one is below 0.2 %.
  EXPECT_NEAR(value_of(face, "corner_excursion", "R"), 1e3 * kWholeSmile.norm(), 0.05);
  EXPECT_NEAR(value_of(face, "corner_outward", "L"), 1e3 * kWholeSmile.x(), 0.05);
  // The axes lean back by some degrees: from the mouth to the eyes is not quite upright.
  EXPECT_NEAR(std::hypot(value_of(face, "corner_up", "R"), value_of(face, "corner_forward", "R")),
              1e3 * std::hypot(kWholeSmile.y(), kWholeSmile.z()), 0.05);
  EXPECT_GT(value_of(face, "corner_up", "R"), 6);
  EXPECT_LT(value_of(face, "corner_forward", "R"), 0);
  EXPECT_NEAR(value_of(face, "smile_angle", "R"),
              std::atan2(value_of(face, "corner_up", "R"), value_of(face, "corner_outward", "R")) *
                  180 / std::numbers::pi,
              1e-9);
  EXPECT_NEAR(value_of(face, "corner_difference"), 0, 0.05);
  EXPECT_NEAR(value_of(face, "corner_follows", "R"), 100, 1);
  EXPECT_GE(face.peak_s, 1.0);  // held from 1 to 2.2 s
  EXPECT_LE(face.peak_s, 2.2 + 1e-9);
  EXPECT_NEAR(face.half_s, 0.75, 0.02);
}

TEST(MeasuredFace, ADraggedCornerFollowsTheOtherWay) {
  const MeasuredFace face = exact({.right = 0, .dragged_right = 0.005});
  EXPECT_GT(value_of(face, "corner_excursion", "R"), 4.5);
  EXPECT_LT(value_of(face, "corner_outward", "R"), -4.5);
  EXPECT_LT(value_of(face, "corner_follows", "R"), 0);
}

TEST(MeasuredFace, DirectionsAreThoseOfTheFirstHead) {
  const MeasuredFace first = exact({});
  motion::Motion turned = recording_of({.right = 0.5});
  const Eigen::Isometry3d away =
      Eigen::Translation3d(0.1, -0.2, 0.5) * Eigen::AngleAxisd(1.2, Vec3(1, 2, 3).normalized());
  for (Points& at : turned.positions)
    at = ((at * away.linear().transpose()).rowwise() + away.translation().transpose()).eval();
  const MeasuredFace here = measure(turned, visits_of(2), 0.0, &first),
                     there = exact({.right = 0.5}, &first);
  EXPECT_LT(here.head_fit_m, 1e-9);
  for (const Measure& one : measures()) {
    const double a = one.value(here.state), b = one.value(there.state);
    EXPECT_EQ(std::isnan(a), std::isnan(b)) << one.key;
    if (std::isnan(a)) continue;
    EXPECT_NEAR(a, b, 1e-6) << one.key << one.side;
  }
  EXPECT_NEAR(value_of(here, "corner_along_first", "R"), 0.5e3 * kWholeSmile.norm(), 0.05);
}

/// The same with four points of a band, which sits `askew` on the head.
motion::Motion with_band(motion::Motion motion, const Eigen::Matrix3d& askew) {
  Points band(4, 3);
  band << -0.07, 0.05, -0.02, 0.07, 0.05, -0.02, -0.04, 0.08, 0.02, 0, 0.12, -0.03;
  for (int i = 1; i <= 4; ++i) motion.names.push_back("head_" + std::to_string(i));
  for (Points& at : motion.positions) {
    at.conservativeResize(at.rows() + 4, 3);
    at.bottomRows(4) = band * askew.transpose();
  }
  return motion;
}

TEST(MeasuredFace, DirectionsAreThoseOfTheSkullWhereABandIsChosen) {
  VisitsFile file = visits_of(2);
  file.rigid_points = {"head_1", "head_2", "head_3", "head_4"};
  const Eigen::Matrix3d straight = Eigen::Matrix3d::Identity(),
                        askew = Eigen::AngleAxisd(0.5, Vec3::UnitX()).toRotationMatrix();
  const MeasuredFace first = measure(with_band(recording_of({}), straight), file, 0.0, nullptr);
  const auto up = [&](const Eigen::Matrix3d& turned, const std::string& side) {
    const motion::Motion later = with_band(recording_of({.right = 0.5}), turned);
    return value_of(measure(later, file, 0.0, &first), "corner_up", side);
  };
  for (const char* side : {"R", "L"}) EXPECT_NEAR(up(askew, side), up(straight, side), 1e-6);
}

TEST(MeasuredFace, WhatHoldsTheHeadIsAChoice) {
  motion::StillPoints still;
  still.names = {"head_1", "head_2", "head_3", "head_4"};
  const motion::Motion recording = with_band(recording_of({}), Eigen::Matrix3d::Identity());
  const MeasuredFace face = measure(recording, visits_of(1), 0.0, nullptr, still);
  EXPECT_THAT(face.choices, testing::ElementsAre(HasSubstr("the head is held by head_1, ")));
  EXPECT_THAT(face.remarks, testing::IsEmpty());
  EXPECT_THAT(face.doubts, testing::IsEmpty());
}

TEST(MeasuredFace, PointsThatSeemToBeOthersAreDoubtedWithTheirVisit) {
  const session::CleanedRecording recording{
      recording_of({}),
      {make_warning("recording.point_off", "one point is off"),
       make_warning("recording.time_unit_doubtful", "milliseconds?")}};
  VisitsFile file = visits_of(1);
  file.visits[0].jitter_m = 0;
  const MeasuredFace face = measure_recording(recording, file.visits[0], file, nullptr, {}, 0);
  EXPECT_THAT(face.doubts, testing::ElementsAre("day 1 (smile.csv): one point is off"));
  EXPECT_THAT(face.remarks, testing::ElementsAre("milliseconds?"));
}

/// The other landmarks lie elsewhere at the second visit.
TEST(MeasuredFace, DirectionsAreThoseOfLandmarksThatAreChosen) {
  VisitsFile file = visits_of(2);
  file.rigid_points = {"17", "21", "26", "27"};
  const MeasuredFace first = measure(recording_of({}), file, 0.0, nullptr);
  motion::Motion later = recording_of({});
  for (Points& at : later.positions)
    for (const int i : {36, 39, 42, 45, 28, 29, 0, 16}) at(i, 2) += i % 2 ? 0.01 : -0.01;
  EXPECT_LT(measure(later, file, 0.0, &first).head_fit_m, 1e-9);
}

/// The one handed on has the head in it.
TEST(MeasuredFace, TakesThePoseThatWasEstimatedAlready) {
  motion::Motion rising = recording_of({});
  for (std::size_t k = 0; k < rising.positions.size(); ++k)
    rising.positions[k].col(1).array() += 5e-3 * rising.time_s[k];
  motion::StillPoints searched;
  searched.by_landmarks = {motion::with_still_head(rising)};
  const auto excursion_mm = [&](std::size_t recording) {
    const MeasuredFace face = measure(rising, visits_of(1), 0.0, nullptr, searched, recording);
    return value_of(face, "corner_excursion", "R");
  };
  const MeasuredFace own = measure(rising, visits_of(1), 0.0, nullptr);
  EXPECT_EQ(excursion_mm(1), value_of(own, "corner_excursion", "R")) << "none is handed on";
  EXPECT_GT(excursion_mm(0), excursion_mm(1) + 3);
}

TEST(MeasuredFace, NoiseAfterTheFilterIsThatOfManyDraws) {
  std::vector<double> time_s;
  for (int k = 0; k < 60; ++k) time_s.push_back(k < 30 ? k / 30.0 : 1 + (k - 30) / 120.0);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  constexpr int draws = 3000;
  for (const std::size_t sample : {0u, 1u, 29u, 31u, 59u}) {
    double squares = 0;
    for (int draw = 0; draw < draws / 3; ++draw) {
      const Points noise =
          Points::NullaryExpr(60, 3, [&](Eigen::Index, Eigen::Index) { return normal(random); });
      squares += motion::lowpassed(time_s, noise, 6).value.row(Eigen::Index(sample)).squaredNorm();
    }
    EXPECT_NEAR(motion::lowpassed_noise(time_s, sample, 6), std::sqrt(squares / draws), 0.04)
        << sample;
  }
  EXPECT_EQ(motion::lowpassed_noise(time_s, 5, 0), 1);
}

TEST(MeasuredFace, JitterThatDoesNotShowIsUnknown) {
  const motion::Motion recording = recording_of({});
  const MeasuredFace unknown = measure(recording, visits_of(1), std::nullopt, nullptr);
  EXPECT_FALSE(unknown.jitter_known);
  ASSERT_EQ(unknown.remarks.size(), 1u);
  EXPECT_THAT(unknown.remarks[0], HasSubstr("jitter_mm"));
  EXPECT_TRUE(measure(recording, visits_of(1), 0.0, nullptr).jitter_known);
  const MeasuredFace noisy =
      measure(recording_of({.noise_m = 3e-4}), visits_of(1), std::nullopt, nullptr);
  EXPECT_TRUE(noisy.jitter_known);
  EXPECT_NEAR(noisy.jitter_m, 3e-4, 0.5e-4);
}

TEST(MeasuredFace, RemarksNameTheFileWithoutItsFolders) {
  motion::Motion corners = recording_of({});
  corners.source = "/home/doctor/Jane Doe/smile.csv";
  for (std::size_t p = 0; p < corners.names.size(); ++p)
    if (p != 48 && p != 54) corners.names[p] = "own_" + std::to_string(p);
  const MeasuredFace face = measure(corners, visits_of(1), 0.0, nullptr);
  ASSERT_FALSE(face.remarks.empty());
  EXPECT_THAT(face.remarks.front(), HasSubstr("head pose is not taken out"));
  EXPECT_THAT(face.remarks.front(), HasSubstr("smile.csv"));
  for (const std::string& remark : face.remarks)
    EXPECT_EQ(remark.find("Jane"), std::string::npos) << remark;
}

/// Its samples from one to before another.
motion::Motion part_of(const Smile& smile, long from, long to) {
  motion::Motion m = recording_of(smile);
  m.time_s = {m.time_s.begin() + from, m.time_s.begin() + to};
  m.positions = {m.positions.begin() + from, m.positions.begin() + to};
  return m;
}

TEST(MeasuredFace, RecordingsThatStartOrEndInTheSmileAreDoubted) {
  const auto part = [](long from, long to) {
    return measure(part_of({}, from, to), visits_of(1), 0.0, nullptr).extent_doubts;
  };
  EXPECT_THAT(part(0, 90), testing::IsEmpty());
  EXPECT_THAT(part(0, 45), testing::IsEmpty()) << "held at its peak";
  EXPECT_THAT(part(0, 24), testing::ElementsAre(HasSubstr("ends in an expression")));
  EXPECT_THAT(part(40, 90), testing::ElementsAre(HasSubstr("seems to start in an expression")));
}

TEST(MeasuredFace, ARecordingInWhichNothingMovesIsDoubted) {
  const auto doubts = [](double share) {
    const motion::Motion smile = recording_of({.right = share, .left = share});
    return measure(smile, visits_of(1), 0.0, nullptr).extent_doubts;
  };
  EXPECT_THAT(doubts(0), testing::ElementsAre(HasSubstr("nothing moves in the recording")));
  EXPECT_THAT(doubts(0.1), testing::IsEmpty());
}

TEST(MeasuredFace, NoiseDoesNotHideThatNothingMoves) {
  const auto doubts = [](double share) {
    const motion::Motion smile =
        recording_of({.right = share, .left = share, .noise_m = 2e-4, .head_moves = true});
    return measure(smile, visits_of(1), std::nullopt, nullptr).extent_doubts;
  };
  EXPECT_THAT(doubts(0), testing::ElementsAre(HasSubstr("beyond its jitter of 0.")));
  EXPECT_THAT(doubts(0.2), testing::IsEmpty());
}

/// A recording in which the smile is held throughout shows no movement. Only its rest shows why.
TEST(MeasuredFace, CornersElsewhereAtRestAreDoubted) {
  const MeasuredFace first = exact({});
  const auto doubts = [&](const Smile& smile, long from, long to) {
    return measure(part_of(smile, from, to), visits_of(2), 0.0, &first).doubts;
  };
  EXPECT_THAT(doubts({}, 36, 60), testing::Contains(testing::AllOf(
                                      HasSubstr("corners of the mouth are elsewhere"),
                                      HasSubstr("the right one"), HasSubstr("the left one"))));
  EXPECT_THAT(doubts({.right = 0}, 36, 60),
              testing::Contains(testing::AllOf(HasSubstr("corners of the mouth are elsewhere"),
                                               testing::Not(HasSubstr("the right one")))));
  EXPECT_THAT(doubts({}, 0, 60), testing::IsEmpty());
}

TEST(MeasuredFace, AnotherSizeIsDoubted) {
  const MeasuredFace first = exact({});
  motion::Motion larger = recording_of({});
  for (Points& at : larger.positions) at *= 1.05;
  const MeasuredFace second = measure(larger, visits_of(2), 0.0, &first);
  ASSERT_EQ(second.doubts.size(), 1u);
  EXPECT_THAT(second.doubts[0],
              HasSubstr("it may be another person or another scale, and lengths may not be "
                        "comparable"));
}

TEST(MeasuredFace, AnotherShapeMayBeAnotherPerson) {
  const MeasuredFace first = exact({});
  const auto doubts = [&](double along_m) {
    motion::Motion other = recording_of({});
    other.source = "other.csv";
    for (Points& at : other.positions)
      for (Eigen::Index p = 0; p < at.rows(); ++p) at(p, 2) += p % 2 ? along_m : -along_m;
    return measure(other, visits_of(2), 0.0, &first).doubts;
  };
  EXPECT_THAT(doubts(0.003), testing::Not(testing::Contains(HasSubstr("another person"))));
  EXPECT_THAT(doubts(0.008), testing::Contains(testing::AllOf(
                                 HasSubstr("other.csv: the points at rest are "),
                                 HasSubstr("from those of smile.csv"),
                                 HasSubstr("(expected of one person: at most 5 mm): it may be "
                                           "another person"))));
}

TEST(MeasuredFace, AnotherScaleIsRemarkedWithBothFilesAndTheRatio) {
  // Points without names of landmarks, those of a headband among them, show the scale as well.
  const auto of_own_names = [](double scale, const std::string& file) {
    motion::Motion m = recording_of({});
    m.source = "/home/doctor/Jane Doe/" + file;
    for (std::size_t p = 0; p < m.names.size(); ++p)
      if (p < 48) m.names[p] = "head_" + std::to_string(p);
    for (Points& at : m.positions) at *= scale;
    return m;
  };
  const auto remarks = [&](double scale) {
    const MeasuredFace first = measure(of_own_names(1, "before.csv"), visits_of(2), 0.0, nullptr);
    return measure(of_own_names(scale, "after.csv"), visits_of(2), 0.0, &first).remarks;
  };
  for (const auto& [scale, words] : {std::pair{0.1, "0.1 times"}, {1.08, "1.08 times"}})
    EXPECT_THAT(remarks(scale), testing::Contains(testing::AllOf(
                                    HasSubstr("after.csv: the face at rest is "), HasSubstr(words),
                                    HasSubstr("as large as in before.csv, by "))));
  for (const double scale : {0.96, 1.0, 1.04})
    EXPECT_THAT(remarks(scale), testing::Not(testing::Contains(HasSubstr("as large as")))) << scale;
}

TEST(ScaleBetween, AllowsMoreForAMouthAlone) {
  const auto square = [](double half_m) {
    std::map<std::string, Vec3> places;
    for (int k = 0; k < 4; ++k)
      places["p" + std::to_string(k)] = Vec3(k % 2 ? half_m : -half_m, k / 2 ? half_m : -half_m, 0);
    return places;
  };
  const ScaleBetween face = scale_between(square(0.1), square(0.09));
  EXPECT_NEAR(face.ratio, 0.9, 1e-12);
  EXPECT_EQ(face.common, 4u);
  EXPECT_EQ(face.bound, 0.06);
  EXPECT_NEAR(scale_between(square(0.025 / std::sqrt(2.0)), square(0.1)).bound, 0.12, 1e-12);
  std::map<std::string, Vec3> three = square(0.1);
  three.erase("p3");
  EXPECT_TRUE(std::isnan(scale_between(three, square(0.1)).ratio));
  EXPECT_TRUE(std::isnan(scale_between(square(0), square(0.1)).ratio));
}

TEST(MeasuredFace, NeedsThePointsOfTheExpression) {
  VisitsFile file = visits_of(1);
  motion::Motion few = recording_of({});
  few.names.resize(48);
  for (Points& at : few.positions) at.conservativeResize(48, 3);
  EXPECT_THAT([&] { measure(few, file, 0.0, nullptr); },
              testing::ThrowsMessage<InputError>(HasSubstr("corners of the mouth")));
  file.expression = *expression_named("eye closure");
  const MeasuredFace lids = measure(few, file, 0.0, nullptr);
  EXPECT_TRUE(std::isnan(value_of(lids, "corner_excursion", "R")));
  EXPECT_GT(value_of(lids, "eye_opening", "R"), 3);
}

}  // namespace
}  // namespace hyperex::visits
