// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/drive.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "hyperex/anatomy/lips.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/geodesic.hpp"
#include "simulate/small_face.hpp"
#include "support/refusal.hpp"

namespace hyperex::simulate {
namespace {

class Drive : public testing::Test {
 protected:
  const test::SmallFace face_ = test::small_face();

  /// Points at skin nodes, so that the field can be read off there.
  std::vector<DrivenPoint> at_nodes(const std::vector<std::string>& names) const {
    std::vector<DrivenPoint> points;
    for (const auto& name : names)
      points.push_back({name, face_.mesh.skin.points.row(node_of(name)).transpose()});
    return points;
  }
  int node_of(const std::string& name) const {
    const Points& skin = face_.mesh.skin.points;
    const int lip = anatomy::lip_of(name);
    int best = -1;
    for (int v = 0; v < skin.rows(); ++v) {
      if (lip * face_.mesh.upper_margin[v] < 0) continue;
      const Vec3 p = face_.landmarks.at(name);
      if (best < 0 ||
          (skin.row(v).transpose() - p).norm() < (skin.row(best).transpose() - p).norm())
        best = v;
    }
    return best;
  }
  DriveField field_of(const std::vector<DrivenPoint>& points,
                      const std::vector<Vec3>& still) const {
    return DriveField(points, still, face_.mesh, face::face_frame(face_.landmarks).y, 0.010);
  }
  DrivenPatches patches(const std::vector<std::string>& names, double radius = 0.006,
                        bool still = false) const {
    const auto points = at_nodes(names);
    const DriveField field =
        field_of(points, still ? still_places(points, face_.landmarks) : std::vector<Vec3>{});
    return driven_patches(field, face_.mesh, radius, "motion.csv");
  }
};

TEST_F(Drive, MeetsEveryDrivenPoint) {
  const auto& names = test::seven_points();
  for (const bool still : {false, true}) {
    const DrivenPatches p = patches(names, 0.006, still);
    EXPECT_TRUE(std::is_sorted(p.nodes.begin(), p.nodes.end()));
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto at = std::find(p.nodes.begin(), p.nodes.end(), node_of(names[i]));
      ASSERT_NE(at, p.nodes.end()) << names[i];
      Eigen::RowVectorXd expected = Eigen::RowVectorXd::Zero(7);
      expected[static_cast<Eigen::Index>(i)] = 1;
      EXPECT_LT((p.weights.row(at - p.nodes.begin()) - expected).norm(), 1e-9) << names[i];
    }
  }
}

/// How far the points move for a unit displacement of each point: |points| x |points|.
Eigen::MatrixXd reached(const DrivenPatches& p) {
  return Eigen::MatrixXd(p.carriers)(Eigen::all, p.nodes) * p.weights;
}

TEST_F(Drive, PointsBetweenTheNodesEndWhereTheyAreDriven) {
  const TriMesh& skin = face_.mesh.skin;
  std::vector<DrivenPoint> points = at_nodes(test::seven_points());
  for (DrivenPoint& point : points)  // into the middle of a triangle
    for (int f = 0; f < skin.triangles.rows(); ++f)
      if ((skin.triangles.row(f).array() == node_of(point.name)).any()) {
        point.rest.setZero();
        for (int k = 0; k < 3; ++k)
          point.rest += skin.points.row(skin.triangles(f, k)).transpose() / 3;
      }
  const auto still = still_places(points, face_.landmarks);
  for (const double radius : {1e-9, 0.006, 0.012}) {
    const DrivenPatches p =
        driven_patches(field_of(points, still), face_.mesh, radius, "motion.csv");
    EXPECT_LT((reached(p) - Eigen::MatrixXd::Identity(7, 7)).cwiseAbs().maxCoeff(), 1e-3) << radius;
  }
}

TEST_F(Drive, PointsAtAlmostOnePlaceAreMetInTheMean) {
  std::vector<DrivenPoint> points = at_nodes({"ibug68_8", "ibug68_7"});
  points[1].rest = points[0].rest + Vec3(0.00003, 0.00002, 0);
  const DrivenPatches p = driven_patches(field_of(points, {}), face_.mesh, 0.012, "motion.csv");
  const Eigen::MatrixXd at = reached(p);
  EXPECT_NEAR((at(0, 0) + at(1, 0)) / 2, 0.5, 0.02);
  EXPECT_NEAR((at(0, 1) + at(1, 1)) / 2, 0.5, 0.02);
  EXPECT_LT(p.weights.cwiseAbs().maxCoeff(), 1.5) << "the skin is not folded between them";
}

/// Around an eye the simulated surface ends before the lid does. Two points of the lid, millimetres
/// apart, then move with one node. The skin around must not be torn to meet each of them.
TEST_F(Drive, PointsOfALidThatOneNodeCarriesAreMetInTheMean) {
  const std::vector<std::string> lid = {"ibug68_46", "ibug68_47"};
  const auto points = at_nodes(lid);
  ASSERT_GT((points[0].rest - points[1].rest).norm(), 0.003);
  const int one = node_of(lid[0]), other = node_of(lid[1]);
  for (const double share : {0.03, 0.1}) {
    tissue::TissueMesh mesh = face_.mesh;
    mesh.anchors[std::size_t(other)] = {{one, other, other}, {1 - share, share, 0}};
    const DrivenPatches p = driven_patches(field_of(points, {}), mesh, 0.012, "motion.csv");
    EXPECT_LT(p.weights.cwiseAbs().rowwise().sum().maxCoeff(), 2) << share;
    const Eigen::MatrixXd at = reached(p);
    for (int k = 0; k < 2; ++k) EXPECT_NEAR((at(0, k) + at(1, k)) / 2, 0.5, 0.05) << share;
  }
}

TEST_F(Drive, ACommonTranslationIsFollowed) {
  const DrivenPatches p = patches(test::seven_points());
  for (Eigen::Index j = 0; j < p.weights.rows(); ++j) EXPECT_NEAR(p.weights.row(j).sum(), 1, 1e-9);
}

TEST_F(Drive, StillPlacesHoldTheRestOfTheFace) {
  const auto points = at_nodes(test::seven_points());
  const auto still = still_places(points, face_.landmarks);
  EXPECT_EQ(still.size(), 4u + 4u + 31u) << "0 to 3, 13 to 16, 17 to 47";
  const DriveField field = field_of(points, still);
  Points at(2, 3);
  std::vector<double> margin;
  for (int i = 0; i < 2; ++i) {
    at.row(i) = face_.landmarks.at(face::ibug(i ? 45 : 27)).transpose();
    margin.push_back(face_.mesh.upper_margin[nearest_vertex(face_.mesh.skin.points, at.row(i))]);
  }
  EXPECT_LT(field.weights(at, margin).cwiseAbs().maxCoeff(), 1e-9);
  auto brow = at_nodes({"ibug68_19", "ibug68_8"});
  EXPECT_EQ(still_places(brow, face_.landmarks).size(), 38u) << "a driven one is not still";
}

/// All brows rise by 1: halfway up the forehead about half of it is left, at its top nothing.
TEST_F(Drive, ForeheadEndsTheMotionOfBrows) {
  std::vector<std::string> brows;
  for (int k = 17; k < 27; ++k) brows.push_back(face::ibug(k));
  const auto points = at_nodes(brows);
  const DriveField field = field_of(points, still_places(points, face_.landmarks));
  const Vec3 up = face::face_frame(face_.landmarks).y;
  Points at(3, 3);
  for (int i = 0; i < 3; ++i)
    at.row(i) = (face_.landmarks.at("ibug68_19") + 0.015 * i * up).transpose();
  const Eigen::VectorXd raised = field.weights(at, {0.1, 0.1, 0.1}).rowwise().sum();
  EXPECT_NEAR(raised[0], 1, 0.05);
  EXPECT_NEAR(raised[1], 0.5, 0.15);
  EXPECT_NEAR(raised[2], 0, 0.05);
}

/// With the root of the nose and the temples the forehead moves as well.
TEST_F(Drive, ForeheadFollowsTheHead) {
  std::vector<std::string> all;
  for (int k = 0; k < 68; ++k) all.push_back(face::ibug(k));
  const DriveField field = field_of(at_nodes(all), {});
  Points at(1, 3);
  at.row(0) = (face_.landmarks.at("ibug68_19") + Vec3(0, 0.030, 0)).transpose();
  EXPECT_NEAR(field.weights(at, {0.1}).sum(), 1, 1e-9);
}

TEST_F(Drive, LipsPart) {
  const std::vector<std::string> names = {"ibug68_50", "ibug68_51", "ibug68_52",
                                          "ibug68_56", "ibug68_57", "ibug68_58"};
  const DrivenPatches p = patches(names, 0.012, true);
  const Points& skin = face_.mesh.skin.points;
  double between[2] = {0, 0};  // how much inner lips follow the lower points: lower, upper side
  int count[2] = {0, 0};
  for (std::size_t j = 0; j < p.nodes.size(); ++j) {
    bool inner = false;
    for (int k : {62, 66})
      inner |=
          (skin.row(p.nodes[j]).transpose() - face_.landmarks.at(face::ibug(k))).norm() < 0.006;
    if (!inner) continue;
    const bool upper = face_.mesh.upper_margin[p.nodes[j]] > 0;
    between[upper] += p.weights.row(j).tail(3).sum();
    ++count[upper];
  }
  ASSERT_GT(count[0], 0);
  ASSERT_GT(count[1], 0);
  EXPECT_GT(between[0] / count[0], 0.75) << "the lower lip goes with its points";
  EXPECT_LT(between[1] / count[1], 0.25) << "the upper one hardly";
}

TEST_F(Drive, ALipsPatchStaysOnThatLip) {
  for (const auto& [name, lip] : {std::pair{"ibug68_62", 1}, {"ibug68_66", -1}, {"ibug68_57", -1}})
    for (int v : patches({name}, 0.015).nodes)
      EXPECT_EQ(face_.mesh.upper_margin[v] > 0, lip > 0) << name;
}

TEST_F(Drive, PatchesReachTheRadius) {
  const Points& skin = face_.mesh.skin.points;
  const DrivenPatches alone = patches({"ibug68_8"}, 0.015);
  EXPECT_GT(alone.nodes.size(), 1u);
  const Vec3 chin = skin.row(node_of("ibug68_8"));
  for (int v = 0; v < skin.rows(); ++v) {
    const bool driven = std::count(alone.nodes.begin(), alone.nodes.end(), v) > 0;
    EXPECT_EQ(driven, (skin.row(v).transpose() - chin).norm() < 0.015) << v;
  }
}

TEST_F(Drive, AFadingPatchOfTheChinHasNoStepAtItsEdge) {
  const auto points = at_nodes(test::seven_points());
  const std::vector<char> fading = on_chin(points, face_.landmarks);
  const auto chin = std::find(fading.begin(), fading.end(), 1) - fading.begin();
  ASSERT_EQ(std::count(fading.begin(), fading.end(), 1), 1);
  EXPECT_EQ(points[std::size_t(chin)].name, "ibug68_8");
  const DriveField field = field_of(points, {});
  const double radius = 0.006;  // of parted lips, as field_of() has them
  const DrivenPatches even = driven_patches(field, face_.mesh, radius, "motion.csv"),
                      p = driven_patches(field, face_.mesh, radius, "motion.csv", fading);
  EXPECT_TRUE((even.hold.array() == 1).all());
  const Points& skin = face_.mesh.volume.outer.points;
  int between = 0;
  for (std::size_t j = 0; j < p.nodes.size(); ++j) {
    const double hold = p.hold[Eigen::Index(j)];
    const auto away = [&](const DrivenPoint& point) {
      return (skin.row(p.nodes[j]).transpose() - point.rest).norm();
    };
    if (std::any_of(points.begin(), points.end(), [&](const DrivenPoint& point) {
          return point.name != "ibug68_8" && away(point) < radius;
        })) {
      EXPECT_EQ(hold, 1) << "the patches of other points are as before";
      continue;
    }
    const double d = away(points[std::size_t(chin)]);
    if (d < radius) {
      EXPECT_EQ(hold, 1);
    }
    if (d > radius + 0.017) {
      EXPECT_LT(hold, 0.05) << d;
    }
    EXPECT_LT(d, radius + 0.020);
    between += hold > 0.2 && hold < 0.8;
    EXPECT_LE(face_.mesh.upper_margin[std::size_t(p.nodes[j])], 0) << "the lower face alone";
  }
  EXPECT_GT(between, 2);
  EXPECT_LT((reached(p) - Eigen::MatrixXd::Identity(7, 7)).cwiseAbs().maxCoeff(), 1e-3);
}

TEST_F(Drive, APatchOfRadiusZeroDoesNotFade) {
  const auto points = at_nodes(test::seven_points());
  const DriveField field = field_of(points, {});
  const std::vector<char> fading = on_chin(points, face_.landmarks);
  const DrivenPatches even = driven_patches(field, face_.mesh, 0, "motion.csv"),
                      p = driven_patches(field, face_.mesh, 0, "motion.csv", fading);
  EXPECT_EQ(p.nodes, even.nodes);
  EXPECT_TRUE((p.hold.array() == 1).all());
}

TEST_F(Drive, ATinyPatchIsOneNodeAPoint) {
  const DrivenPatches p = patches(test::seven_points(), 1e-9);
  EXPECT_EQ(p.nodes.size(), 7u);
}

TEST_F(Drive, APointOffTheSkinIsRefused) {
  std::vector<DrivenPoint> points = at_nodes({"ibug68_8", "ibug68_51"});
  points[1].rest += Vec3(0, 0, 0.04);
  EXPECT_THAT(hyperex::test::refusal(
                  [&] { driven_patches(field_of(points, {}), face_.mesh, 0.006, "motion.csv"); }),
              testing::AllOf(testing::HasSubstr("motion.csv"), testing::HasSubstr("ibug68_51")));
}

TEST(LipParting, IsHalfTheGreatestDifferenceOfTheLips) {
  AlignedMotion motion;
  motion.motion.names = {"ibug68_51", "ibug68_57", "ibug68_8"};
  motion.rest = Points::Zero(3, 3);
  const auto sample = [](double upper, double lower) {
    Points p = Points::Zero(3, 3);
    p(0, 1) = upper;
    p(1, 1) = lower;
    p(2, 1) = -1;  // the chin is no lip
    return p;
  };
  motion.motion.positions = {sample(0, 0), sample(0.001, -0.005), sample(0.004, 0.003)};
  const Vec3 up = Vec3::UnitY();
  EXPECT_NEAR(lip_parting(motion, {0, 1, 2}, up), 0.003, 1e-12);
  motion.motion.positions.push_back(sample(0.01, -0.03));
  EXPECT_EQ(lip_parting(motion, {0, 1, 2}, up), 0.010);
  EXPECT_EQ(lip_parting(motion, {0, 2}, up), 0);
}

}  // namespace
}  // namespace hyperex::simulate
