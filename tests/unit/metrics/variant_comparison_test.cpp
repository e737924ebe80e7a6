// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/variant_comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "hyperex/core/files.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/metrics/variant_tables.hpp"

namespace hyperex::metrics {
namespace {

using ::testing::HasSubstr;

constexpr int kFrames = 41, kPeak = 20;
constexpr double kStep_s = 0.01;

double pulse(double t_s) {
  const double last_s = (kFrames - 1) * kStep_s;
  return t_s < 0 || t_s > last_s ? 0 : 0.5 * (1 - std::cos(2 * M_PI * t_s / last_s));
}

/// A square of skin, 2 x 2 cm, on both sides of the plane x = 0: vertices 0, 2 on the left.
TriMesh square_of_skin() {
  TriMesh mesh;
  mesh.points.resize(4, 3);
  mesh.points << 0.01, 0, 0, -0.01, 0, 0, 0.01, 0.02, 0, -0.01, 0.02, 0;
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 2, 1, 3;
  return mesh;
}

/// Lips about the lower left corner of the square; one landmark at its upper right corner.
io::Landmarks landmarks() {
  io::Landmarks all;
  for (int k = 48; k < 60; ++k) all[face::ibug(k)] = Vec3(0.01 + 1e-4 * (k - 48), 0, 0);
  all["upper_right"] = Vec3(-0.01, 0.02, 0);
  return all;
}

/// A performance driven at "corner". "near" is 5 mm from there and moves most, "far" is 20 mm away.
simulate::Performance performance(double right_mm, double trail_s) {
  simulate::Performance p;
  p.skin_rest = square_of_skin();
  p.peak_frame = kPeak;
  p.driven_names = {"still", "corner"};
  p.driven_points_rest = Points::Zero(2, 3);
  p.landmarks.names = {"near", "far"};
  for (int f = 0; f < kFrames; ++f) {
    const double t_s = f * kStep_s;
    p.frame_time_s.push_back(t_s);
    PointsF moved = PointsF::Zero(4, 3);
    moved(0, 1) = float(2e-3 * pulse(t_s));
    moved(3, 1) = float(1e-3 * right_mm * pulse(t_s));
    p.skin_displacement_m.push_back(moved);
    Points at(2, 3);
    at << 0.005, 3e-3 * pulse(t_s), 0, 0.02, 1e-3 * pulse(t_s - trail_s), 0;
    p.landmarks.time_s.push_back(t_s);
    p.landmarks.positions.push_back(at);
  }
  return p;
}

motion::Motion recorded(bool comes_back) {
  motion::Motion m;
  m.names = {"still", "corner"};
  for (int f = 0; f < kFrames; ++f) {
    const double t_s = f * kStep_s;
    m.time_s.push_back(100 + t_s);  // its first time is the run's time 0
    Points at = Points::Zero(2, 3);
    at(1, 1) = 4e-3 * (comes_back ? pulse(t_s) : t_s);
    m.positions.push_back(at);
  }
  return m;
}

SymmetryMeasures symmetry(double left_more) {
  SymmetryMeasures m;
  for (int f = 0; f < kFrames; ++f) {
    m.curve.time_s.push_back(f * kStep_s);
    m.curve.xi_left.push_back(left_more);
    m.curve.xi_right.push_back(0);
  }
  m.map.emplace();
  m.map->face = {0, 1, 2, 3};
  m.map->frames.resize(kFrames);
  m.map->frames[kPeak].face_rms_mm = 0.7;
  PairExcursion corners;
  corners.left = 4;
  corners.left_side.excursion_mm = 5;
  corners.right_side.excursion_mm = 3;
  m.excursions.pairs = {PairExcursion{}, corners};
  m.excursions.commissure.left = 4;
  return m;
}

struct Compared {
  simulate::Performance base = performance(2, 0), run = performance(5, 0.02);
  SymmetryMeasures base_symmetry = symmetry(0.1), run_symmetry = symmetry(0.4);
  io::Landmarks face = landmarks();
  motion::Motion motion = recorded(true);

