// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/regions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace hyperex::metrics {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;

bool holds(const Regions& regions, const std::string& name, int vertex) {
  const Region* region = regions.find(name);
  return region && std::binary_search(region->vertices.begin(), region->vertices.end(), vertex);
}

double nearest_mm(const Vec3& p, const io::Landmarks& landmarks, int first, int last) {
  double least = 1e9;
  for (int k = first; k <= last; ++k)
    least = std::min(least, (p - landmarks.at("ibug68_" + std::to_string(k))).norm());
  return 1e3 * least;
}

class SubjectA : public ::testing::Test {
 protected:
  void SetUp() override {
    const fs::path data = fs::path(HYPEREX_SHARED_DIR) / "data/ict";
    if (!fs::exists(data)) GTEST_SKIP() << "needs " << data;
    rest_ = io::read_scan(data / "subject_A_neutral_scan.ply").mesh.points;
    landmarks_ = io::read_landmarks(data / "subject_A_landmarks.json");
  }
  Points rest_;
  io::Landmarks landmarks_;
};

TEST_F(SubjectA, RegionsAreAsDefined) {
  const Regions regions = regions_of(rest_, landmarks_);
  EXPECT_TRUE(regions.notes.empty());
  for (int i = 0; i < rest_.rows(); ++i) {
    const Vec3 p = rest_.row(i);
    const bool lips = nearest_mm(p, landmarks_, 48, 67) <= 15;
    EXPECT_EQ(holds(regions, "lips", i), lips);
    EXPECT_EQ(holds(regions, "face", i), nearest_mm(p, landmarks_, 0, 67) <= 40);
    EXPECT_EQ(holds(regions, "chin", i), !lips && nearest_mm(p, landmarks_, 7, 9) <= 20);
    const bool cheek = 1e3 * (p - landmarks_.at("cheek_L")).norm() <= 22 ||
                       1e3 * (p - landmarks_.at("cheek_R")).norm() <= 22;
    EXPECT_EQ(holds(regions, "cheeks", i), cheek && !lips);
  }
}

TEST_F(SubjectA, NoseEyesAndForeheadLieApartAndWhereTheyShould) {
  const Regions regions = regions_of(rest_, landmarks_);
  std::set<int> seen;
  for (const char* name : {"lips", "nose", "eyes", "forehead"}) {
    const Region* region = regions.find(name);
    ASSERT_TRUE(region) << name;
    EXPECT_GT(region->vertices.size(), 500u) << name;
    for (const int vertex : region->vertices) EXPECT_TRUE(seen.insert(vertex).second) << name;
  }
  double lowest_forehead = 1e9, highest_nose = -1e9;
  for (const int i : regions.find("forehead")->vertices)
    lowest_forehead = std::min(lowest_forehead, rest_(i, 1));
  for (const int i : regions.find("nose")->vertices)
    highest_nose = std::max(highest_nose, rest_(i, 1));
  EXPECT_GT(lowest_forehead, landmarks_.at("ibug68_36")[1]);
  EXPECT_LT(highest_nose, landmarks_.at("ibug68_19")[1]);
}

TEST_F(SubjectA, TurnedWithItsLandmarksTheFaceKeepsItsRegions) {
  const Regions upright = regions_of(rest_, landmarks_);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(2, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  for (auto& [name, point] : landmarks_) point = turn * point;
  const Regions turned = regions_of(rest_ * turn.transpose(), landmarks_);
  ASSERT_EQ(turned.regions.size(), upright.regions.size());
  for (size_t i = 0; i < upright.regions.size(); ++i) {
    const auto& before = upright.regions[i].vertices;
    const auto& after = turned.regions[i].vertices;
    std::vector<int> apart;
    std::set_symmetric_difference(before.begin(), before.end(), after.begin(), after.end(),
                                  std::back_inserter(apart));
    EXPECT_LE(apart.size(), 2u) << upright.regions[i].name;  // rounding at the rims
  }
}

// Vertices on a grid, 5 mm apart, and only seven landmarks.
TEST(Regions, WithoutTheSixtyEightUseWhatThereIsAndSaySo) {
  Points grid(41 * 41, 3);
  for (int i = 0; i < 41; ++i)
    for (int j = 0; j < 41; ++j) grid.row(41 * i + j) << 0.005 * (i - 20), 0.005 * (j - 20), 0;
  const io::Landmarks seven = {{"exocanthion_R", {-0.042, 0.03, 0}},
                               {"exocanthion_L", {0.042, 0.03, 0}},
                               {"endocanthion_R", {-0.015, 0.03, 0}},
                               {"endocanthion_L", {0.015, 0.03, 0}},
                               {"pronasale", {0, 0, 0}},
                               {"cheilion_R", {-0.02, -0.03, 0}},
                               {"cheilion_L", {0.02, -0.03, 0}}};
  const Regions regions = regions_of(grid, seven);
  EXPECT_TRUE(regions.find("face"));
  EXPECT_TRUE(regions.find("eyes"));
  for (const char* absent : {"lips", "chin", "cheeks", "nose", "forehead"})
    EXPECT_FALSE(regions.find(absent)) << absent;
  EXPECT_THAT(regions.notes, Contains(HasSubstr("lips: left out")));
  EXPECT_THAT(regions.notes, Contains(HasSubstr("face: taken by 7 landmarks")));
  EXPECT_TRUE(regions.find("below_eyes"));
}

TEST(Regions, WithoutLandmarksThereAreNone) {
  const Regions regions = regions_of(Points::Random(10, 3), {});
  EXPECT_TRUE(regions.regions.empty());
}

}  // namespace
}  // namespace hyperex::metrics
