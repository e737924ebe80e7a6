// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/baseline.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "hyperex/core/error.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/metrics/regions.hpp"
#include "hyperex/metrics/surface_distance.hpp"
#include "support/refusal.hpp"

namespace hyperex::metrics {
namespace {

namespace fs = std::filesystem;

TEST(Baseline, PointListsAreThoseOfTheComparison) {
  EXPECT_THAT(driven_ibug_points(), ::testing::ElementsAre(48, 54, 51, 57, 8, 58, 56));
  EXPECT_EQ(still_ibug_points().size(), 4u + 4u + 31u);
  for (const int k : {0, 3, 13, 16, 17, 47})
    EXPECT_THAT(still_ibug_points(), ::testing::Contains(k));
  for (const int k : {4, 12, 48})
    EXPECT_THAT(still_ibug_points(), ::testing::Not(::testing::Contains(k)));
}

struct Expected {
  const char* truth;
  // Mean mm over face and lips, measured beforehand by another program.
  double still[2], seven[2], all[2];
};

class OnSubjectA : public ::testing::TestWithParam<Expected> {};

TEST_P(OnSubjectA, ReproducesTheErrorsMeasuredBefore) {
  const fs::path data = fs::path(HYPEREX_SHARED_DIR) / "data/ict";
  if (!fs::exists(data)) GTEST_SKIP() << "needs " << data;
  const TriMesh rest = io::read_scan(data / "subject_A_neutral_scan.ply").mesh;
  const Points truth = io::read_scan(data / GetParam().truth).mesh.points;
  const io::Landmarks landmarks = io::read_landmarks(data / "subject_A_landmarks.json");
  const Regions regions = regions_of(rest.points, landmarks);
  const std::vector<Baseline> found = baselines(rest, truth, landmarks);
  const auto expect = [&](size_t i, const char* key, const double(&mm)[2], double tolerance) {
    EXPECT_EQ(found.at(i).key, key);
    const auto distance = distance_to_corresponding(found.at(i).moved, truth, truth.rows());
    EXPECT_NEAR(statistics_of(distance, regions.find("face")->vertices).mean_mm, mm[0], tolerance);
    EXPECT_NEAR(statistics_of(distance, regions.find("lips")->vertices).mean_mm, mm[1], tolerance);
  };
  expect(0, "standing_still", GetParam().still, 0.006);
  expect(1, "warp_7", GetParam().seven, 0.012);
  // The figures to meet took the landmarks' displacement from a recording; ours, from the surfaces,
  // has their noise of 0.12 mm.
  expect(2, "warp_68", GetParam().all, 0.08);
}

// The shapes are from the same rig as the truth. They must therefore do better than a warp here,
// and pass through the given points.
TEST(BlendShapes, ExplainTheRigTheyComeFrom) {
  const fs::path data = fs::path(HYPEREX_SHARED_DIR) / "data/ict";
  if (!fs::exists(data)) GTEST_SKIP() << "needs " << data;
  const TriMesh rest = io::read_scan(data / "subject_A_neutral_scan.ply").mesh;
  const Points truth = io::read_scan(data / "subject_A_talk_peak_truth.ply").mesh.points;
  const io::Landmarks landmarks = io::read_landmarks(data / "subject_A_landmarks.json");
  const Regions regions = regions_of(rest.points, landmarks);
  const std::vector<Baseline> found = baselines(rest, truth, landmarks);
  const auto mean_mm = [&](std::size_t i, const char* region) {
    const auto distance = distance_to_corresponding(found.at(i).moved, truth, truth.rows());
    return statistics_of(distance, regions.find(region)->vertices).mean_mm;
  };
  ASSERT_EQ(found.size(), 6u);
  EXPECT_EQ(found[4].key, "shapes_7");
  EXPECT_EQ(found[5].key, "shapes_68");
  for (const char* region : {"face", "lips"}) {
    EXPECT_LT(mean_mm(4, region), 0.8 * mean_mm(1, region)) << region;
    EXPECT_LT(mean_mm(5, region), 0.8 * mean_mm(2, region)) << region;
  }
  const SurfaceTree tree(rest);
  for (const char* point : {"ibug68_48", "ibug68_54", "ibug68_8"}) {
    const ClosestPoint at = tree.query(landmarks.at(point));
    Vec3 off = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      const int v = rest.triangles(at.triangle, k);
      off += at.weights[k] * (found[4].moved.row(v) - truth.row(v)).transpose();
    }
    EXPECT_LT(off.norm(), 0.7e-3) << point;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Baseline, OnSubjectA,
    ::testing::Values(
        Expected{"subject_A_mouth_open_truth.ply", {4.26, 12.68}, {1.80, 5.08}, {1.68, 4.88}},
        Expected{"subject_A_talk_peak_truth.ply", {5.81, 16.90}, {2.89, 6.38}, {2.41, 6.03}}));

TEST(Baseline, NamesTheLandmarksThatAreMissing) {
  TriMesh mesh{Points::Identity(3, 3), Triangles(1, 3)};
  mesh.triangles << 0, 1, 2;
  io::Landmarks landmarks;
  for (int k = 0; k < 68; ++k)
    if (k != 56) landmarks["ibug68_" + std::to_string(k)] = Vec3::Random();
  EXPECT_THAT(test::refusal([&] { baselines(mesh, mesh.points, landmarks); }),
              ::testing::HasSubstr("ibug68_56"));
}

}  // namespace
}  // namespace hyperex::metrics