  VariantComparison comparison(const ResponsePair& pair = {"corner", "far"}) const {
    return compare_variant("stiff, right", {base, base_symmetry}, {run, run_symmetry},
                           {face, motion}, pair);
  }
};

TEST(ResponsePair, IsOfThoseThatMoveMostAndOffThePatches) {
  const Compared c;
  const ResponsePair off = response_pair(c.base, c.motion, 0.01);
  EXPECT_EQ(off.driven, "corner");
  EXPECT_EQ(off.response, "far") << "near moves more, on the patch";
  EXPECT_EQ(response_pair(c.base, c.motion, 0.001).response, "near");
  EXPECT_EQ(response_pair(c.base, c.motion, 1).response, "");
}

TEST(DistanceFromBase, IsOfOneTimeAndSeesWhatExcursionsDoNot) {
  motion::Motion base, run;
  base.names = run.names = {"corner"};
  base.time_s = run.time_s = {0, 0.5, 1};
  for (const double x_m : {0.0, 0.010, 0.004}) base.positions.push_back(Points{{x_m, 0, 0}});
  run.positions = base.positions;
  run.positions[2](0, 1) = 0.003;  // as far at most, elsewhere on the way
  const DistanceFromBase found = distance_from_base(base, run, 0);
  EXPECT_NEAR(found.most_mm, 3, 1e-12);
  EXPECT_EQ(found.time_s, 1);
  EXPECT_EQ(distance_from_base(base, base, 0).most_mm, 0);
  EXPECT_TRUE(std::isnan(distance_from_base(base, run, -1).most_mm));
  EXPECT_TRUE(std::isnan(distance_from_base(base, run, 1).most_mm)) << "no such column";
}

TEST(CompareVariant, IsKnownOfASquareOfSkin) {
  const VariantComparison c = Compared().comparison();
  EXPECT_NEAR(c.greatest_displacement_mm, 5, 1e-5);
  EXPECT_NEAR(c.greatest_distance_mm, 3, 1e-5);  // of vertex 3
  EXPECT_EQ(c.farthest_near, "upper_right");
  EXPECT_NEAR(c.displacement_there_mm, 5, 1e-5);
  EXPECT_NEAR(c.base_displacement_there_mm, 2, 1e-5);
  // A third of its triangles' areas is each vertex's: 1/6, 1/3, 1/3, 1/6 of the square.
  EXPECT_NEAR(c.rms_distance_mm, std::sqrt(9.0 / 6), 1e-5);
  EXPECT_NEAR(c.mean_change_mm, 3.0 / 6, 1e-5);
  EXPECT_NEAR(c.mean_displacement_left_mm, 2.0 / 3, 1e-5);   // vertex 0 of 0 and 2
  EXPECT_NEAR(c.mean_displacement_right_mm, 5.0 / 3, 1e-5);  // vertex 3 of 1 and 3
  EXPECT_EQ(c.commissure_left.to_mm, 5);
  EXPECT_EQ(c.commissure_right.to_mm, 3);
  EXPECT_EQ(c.commissure_left.change_mm(), 0) << "as in base";
  EXPECT_EQ(c.asymmetry_mm, 0.7);
  EXPECT_NEAR(c.added_xi_difference, 0.3, 1e-12);
  EXPECT_TRUE(std::isnan(c.added_xi_decided())) << "no mirrored twin, no floor";
  EXPECT_NEAR(c.share_near_mouth, 0, 1e-12) << "vertex 3 lies 28 mm from the lips";
  EXPECT_NEAR(c.lag.lag_s, 0.02, 1e-4);
  EXPECT_GT(c.hysteresis, 0.1);
  EXPECT_NEAR(c.symmetry_integral_s, 0.4 * (kFrames - 1) * kStep_s, 1e-12);
}

TEST(CompareVariant, OfBaseWithItselfIsNoDifference) {
  const Compared c;
  const ComparedRun own{c.base, c.base_symmetry};
  const VariantComparison same =
      compare_variant("base", own, own, {c.face, c.motion}, {"corner", "far"});
  EXPECT_EQ(same.greatest_distance_mm, 0);
  EXPECT_EQ(same.added_xi_difference, 0);
  EXPECT_EQ(same.farthest_near, "");
  EXPECT_TRUE(std::isnan(same.displacement_there_mm));
  EXPECT_TRUE(std::isnan(same.share_near_mouth));
}

TEST(CompareVariant, TellsNoLagOfAMotionThatDoesNotComeBack) {
  Compared c;
  c.motion = recorded(false);
  EXPECT_TRUE(std::isnan(c.comparison().lag.lag_s));
  EXPECT_TRUE(std::isnan(c.comparison().hysteresis));
  c.motion = recorded(true);
  EXPECT_TRUE(std::isnan(c.comparison({"corner", ""}).lag.lag_s));
}

// The corner moves sideways: its distance from rest is as before, and along its direction in base
// it has not moved farther.
TEST(VariantComparison, MeasuresAPointAlongTheWayThatItGoesInBase) {
  const auto track = [](std::vector<Vec3> way_mm) {
    motion::Motion m;
    m.names = {"corner"};
    for (const Vec3& at_mm : way_mm) {
      m.time_s.push_back(0.1 * double(m.time_s.size()));
      m.positions.push_back(Points(1e-3 * (at_mm + Vec3(40, -30, 10)).transpose()));
    }
    return m;
  };
  const motion::Motion base = track({{0, 0, 0}, {0, 3, 4}, {0, 6, 8}, {0, 1, 0}});
  EXPECT_NEAR(along_base_mm(base, base, 0), 10, 1e-9);
  EXPECT_NEAR(along_base_mm(base, track({{0, 0, 0}, {0, 9, 12}, {5, 0, 0}}), 0), 15, 1e-9);
  EXPECT_NEAR(along_base_mm(base, track({{0, 0, 0}, {10, 0, 0}, {6, 3, 4}}), 0), 5, 1e-9);
  EXPECT_NEAR(along_base_mm(base, track({{0, 0, 0}, {0, -3, -4}, {0, 1, 1}}), 0), -5, 1e-9);
  EXPECT_TRUE(std::isnan(along_base_mm(base, base, 1)));
  EXPECT_TRUE(std::isnan(along_base_mm(track({{0, 0, 0}, {0, 0.05, 0}}), base, 0)));
}

/// A way that grows evenly to `aside_mm` and `up_mm`, from a place off the origin, mm.
Points even_way_mm(double aside_mm, double up_mm) {
  Points way(kFrames, 3);
  for (int f = 0; f < kFrames; ++f)
    way.row(f) << 20 + aside_mm * f / (kFrames - 1), up_mm * f / (kFrames - 1), 7;
  return way;
}

// The corner goes 10 mm up in base, in the variant 6 mm up and as far aside. In the twins its
// counterpart loses 4.3 mm: 0.3 mm are the mesh's.
TEST(CompareVariant, TheMotionInTheUnchangedDirectionHasABandOfItsOwn) {
  Compared c;
  const auto set = [](simulate::Performance& p, SymmetryMeasures& symmetry, const Points& way_mm,
                      const Points& twin_mm) {
    for (int f = 0; f < kFrames; ++f)
      p.landmarks.positions[std::size_t(f)].rowwise() = 1e-3 * way_mm.row(f);
    symmetry.excursions.pairs[1].left = symmetry.excursions.commissure.left = 0;
    symmetry.excursions.pairs[1].right = symmetry.excursions.commissure.right = 1;
    symmetry.excursions.pairs[1].jitter_floor_mm = 0.4;
    symmetry.excursions.commissure.twin_left_track_mm = twin_mm;
  };
  set(c.base, c.base_symmetry, even_way_mm(0, 10), even_way_mm(0, -10.5));
  set(c.run, c.run_symmetry, even_way_mm(8, 6), even_way_mm(-3, -6.2));
  const VariantComparison compared = c.comparison({"", ""});
  EXPECT_NEAR(compared.left_along_base.from_mm, 10, 1e-9);
  EXPECT_NEAR(compared.left_along_base.to_mm, 6, 1e-9);
  EXPECT_NEAR(compared.left_along_base.band_mm, std::hypot(0.3, 0.4 * 0.4 / std::sqrt(2)) + 0.1,
              1e-9);
  EXPECT_EQ(compared.left_along_base.decided(), 1);
  EXPECT_NEAR(compared.right_along_base.to_mm, 6, 1e-9);
  EXPECT_TRUE(std::isnan(compared.right_along_base.band_mm)) << "without a twin's track";
  c.run_symmetry.excursions.pairs[1].known.jitter = false;
  EXPECT_TRUE(std::isnan(c.comparison({"", ""}).left_along_base.band_mm));
  EXPECT_EQ(json_of(compared)["commissure_L_along_base_band_mm"], compared.left_along_base.band_mm);
}

TEST(VariantTable, QuotesNamesAndLeavesUnknownFiguresEmpty) {
  const VariantComparison c = Compared().comparison();
  const auto file = std::filesystem::path(::testing::TempDir()) / "variant_comparison.csv";
  write_variants_csv(file, c, {c}, {"corner", "far"});
  const std::string text = read_file(file);
  EXPECT_THAT(text, HasSubstr("\"stiff, right\",5,3,5,2,"));
  EXPECT_THAT(text, HasSubstr(",0.3,,,0,"));  // floor and decision are not known
  EXPECT_THAT(text, HasSubstr(",upper_right,corner,far,1\n"));
  const auto json = json_of(c);
  EXPECT_EQ(json["name"], "stiff, right");
  EXPECT_EQ(json["symmetry_integral_s"], c.symmetry_integral_s);
}

}  // namespace
}  // namespace hyperex::metrics
