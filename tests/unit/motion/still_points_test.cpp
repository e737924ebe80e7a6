// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/still_points.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "hyperex/face/canonical_face.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/face/words_to_point.hpp"
#include "hyperex/motion/rigid_set.hpp"
#include "hyperex/motion/stabilise.hpp"
#include "unit/motion/motions.hpp"

namespace hyperex::motion {
namespace {
using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
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

TEST(StillPoints, AreNotLostByOneWildReading) {
  Motion motion = nodding();
  motion.positions[7](1, 0) += 0.02;
  EXPECT_THAT(find_still_points(motion), ElementsAre("top", "left", "right", "nose"));
}

/// Its fourth differences look like jitter.
TEST(StillPoints, OfFewSamplesAreNotThoseOfAQuickHead) {
  const std::vector<Vec3> places = {{-0.07, 0.05, -0.02}, {0.07, 0.05, -0.02},  {-0.04, 0.08, 0.02},
                                    {0.04, 0.08, 0.02},   {0, 0.09, 0.03},      {0, 0.12, -0.03},
                                    {0.05, -0.02, 0.02},  {-0.05, -0.02, 0.02}, {0.03, 0, 0.03},
                                    {-0.03, 0, 0.03}};
  const Vec3 moves[] = {{2e-3, 5e-3, 0}, {-2e-3, 5e-3, 0}, {1e-3, 3e-3, 0}, {-1e-3, 3e-3, 0}};
  const Motion motion = testing::sampled(
      5, 0.25, {"a", "b", "c", "d", "e", "f", "cheek_1", "cheek_2", "cheek_3", "cheek_4"},
      [&](double t, int p, int axis) {
        const double share = std::sin(t * std::numbers::pi);
        Vec3 at = places[std::size_t(p)];
        if (p >= 6) at += share * moves[p - 6];
        at += share * Vec3(0.05, 0.02, 0.01);
        return at[axis];
      });
  EXPECT_THAT(find_still_points(motion), ElementsAre("a", "b", "c", "d", "e", "f"));
}

/// Takes readings of a point away.
void lose(Motion& motion, const std::string& name, std::size_t first, std::size_t count) {
  for (std::size_t k = first; k < first + count; ++k)
    motion.positions[k].row(motion.index_of(name)).setConstant(testing::nan);
}

TEST(StillPoints, AreNotLostByAShortGap) {
  Motion torn = nodding();
  lose(torn, "left", 7, 2);
  EXPECT_THAT(find_still_points(torn), ElementsAre("top", "left", "right", "nose"));
  Motion whole = nodding();
  for (const auto& [first, second] : {std::pair{&torn, &whole}, {&whole, &torn}})
    EXPECT_THAT(find_still_points(std::vector<const Motion*>{first, second}),
                ElementsAre("top", "left", "right", "nose"));
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

/// Both change one distance too much. The second has changed that from the first point, too.
TEST(UnsteadyPoints, OfTwoThatPartIsTheOneThatAlsoLeavesAThird) {
  const Motion motion = testing::sampled(21, 0.05, {"a", "b", "c"}, [](double t, int p, int axis) {
    if (axis != 0) return 0.0;
    return p == 1 ? 0.02 - 1.5e-3 * t : p == 2 ? 0.05 + 1e-3 * t : 0.0;
  });
  EXPECT_THAT(unsteady(motion, {"a", "b", "c"}), ElementsAre("b"));
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

const std::vector<std::string> kBand = {"head_1", "head_2", "head_3", "head_4", "head_5", "head_6"};
const std::vector<Vec3> kOnBand = {{-0.07, 0.05, -0.02}, {0.07, 0.05, -0.02}, {-0.04, 0.08, 0.02},
                                   {0.04, 0.08, 0.02},   {0, 0.09, 0.03},     {0, 0.12, -0.03}};

/// All landmarks on a head that turns while the mouth opens by `opens_m`, and six points more at
/// `places`, which `move` displaces by the share of the opening.
Motion landmarks_with(const std::vector<Vec3>& places, double opens_m,
                      const std::function<Vec3(std::size_t point, double share)>& move,
                      double noise_m = 0, unsigned seed = 5) {
  const face::CanonicalFace& face = face::canonical_face();
  Motion motion;
  motion.names = face::all_ibug();
  for (std::size_t p = 0; p < places.size(); ++p) motion.names.push_back(kBand[p]);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 60; ++k) {
    const double share = std::sin(k * std::numbers::pi / 60);
    const Eigen::AngleAxisd turned(0.1 * share, Vec3::UnitY());
    Points at(Eigen::Index(motion.names.size()), 3);
    for (std::size_t p = 0; p < motion.names.size(); ++p) {
      Vec3 x;
      if (p < face::all_ibug().size()) {
        x = face.landmark(motion.names[p], face.mesh.points);
        if (face::moves_with_mouth(motion.names[p])) x.y() -= opens_m * share;
      } else {
        const std::size_t own = p - face::all_ibug().size();
        x = places[own] + move(own, share);
      }
      x = turned * x;
      for (int axis = 0; axis < 3; ++axis) x[axis] += noise_m * normal(random);
      at.row(Eigen::Index(p)) = x.transpose();
    }
    motion.time_s.push_back(k / 30.0);
    motion.positions.push_back(at);
  }
  return motion;
}

Vec3 none(std::size_t, double) {
  return Vec3::Zero();
}

TEST(StillPointsBesideLandmarks, AreThoseOfABand) {
  const Motion band = landmarks_with(kOnBand, 0.01, none);
  ASSERT_TRUE(has_pose_points(band));
  EXPECT_THAT(still_points_beside_landmarks(stabilise(band)), ElementsAreArray(kBand));
  EXPECT_THAT(points_to_hold_the_head(band).names, ElementsAreArray(kBand));
  EXPECT_THAT(points_to_hold_the_head(band).left_out, IsEmpty());
  EXPECT_THAT(proposed_rigid_points(band), IsEmpty()) << "landmarks give a pose";
  EXPECT_THAT(still_points_beside_landmarks(stabilise(band, {.rigid_points = kBand})), IsEmpty())
      << "they are used";
  EXPECT_THAT(points_to_hold_the_head(nodding()).names,
              ElementsAre("top", "left", "right", "nose"));
}

TEST(StillPointsBesideLandmarks, AreAllFoundInNoise) {
  for (const double noise_m : {0.05e-3, 0.2e-3, 0.5e-3})
    for (const unsigned seed : {1u, 2u, 3u, 4u, 5u})
      EXPECT_THAT(points_to_hold_the_head(landmarks_with(kOnBand, 0.01, none, noise_m, seed)).names,
                  ElementsAreArray(kBand))
          << noise_m << ", " << seed;
}

void nod_quickly(Motion& motion) {
  for (std::size_t k = 0; k < motion.positions.size(); ++k) {
    const double angle = 0.15 * std::sin(4 * std::numbers::pi * motion.time_s[k]);
    const Eigen::Matrix3d nod = Eigen::AngleAxisd(angle, Vec3::UnitX()).toRotationMatrix();
    motion.positions[k] = (motion.positions[k] * nod.transpose()).eval();
  }
}

TEST(StillPointsBesideLandmarks, AreAllFoundWhereTheHeadNodsQuickly) {
  Motion motion = landmarks_with(kOnBand, 0.01, none);
  nod_quickly(motion);
  EXPECT_THAT(points_to_hold_the_head(motion).names, ElementsAreArray(kBand));
}

/// A head that nods quickly leaves a gap on another way than it came.
TEST(StillPointsBesideLandmarks, AreNotLostByAShortGap) {
  for (const std::size_t first : {0u, 20u, 55u}) {
    Motion motion = landmarks_with(kOnBand, 0.01, none);
    nod_quickly(motion);
    lose(motion, "head_3", first, 5);
    lose(motion, "head_1", 30, 1);
    EXPECT_THAT(points_to_hold_the_head(motion).names, ElementsAreArray(kBand)) << first;
    EXPECT_NO_THROW(stabilise(motion, {.rigid_points = kBand})) << first;
  }
  Motion motion = landmarks_with(kOnBand, 0.01, none);
  lose(motion, "head_3", 20, 6);
  EXPECT_THAT(points_to_hold_the_head(motion).names,
              ElementsAre("head_1", "head_2", "head_4", "head_5", "head_6"))
      << "a run does not fill so long a gap";
}

TEST(StillPointsBesideLandmarks, HoldTheHeadInEverySample) {
  Motion motion = landmarks_with(kOnBand, 0.01, none);
  for (const char* name : {"head_1", "head_2", "head_3"}) lose(motion, name, 20, 1);
  EXPECT_THAT(points_to_hold_the_head(motion).names, ElementsAreArray(kBand)) << "three are left";
  lose(motion, "head_4", 20, 1);
  EXPECT_THAT(points_to_hold_the_head(motion).names, IsEmpty()) << "the landmarks hold it";
}

/// Three of three are enough, three of four are not: a lost reading of the cheek costs no band.
TEST(StillPointsBesideLandmarks, AreNotLostByAGapOfAPointThatMoves) {
  const std::vector<Vec3> places = {kOnBand[0], kOnBand[1], kOnBand[4], {0.03, 0, 0.03}};
  const Motion whole = landmarks_with(places, 0.01, [](std::size_t p, double share) {
    return Vec3(0, p == 3 ? 5e-3 * share : 0, 0);
  });
  EXPECT_THAT(points_to_hold_the_head(whole).names, IsEmpty());
  Motion torn = whole;
  lose(torn, "head_4", 20, 1);
  EXPECT_THAT(points_to_hold_the_head(torn).names, ElementsAre("head_1", "head_2", "head_3"));
}

TEST(StillPointsBesideLandmarks, HandOnThePoseByTheLandmarks) {
  const Motion speechless = landmarks_with(kOnBand, 0, none);
  const StillPoints found = points_to_hold_the_head(std::vector{&speechless, &speechless});
  EXPECT_THAT(found.names, IsEmpty()) << "the face does not move";
  ASSERT_EQ(found.by_landmarks.size(), 2u);
  const StabilisedMotion again = stabilise(speechless);
  for (const StabilisedMotion& steady : found.by_landmarks) {
    EXPECT_EQ(testing::greatest_difference(steady.motion, again.motion), 0);
    EXPECT_EQ(steady.shift_uncertainty_m, again.shift_uncertainty_m);
  }
  EXPECT_TRUE(points_to_hold_the_head(landmarks_with(kOnBand, 0.01, none)).by_landmarks.empty());
}

/// Every tenth sample is judged: between two of them the head turns by up to 8 degrees.
TEST(LargestRigidSet, OfALongRecordingIsFoundInNoise) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise_m(0, 0.1e-3);
  const Motion motion = testing::sampled(4000, 1 / 30.0, kBand, [&](double t, int p, int axis) {
    const Vec3 at =
        Eigen::AngleAxisd(0.2 * std::sin(2 * t), Vec3::UnitX()) * kOnBand[std::size_t(p)];
    return at[axis] + noise_m(random);
  });
  const TrackedPoints tracked = tracked_points(motion, {0, 1, 2, 3, 4, 5});
  EXPECT_EQ(tracked.positions.size(), 400u);
  EXPECT_THAT(largest_rigid_set({tracked}, 0.2e-3).points, ElementsAre(0, 1, 2, 3, 4, 5));
}

/// Two points slip by less than their distances show. They turn the pose of the set, so that four
/// seem to move: the two, and two that are still and would be lost if they went first.
TEST(LargestRigidSet, FirstLosesThePointWithoutWhichTheOthersAreStillest) {
  TrackedPoints tracked;
  tracked.jitter_m.assign(kOnBand.size(), 0.5e-3);
  tracked.shortest = 5;
  for (int k = 0; k < 400; ++k) {
    Points at(Eigen::Index(kOnBand.size()), 3);
    for (std::size_t p = 0; p < kOnBand.size(); ++p)
      at.row(Eigen::Index(p)) = kOnBand[p].transpose();
    if (k >= 200) {
      at(3, 0) += 2e-3;
      at(5, 2) += 1.5e-3;
    }
    tracked.positions.push_back(at);
  }
  const RigidSet set = largest_rigid_set({tracked}, 0.2e-3);
  EXPECT_THAT(set.points, ElementsAre(0, 1, 2, 4));
  EXPECT_THAT(set.left_out, ElementsAre(3, 5));
  ASSERT_EQ(set.moves_m.size(), kOnBand.size());
  EXPECT_NEAR(set.moves_m[3], 2e-3, 1e-6);
  EXPECT_NEAR(set.moves_m[5], 1.5e-3, 1e-6);
}

TEST(StillPointsBesideLandmarks, NameTheOneThatMovesInNoise) {
  const auto slips = [](std::size_t p, double share) {
    return Vec3(p == 3 ? 1.3e-3 * share : 0, 0, 0);
  };
  for (const unsigned seed : {1u, 2u, 3u}) {
    const StillPoints found =
        points_to_hold_the_head(landmarks_with(kOnBand, 0.01, slips, 0.1e-3, seed));
    EXPECT_THAT(found.names, ElementsAre("head_1", "head_2", "head_3", "head_5", "head_6"));
    ASSERT_EQ(found.left_out.size(), 1u);
    EXPECT_EQ(found.left_out[0].name, "head_4");
    EXPECT_NEAR(found.left_out[0].change_m, 1.3e-3, 0.4e-3);
  }
}

TEST(StillPointsBesideLandmarks, OfSeveralRecordingsAreStillInEach) {
  const Motion still = landmarks_with(kOnBand, 0.01, none, 0.1e-3);
  const Motion slips = landmarks_with(
      kOnBand, 0.01,
      [](std::size_t p, double share) { return Vec3(p == 3 ? 3e-3 * share : 0, 0, 0); }, 0.1e-3);
  for (const auto& both : {std::vector{&still, &slips}, std::vector{&slips, &still}})
    EXPECT_THAT(points_to_hold_the_head(both).names,
                ElementsAre("head_1", "head_2", "head_3", "head_5", "head_6"));
  const Motion without = landmarks_with({}, 0.01, none);
  EXPECT_THAT(points_to_hold_the_head(std::vector{&still, &without}).names, IsEmpty())
      << "one recording has no band: the landmarks hold both";
}

TEST(StillPointsBesideLandmarks, AreEnoughAndFarApart) {
  const auto found = [](const std::vector<Vec3>& places) {
    return still_points_beside_landmarks(stabilise(landmarks_with(places, 0.01, none))).size();
  };
  EXPECT_EQ(found({kOnBand[0], kOnBand[1], kOnBand[4]}), 3u) << "all three";
  EXPECT_EQ(found({kOnBand[0], kOnBand[1]}), 0u);
  std::vector<Vec3> small = kOnBand;
  for (Vec3& place : small) place = 0.3 * place + Vec3(0, 0.06, 0.03);
  EXPECT_EQ(found(small), 0u);
  EXPECT_EQ(found({{-0.06, 0.08, 0}, {-0.02, 0.08, 0}, {0.02, 0.08, 0}, {0.06, 0.08, 0}}), 0u)
      << "on a line";
}

TEST(StillPointsBesideLandmarks, AreNotTheSkin) {
  const auto found = [](const auto& move, double opens_m = 0.01) {
    return still_points_beside_landmarks(stabilise(landmarks_with(kOnBand, opens_m, move)));
  };
  EXPECT_THAT(found([](std::size_t p, double share) {
                return Vec3(0, 0.7e-3 * share * (p % 2 == 0 ? 1 : -1), 0.4e-3 * share * double(p));
              }),
              IsEmpty())
      << "a forehead that hardly moves";
  EXPECT_THAT(found([](std::size_t, double share) { return Vec3(0, -0.02 * share, 0); }), IsEmpty())
      << "six of the lower teeth";
  EXPECT_THAT(found(none, 0), IsEmpty()) << "the face does not move";
  // One that slips takes nothing from the others.
  EXPECT_THAT(
      found([](std::size_t p, double share) { return Vec3(p == 2 ? 3e-3 * share : 0, 0, 0); }),
      ElementsAre("head_1", "head_2", "head_4", "head_5", "head_6"));
}

TEST(StillPointsBesideLandmarks, OfManyAreMoreThanAFew) {
  Motion motion = landmarks_with(kOnBand, 0.01, none);
  for (int extra = 0; extra < 8; ++extra) {
    motion.names.push_back("cheek_" + std::to_string(extra));
    for (std::size_t k = 0; k < motion.positions.size(); ++k) {
      Points& at = motion.positions[k];
      at.conservativeResize(at.rows() + 1, 3);
      at.row(at.rows() - 1) = Eigen::RowVector3d(0.01 * extra, 1e-3 * double(k * extra), 0.05);
    }
  }
  EXPECT_THAT(still_points_beside_landmarks(stabilise(motion)), ElementsAreArray(kBand));
  motion.names[68] = "left middle of the brow";  // words for a landmark
  EXPECT_THAT(still_points_beside_landmarks(stabilise(motion)), IsEmpty()) << "five of thirteen";
}

TEST(StillPointsBesideLandmarks, OfRealRecordingsAreTheBandAlone) {
  const std::vector<Motion> all = testing::recordings_of_faces();
  if (all.empty()) GTEST_SKIP() << "the shared recordings are not here";
  std::size_t with_band = 0;
  for (const Motion& motion : all) {
    if (!has_pose_points(motion)) continue;
    const auto still = still_points_beside_landmarks(stabilise(motion));
    const bool has_band = motion.index_of("head_1") >= 0;
    with_band += has_band;
    EXPECT_THAT(still, ElementsAreArray(has_band ? kBand : std::vector<std::string>()))
        << motion.source;
    if (!has_band) continue;
    // The skin of brows and cheeks, as if nobody knew its landmarks.
    Motion nameless = motion;
    for (const int i : {0, 1, 2, 3, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26})
      if (const int row = nameless.index_of(face::ibug(i)); row >= 0)
        nameless.names[std::size_t(row)] = "skin_" + std::to_string(i);
    EXPECT_THAT(still_points_beside_landmarks(stabilise(nameless)), ElementsAreArray(kBand));
    for (const std::string& name : kBand)
      nameless.names[std::size_t(nameless.index_of(name))] = "lip " + name;
    EXPECT_THAT(still_points_beside_landmarks(stabilise(nameless)), IsEmpty()) << "skin alone";
  }
  EXPECT_GE(with_band, 1u);
}

TEST(StillPoints, AMissingPoseProposesThem) {
  testing::expect_refused(
      [] { stabilise(nodding()); },
      {"rigid_points",
       "these keep still against each other, as points of the skull do: top, left, right, nose"});
  EXPECT_FALSE(has_pose_points(nodding()));
}

}  // namespace
}  // namespace hyperex::motion
