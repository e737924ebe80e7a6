// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/still_points.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "hyperex/motion/stabilise.hpp"
#include "unit/motion/motions.hpp"

namespace hyperex::motion {
namespace {
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kPlace_m[6][3] = {{0, 0.1, 0},     {0.05, 0.1, -0.01}, {-0.05, 0.1, -0.01},
                                   {0, 0.05, 0.02}, {0.02, 0, 0.01},    {-0.02, 0, 0.01}};

/// Four points of the skull and two of the face that move by 10 mm, on a head that rotates by 10
/// degrees.
Motion nodding(double skull_m = 0) {
  return testing::sampled(21, 0.05, {"top", "left", "right", "nose", "smile", "ibug68_57"},
                          [&](double t, int p, int axis) {
                            double at[3];
                            for (int k = 0; k < 3; ++k) at[k] = kPlace_m[p][k];
                            if (p >= 4) at[0] += 0.01 * t;
                            if (p == 3) at[0] += skull_m * t;
                            const double angle = t * 10 * std::numbers::pi / 180;
                            const double turned[3] = {
                                at[0], std::cos(angle) * at[1] - std::sin(angle) * at[2],
                                std::sin(angle) * at[1] + std::cos(angle) * at[2]};
                            return turned[axis];
                          });
}

TEST(StillPoints, AreThoseThatKeepTheirDistances) {
  EXPECT_THAT(find_still_points(nodding()), ElementsAre("top", "left", "right", "nose"));
  EXPECT_THAT(find_still_points(nodding(0.5e-3)), ElementsAre("top", "left", "right", "nose"));
}

/// The same with one more point, "ear", that moves by `ear_m`.
Motion nodding_with_ear(double ear_m) {
  Motion motion = nodding();
  motion.names.push_back("ear");
  for (std::size_t k = 0; k < motion.positions.size(); ++k) {
    Points& at = motion.positions[k];
    at.conservativeResize(7, 3);
    at.row(6) = at.row(0) + Eigen::RowVector3d(ear_m * double(k) / 20, 0, 0);
  }
  return motion;
}

TEST(StillPoints, OfSeveralRecordingsKeepTheirDistancesInEach) {
  const Motion still = nodding_with_ear(0), moving = nodding_with_ear(5e-3);
  EXPECT_THAT(find_still_points(still), ElementsAre("top", "left", "right", "nose", "ear"));
  for (const auto& both : {std::vector{&still, &moving}, std::vector{&moving, &still}})
    EXPECT_THAT(find_still_points(both), ElementsAre("top", "left", "right", "nose"));
  // On another day the markers lie elsewhere, and one point is not measured.
  Motion later = nodding();
  for (Points& at : later.positions) at *= 1.2;
  EXPECT_THAT(find_still_points(std::vector<const Motion*>{&still, &later}),
              ElementsAre("top", "left", "right", "nose"));
}

TEST(StillPoints, OfSeveralRecordingsMayHaveOtherNamesOfOnePlace) {
  Motion first = nodding_with_ear(0), other = first;
  first.names = {"27", "ibug68_36", "exocanthion_L", "nose", "smile", "ibug68_57", "ear"};
  other.names = {"ibug68_27", "p36", "45", "nose", "smile", "57", "ear"};
  EXPECT_THAT(find_still_points(std::vector<const Motion*>{&first, &other}),
              ElementsAre("27", "ibug68_36", "exocanthion_L", "nose", "ear"));
  EXPECT_THAT(own_names(other, {"27", "ibug68_36", "exocanthion_L", "nose", "chin"}),
              ElementsAre("ibug68_27", "p36", "45", "nose", "chin"));
}

TEST(StillPoints, OfOnePlaceCountOnceWhereOneRecordingHasItOnce) {
  Motion twice = nodding_with_ear(0);  // its last point lies where its first one does
  twice.names = {"ibug68_36", "left", "right", "nose", "smile", "ibug68_57", "exocanthion_R"};
  Motion once = nodding();
  once.names[0] = "36";
  EXPECT_THAT(find_still_points(std::vector<const Motion*>{&twice, &once}),
              ElementsAre("ibug68_36", "left", "right", "nose"));
}

TEST(StillPoints, AreProposedForAllWhereOneLacksTheUsualPoints) {
  const Motion without = nodding_with_ear(0);
  Motion with = without;
  for (const char* name : {"ibug68_36", "ibug68_39", "ibug68_42"}) {
    with.names.push_back(name);
    for (Points& at : with.positions) {
      at.conservativeResize(at.rows() + 1, 3);
      at.row(at.rows() - 1).setZero();
    }
  }
  EXPECT_THAT(proposed_rigid_points(std::vector<const Motion*>{&with, &with}), IsEmpty());
  EXPECT_THAT(proposed_rigid_points(std::vector<const Motion*>{&with, &without}),
              ElementsAre("top", "left", "right", "nose", "ear"));
}

TEST(StillPoints, ThreeAreTooFewToBeSure) {
  EXPECT_THAT(find_still_points(nodding(5e-3)), IsEmpty());
}

TEST(StillPoints, OnALineTheyGiveNoPose) {
  const Motion motion = testing::sampled(5, 0.1, {"a", "b", "c", "d"}, [](double, int p, int axis) {
    return axis == 0 ? 0.02 * p : 0;
  });
  EXPECT_THAT(find_still_points(motion), IsEmpty());
}

TEST(StillPoints, PointsOfTheMouthAreLeftOut) {
  Motion motion = nodding();
  motion.names = {"ibug68_48", "ibug68_54", "ibug68_51", "ibug68_57", "a", "b"};
  EXPECT_THAT(find_still_points(motion), IsEmpty());
}

std::vector<std::string> unsteady(const Motion& motion, const std::vector<std::string>& names) {
  std::vector<std::string> out;
  for (const UnsteadyPoint& point : unsteady_points(motion, names, 1.5e-3))
    out.push_back(point.name);
  return out;
}

const std::vector<std::string> kOfTheSkull = {"top", "left", "right", "nose"};

TEST(UnsteadyPoints, AreThoseThatMoveAgainstTheOthers) {
  EXPECT_THAT(unsteady(nodding(), kOfTheSkull), IsEmpty());
  EXPECT_THAT(unsteady(nodding(1e-3), kOfTheSkull), IsEmpty()) << "skin over bone gives";
  EXPECT_THAT(unsteady(nodding(), {"top", "smile", "left", "right"}), ElementsAre("smile"));
  EXPECT_THAT(unsteady(nodding(), {"top", "nobody", "left"}), IsEmpty());
  const auto moved = unsteady_points(nodding(5e-3), kOfTheSkull, 1.5e-3);
  ASSERT_EQ(moved.size(), 1u);
  EXPECT_EQ(moved[0].name, "nose");
  EXPECT_NEAR(moved[0].change_m, 2.7e-3, 0.2e-3) << "of its distances from left and right";
}

TEST(UnsteadyPoints, AreAllWhereNoTwoAgree) {
  const Motion motion = testing::sampled(21, 0.05, {"a", "b", "c"}, [](double t, int p, int axis) {
    if (p == 1 && axis == 0) return 0.05 + 0.01 * t;
    return p == 2 && axis == 1 ? 0.05 + 0.02 * t : 0.0;
  });
  EXPECT_THAT(unsteady(motion, {"a", "b", "c"}), ElementsAre("a", "b", "c"));
}

TEST(UnsteadyPoints, AreNotThoseThatAreReadBadly) {
  Motion motion = nodding();
  motion.positions[7](3, 0) += 0.02;
  EXPECT_THAT(unsteady(motion, kOfTheSkull), IsEmpty()) << "one wild reading";
  std::mt19937 random(1);
  std::normal_distribution<double> noise_m(0, 0.4e-3);
  motion = testing::sampled(200, 0.03, kOfTheSkull, [&](double, int p, int axis) {
    return kPlace_m[p][axis] + noise_m(random);
  });
  EXPECT_THAT(unsteady(motion, kOfTheSkull), IsEmpty()) << "jitter";
}

TEST(StillPoints, AMissingPoseProposesThem) {
  testing::expect_refused([] { stabilise(nodding()); },
                          {"rigid_points", "as points of the skull do: top, left, right, nose"});
  EXPECT_FALSE(has_pose_points(nodding()));
}

}  // namespace
}  // namespace hyperex::motion
