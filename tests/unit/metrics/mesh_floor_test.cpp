// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/mesh_floor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace hyperex::metrics {
namespace {

/// The ten points of S(t), mirror-symmetric about x = 0, and their displacements in the second
/// sample.
motion::Motion ten_points(const std::function<Vec3(const std::string&)>& moved) {
  motion::Motion motion;
  const std::vector<std::pair<std::string, Vec3>> left = {
      {"cheilion", {25, -35, 5}},
      {"exocanthion", {45, 30, 0}},
      {"palpebrale_inferius", {32, 25, 5}},
      {"alare", {17, -5, 12}},
      {"crista_philtri_inferior", {5, -25, 14}}};
  motion.time_s = {0, 0.1, 0.2};
  Points rest(10, 3);
  for (const auto& [name, at] : left)
    for (const int side : {1, -1}) {
      rest.row(Eigen::Index(motion.names.size())) << 1e-3 * side * at.x(), 1e-3 * at.y(),
          1e-3 * at.z();
      motion.names.push_back(name + (side > 0 ? "_L" : "_R"));
    }
  motion.positions.assign(3, rest);
  for (Eigen::Index i = 0; i < 10; ++i)
    for (int k = 1; k < 3; ++k)
      motion.positions[std::size_t(k)].row(i) +=
          k / 2.0 * moved(motion.names[std::size_t(i)]).transpose();
  return motion;
}

Vec3 smile_of(const std::string& name) {
  const double side = name.ends_with("_L") ? 1 : -1;
  return name.starts_with("cheilion") ? Vec3(side * 0.006, 0.008, 0) : Vec3::Zero();
}

double most(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

TEST(MeshFloor, OfAnEvenMeshIsTheResolutionAlone) {
  const auto motion = ten_points(smile_of);
  for (const Stretches& sample : twin_remainders(motion, motion))
    for (const double value : sample) EXPECT_NEAR(value, 0, 1e-12);
  EXPECT_NEAR(excursion_mesh_floor_mm(motion, motion, 0, 1), 0.1, 1e-9);
  const auto floor = xi_mesh_floor(motion, motion, twin_remainders(motion, motion));
  const auto resolution = symmetry_noise(motion, 1e-4 / 1.959964 / 2);
  for (std::size_t i = 0; i < floor.size(); ++i) EXPECT_NEAR(floor[i], resolution[i], 1e-12);
}

TEST(MeshFloor, AOneSidedMotionOnAnEvenMeshIsDecided) {
  const auto left =
      ten_points([](auto& n) { return n.ends_with("_L") ? smile_of(n) : Vec3(0, 0, 0); });
  const auto right =
      ten_points([](auto& n) { return n.ends_with("_R") ? smile_of(n) : Vec3(0, 0, 0); });
  SymmetryCurve curve = symmetry_of(left);
  Excursions pairs = excursions_of(left);
  add_mesh_floor(curve, pairs, left, right);
  EXPECT_FALSE(curve.undecided(2));
  EXPECT_FALSE(pairs.pairs.front().undecided);
  EXPECT_NEAR(pairs.pairs.front().mesh_floor_mm, 0.1, 1e-9)
      << "10 mm, and the twin's other side too";
}

TEST(MeshFloor, ASymmetricMotionThatTheMeshBendsIsUndecided) {
  // The mesh lets the left corner move 7 % farther, whatever drives it.
  const auto bent =
      ten_points([](auto& n) { return Vec3((n.ends_with("_L") ? 1.07 : 1.0) * smile_of(n)); });
  SymmetryCurve curve = symmetry_of(bent);
  Excursions pairs = excursions_of(bent);
  EXPECT_FALSE(curve.undecided(2)) << "to an exact motion without a twin";
  EXPECT_FALSE(pairs.pairs.front().undecided);
  add_mesh_floor(curve, pairs, bent, bent);
  EXPECT_TRUE(curve.undecided(1));
  EXPECT_TRUE(curve.undecided(2));
  EXPECT_TRUE(pairs.pairs.front().undecided);
  EXPECT_NEAR(pairs.pairs.front().mesh_floor_mm, 0.7 + 0.1, 1e-9);
  EXPECT_GE(most(curve.mesh_noise), std::abs(curve.xi_left[2] - curve.xi_right[2]));
}

TEST(MeshFloor, ErrorsThatCancelInXiStillCount) {
  // The left eye's corner gives what the left wing of the nose takes.
  const auto motion = ten_points([](auto& n) {
    if (n == "exocanthion_L") return Vec3(0, 0.001, 0);
    return n == "alare_L" ? Vec3(0, -0.00045, 0) : Vec3(0, 0, 0);
  });
  const SymmetryCurve curve = symmetry_of(motion);
  const auto floor = xi_mesh_floor(motion, motion, twin_remainders(motion, motion));
  const auto resolution = symmetry_noise(motion, 1e-4 / 1.959964 / 2);
  EXPECT_GT(floor[2] - resolution[2], 3 * std::abs(curve.xi_left[2] - curve.xi_right[2]));
}

TEST(MeshFloor, OfWhatAVariantAddsIsThatOfTheDifference) {
  const auto own = ten_points(smile_of);
  const auto bent =
      ten_points([](auto& n) { return Vec3((n.ends_with("_L") ? 1.07 : 1.0) * smile_of(n)); });
  const auto bent_more =
      ten_points([](auto& n) { return Vec3((n.ends_with("_L") ? 1.08 : 1.0) * smile_of(n)); });
  const auto curve = [](const motion::Motion& motion) {
    SymmetryCurve made = symmetry_of(motion);
    made.mesh_remainder = twin_remainders(motion, motion);
    return made;
  };
  EXPECT_EQ(added_mesh_floor(curve(bent), curve(bent)), 0) << "the same mesh bends both alike";
  EXPECT_LT(added_mesh_floor(curve(bent_more), curve(bent)),
            0.2 * added_mesh_floor(curve(bent), curve(own)));
  EXPECT_GT(added_mesh_floor(curve(bent_more), curve(bent)), 0);
  EXPECT_TRUE(std::isnan(added_mesh_floor(curve(bent), symmetry_of(bent))));
}

PairExcursion travels(double left_mm, double right_mm, double twin_left_mm, double twin_right_mm) {
  PairExcursion pair;
  pair.left_side.excursion_mm = left_mm;
  pair.right_side.excursion_mm = right_mm;
  pair.twin_left_mm = twin_left_mm;
  pair.twin_right_mm = twin_right_mm;
  return pair;
}

TEST(ExcursionChange, BandIsWhatTheTwinsDifferByAndTheJitterThatTheChangeScales) {
  const PairExcursion base = travels(10, 12, 10.5, 12.25), weak = travels(6, 12, 6.8, 12.25);
  const ExcursionChange exact = change_of(base, weak, Side::left);
  EXPECT_EQ(exact.from_mm, 10);
  EXPECT_EQ(exact.change_mm(), -4);
  // The twin's side loses 3.7 mm: 0.3 mm are the mesh's.
  EXPECT_NEAR(exact.band_mm, 0.3 + 0.1, 1e-12);
  EXPECT_EQ(exact.decided(), 1);
  // Jitter that makes 0.4 mm of a difference of both sides, of which four tenths are lost.
  PairExcursion noisy = base;
  noisy.jitter_floor_mm = 0.4;
  EXPECT_NEAR(change_of(noisy, weak, Side::left).band_mm,
              std::hypot(0.3, 0.4 * 0.4 / std::sqrt(2)) + 0.1, 1e-9);
  const ExcursionChange other = change_of(noisy, weak, Side::right);
  EXPECT_EQ(other.change_mm(), 0);
  EXPECT_NEAR(other.band_mm, 0.1, 1e-12) << "the same run has the same jitter";
  EXPECT_EQ(other.decided(), 0);
  const double none = std::nan("");
  EXPECT_TRUE(std::isnan(change_of(travels(10, 12, none, none), weak, Side::left).decided()));
}

TEST(ExcursionChange, HasNoBandWhereTheJitterIsNotKnown) {
  PairExcursion base = travels(10, 12, 10.5, 12.25), weak = travels(6, 12, 6.8, 12.25);
  base.known.jitter = weak.known.jitter = false;
  const ExcursionChange large = change_of(base, weak, Side::left);
  EXPECT_TRUE(std::isnan(large.band_mm));
  EXPECT_NEAR(large.known_band_mm, 0.4, 1e-12);
  EXPECT_TRUE(std::isnan(large.decided())) << "jitter may have made it";
  weak.left_side.excursion_mm = 9.7;
  weak.twin_left_mm = 10.6;
  EXPECT_EQ(change_of(base, weak, Side::left).decided(), 0) << "the mesh alone may have made it";
  EXPECT_EQ(change_of(base, weak, Side::right).decided(), 0) << "nothing changes";
  EXPECT_NEAR(change_of(base, weak, Side::right).band_mm, 0.1, 1e-12);
}

TEST(MeshFloor, KeepsTheTwinsExcursionsForTheSideThatTheyAreTheMirrorImageOf) {
  const auto run = ten_points([](auto& n) { return Vec3(smile_of(n)); });
  const auto twin =
      ten_points([](auto& n) { return Vec3((n.ends_with("_R") ? 1.5 : 1.0) * smile_of(n)); });
  SymmetryCurve curve = symmetry_of(run);
  Excursions excursions = excursions_of(run);
  add_mesh_floor(curve, excursions, run, twin);
  int moved = 0;
  for (const PairExcursion& pair : excursions.pairs) {
    EXPECT_NEAR(pair.twin_left_mm, 1.5 * pair.right_side.excursion_mm, 1e-9) << pair.name;
    EXPECT_NEAR(pair.twin_right_mm, pair.left_side.excursion_mm, 1e-9) << pair.name;
    moved += pair.twin_left_mm > 0;
  }
  EXPECT_GT(moved, 0);
}

TEST(MeshFloor, KeepsTheTwinsTracksOfTheCornersForTheOtherSide) {
  const auto run = ten_points([](auto& n) { return Vec3(smile_of(n)); });
  const auto twin =
      ten_points([](auto& n) { return Vec3((n.ends_with("_R") ? 1.5 : 1.0) * smile_of(n)); });
  Excursions excursions = excursions_of(run);
  EXPECT_EQ(excursions.commissure.twin_left_track_mm.rows(), 0);
  add_mesh_floor(excursions, run, twin);
  const auto way_mm = [](const Points& track) { return (track.row(2) - track.row(0)).norm(); };
  EXPECT_NEAR(way_mm(excursions.commissure.twin_left_track_mm), 15, 1e-9);
  EXPECT_NEAR(way_mm(excursions.commissure.twin_right_track_mm), 10, 1e-9);
}

}  // namespace
}  // namespace hyperex::metrics
