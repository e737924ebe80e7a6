// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/symmetry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "hyperex/core/error.hpp"
#include "support/refusal.hpp"

namespace hyperex::metrics {
namespace {

using ::testing::HasSubstr;

const std::vector<std::string> anatomical = {"cheilion", "exocanthion", "palpebrale_inferius",
                                             "alare", "crista_philtri_inferior"};

// A face that is symmetric about x = 0, at rest for two samples.
motion::Motion mirrored() {
  motion::Motion motion;
  Points sample(10, 3);
  const double left[5][3] = {
      {25, 0, 0}, {45, 65, -10}, {30, 50, 0}, {17, 30, 15}, {5, 12, 8}};  // mm
  for (int k = 0; k < 5; ++k)
    for (int side = 0; side < 2; ++side) {
      motion.names.push_back(anatomical[k] + (side == 0 ? "_L" : "_R"));
      const double sign = side == 0 ? 1e-3 : -1e-3;
      sample.row(2 * k + side) << sign * left[k][0], 1e-3 * left[k][1], 1e-3 * left[k][2];
    }
  motion.time_s = {0, 0.1};
  motion.positions = {sample, sample};
  return motion;
}

double length(const Points& sample, int a, int b) {
  return (sample.row(a) - sample.row(b)).norm();
}

TEST(Symmetry, FollowsItsFormula) {
  motion::Motion motion = mirrored();
  Points& moved = motion.positions[1];
  moved.row(0) += Eigen::RowVector3d(0.004, 0.006, -0.001);  // the left mouth corner goes up
  const SymmetryCurve curve = symmetry_of(motion);
  double xi = 0;
  for (const int other : {2, 4, 6, 8})
    xi += length(moved, 0, other) / length(motion.positions[0], 0, other) - 1;
  EXPECT_NEAR(curve.xi_left[1], xi, 1e-14);
  EXPECT_EQ(curve.xi_right[1], 0);
  EXPECT_NEAR(curve.s[1], std::log(std::abs(xi)), 1e-12);
  EXPECT_TRUE(curve.stand_ins.empty());
}

TEST(Symmetry, OfAMirroredMotionIsTheFloor) {
  motion::Motion motion = mirrored();
  for (const int side : {0, 1}) motion.positions[1](side, 1) -= 0.01;
  const SymmetryCurve curve = symmetry_of(motion, 1e-5);
  EXPECT_NE(curve.xi_left[1], 0);
  EXPECT_DOUBLE_EQ(curve.s[1], std::log(1e-5));
  EXPECT_DOUBLE_EQ(curve.s[0], std::log(1e-5));
}

TEST(Symmetry, DoesNotSeeTheHeadMove) {
  motion::Motion motion = mirrored();
  motion.positions[1](1, 1) += 0.005;
  const SymmetryCurve still = symmetry_of(motion);
  const Eigen::AngleAxisd turn(0.7, Vec3(1, 2, -1).normalized());
  motion.positions[1] = ((motion.positions[1] * turn.toRotationMatrix().transpose()).rowwise() +
                         Eigen::RowVector3d(0.2, -0.4, 0.7))
                            .eval();
  EXPECT_NEAR(symmetry_of(motion).s[1], still.s[1], 1e-10);
}

TEST(Symmetry, IbugPointsStandIn) {
  motion::Motion motion = mirrored();
  const SymmetryCurve own = symmetry_of(motion);
  // One lid point becomes two about it.
  motion.names = {"ibug68_54", "ibug68_48", "ibug68_45", "ibug68_36", "ibug68_46", "ibug68_40",
                  "ibug68_35", "ibug68_31", "ibug68_52", "ibug68_50", "ibug68_47", "ibug68_41"};
  for (Points& sample : motion.positions) {
    sample.conservativeResize(12, 3);
    sample.bottomRows(2) = sample.middleRows(4, 2);
    sample.middleRows(4, 2).col(0).array() -= 0.003;
    sample.bottomRows(2).col(0).array() += 0.003;
    sample(0, 1) += &sample == &motion.positions[1] ? 0.01 : 0;
  }
  const SymmetryCurve curve = symmetry_of(motion);
  EXPECT_EQ(curve.stand_ins.size(), 10u);
  EXPECT_THAT(curve.stand_ins, ::testing::Contains("exocanthion_L: ibug68_45"));
  EXPECT_THAT(curve.stand_ins,
              ::testing::Contains("palpebrale_inferius_R: mean of ibug68_40 and ibug68_41"));
  motion::Motion named = mirrored();
  named.positions[1](0, 1) += 0.01;
  EXPECT_NEAR(curve.xi_left[1], symmetry_of(named).xi_left[1], 1e-14);
}

TEST(Symmetry, NamesWhatIsMissing) {
  motion::Motion motion = mirrored();
  motion.names[2] = "something";  // exocanthion_L
  EXPECT_THAT(test::refusal([&] { symmetry_of(motion); }),
              ::testing::AllOf(HasSubstr("exocanthion_L (or ibug68_45)"),
                               ::testing::Not(HasSubstr("exocanthion_R"))));
}

TEST(Symmetry, IsNotKnownWithoutItsPoints) {
  motion::Motion motion = mirrored();
  EXPECT_TRUE(symmetry_of(motion).known());
  const SymmetryCurve none = symmetry_without_points(motion, 1e-4);
  EXPECT_FALSE(none.known());
  EXPECT_FALSE(SymmetryCurve{}.known());
  EXPECT_EQ(none.time_s, motion.time_s);
  for (const auto* values : {&none.xi_left, &none.xi_right, &none.s}) {
    ASSERT_EQ(values->size(), motion.time_s.size());
    EXPECT_TRUE(std::isnan(values->back()));
  }
}

TEST(Symmetry, RefusesABadFloorAndAnUnmeasuredStart) {
  motion::Motion motion = mirrored();
  EXPECT_THROW(symmetry_of(motion, 0), InputError);
  EXPECT_THROW(symmetry_of(motion, -1), InputError);
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(symmetry_of(motion, not_a_number), InputError);
  motion.positions[1].row(0).setConstant(not_a_number);
  EXPECT_TRUE(std::isnan(symmetry_of(motion).s[1]));
  motion.positions[0].row(0).setConstant(not_a_number);
  EXPECT_THROW(symmetry_of(motion), InputError);
}

double xi_apart(const SymmetryCurve& curve) {
  return std::abs(curve.xi_left[1] - curve.xi_right[1]);
}

void add_noise(motion::Motion& motion, double jitter_m, std::mt19937& generator) {
  std::normal_distribution<double> noise(0, jitter_m);
  for (Points& sample : motion.positions)
    for (Eigen::Index k = 0; k < sample.size(); ++k) sample.data()[k] += noise(generator);
}

// White noise on a symmetric motion stays below the floor in 95 of 100 cases, at rest and in
// motion, also where a lid is the mean of two points.
TEST(Symmetry, NoiseFloorHoldsNinetyFiveOfAHundredNoisyMotions) {
  constexpr double jitter_m = 3e-4;
  constexpr int trials = 4000;
  motion::Motion still = mirrored(), opened = mirrored(), lids = mirrored();
  for (const int side : {0, 1}) {
    opened.positions[1].row(side) += Eigen::RowVector3d(0, -0.02, -0.005);
    opened.positions[1](8 + side, 1) += 0.004;
  }
  lids.names = {"ibug68_54", "ibug68_48", "ibug68_45", "ibug68_36", "ibug68_46", "ibug68_40",
                "ibug68_35", "ibug68_31", "ibug68_52", "ibug68_50", "ibug68_47", "ibug68_41"};
  for (Points& sample : lids.positions) {
    sample.conservativeResize(12, 3);
    // Near the corner of the mouth, where their share in the noise is large.
    sample.block<2, 1>(4, 1).setConstant(0.015);
    sample.bottomRows(2) = sample.middleRows(4, 2);
  }
  for (const motion::Motion& exact : {still, opened, lids}) {
    const double floor = symmetry_noise(exact, jitter_m)[1];
    std::mt19937 generator(1);
    int under = 0;
    double squares = 0;
    for (int i = 0; i < trials; ++i) {
      motion::Motion noisy = exact;
      add_noise(noisy, jitter_m, generator);
      const double apart = xi_apart(symmetry_of(noisy));
      under += apart < floor;
      squares += apart * apart;
    }
    EXPECT_NEAR(floor / 1.96 / std::sqrt(squares / trials), 1, 0.04);
    EXPECT_NEAR(under / double(trials), 0.95, 0.012);
  }
}

TEST(Symmetry, WhatIsUnderTheNoiseIsUndecided) {
  motion::Motion motion = mirrored();
  motion.positions[1](0, 1) += 0.001;
  const SymmetryCurve exact = symmetry_of(motion);
  EXPECT_TRUE(exact.noise.empty());
  EXPECT_FALSE(exact.undecided(1));
  const double apart = xi_apart(exact), per_metre = symmetry_noise(motion, 1)[1];
  EXPECT_FALSE(symmetry_of(motion, 1e-6, 0.99 * apart / per_metre).undecided(1));
  EXPECT_TRUE(symmetry_of(motion, 1e-6, 1.01 * apart / per_metre).undecided(1));
  EXPECT_THROW(symmetry_of(motion, 1e-6, -1e-3), InputError);
  motion.positions[1].row(0).setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(symmetry_of(motion).undecided(1));
}

// Two seconds; the face moves in the second one.
motion::Motion half_at_rest() {
  motion::Motion motion = mirrored();
  const Points rest = motion.positions[0];
  motion.time_s.clear();
  motion.positions.clear();
  for (int k = 0; k < 60; ++k) {
    Points sample = rest;
    if (k > 30) sample.col(1).array() -= 0.02 * std::sin(0.2 * (k - 30));
    motion.time_s.push_back(k / 30.0);
    motion.positions.push_back(sample);
  }
  return motion;
}

TEST(Symmetry, JitterIsFoundWhereTheFaceRests) {
  EXPECT_NEAR(jitter_at_rest(half_at_rest()), 0, 1e-12);
  std::mt19937 generator(3);
  motion::Motion noisy = half_at_rest();
  add_noise(noisy, 3e-4, generator);
  EXPECT_NEAR(jitter_at_rest(noisy) / 3e-4, 1, 0.1);
  motion::Motion brief = mirrored();
  EXPECT_TRUE(std::isnan(jitter_at_rest(brief)));
}

}  // namespace
}  // namespace hyperex::metrics
