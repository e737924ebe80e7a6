// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes of the user's own: their file, and a rig of a coarse mesh with some.
#include "hyperex/rig/recipes.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <memory>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/expression/arkit_names.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/rig/face_rig.hpp"

namespace hyperex::rig {
namespace {

using testing::HasSubstr;

std::filesystem::path written(const std::string& text) {
  const auto file = std::filesystem::path(testing::TempDir()) / "recipes_test.toml";
  std::ofstream(file) << text;
  return file;
}

std::string refusal(const std::string& text) {
  try {
    read_recipes({written(text)});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Recipes, AreReadInTheirOrder) {
  const auto recipes =
      read_recipes({written("[happy]\nmouthSmileLeft = 0.8\njawOpen = 0\n"
                            "[angry]\nbrowDownLeft = 1\n")});
  ASSERT_EQ(recipes.size(), 2u);
  EXPECT_EQ(recipes[0].name, "happy");
  EXPECT_THAT(recipes[0].weights, testing::UnorderedElementsAre(std::pair{"mouthSmileLeft", 0.8},
                                                                std::pair{"jawOpen", 0.0}));
  EXPECT_EQ(recipes[1].name, "angry");
}

TEST(Recipes, ThatAreWrongAreNamed) {
  EXPECT_THAT(refusal("[happy]\nmouthSmlieLeft = 1\n"),
              testing::AllOf(HasSubstr("recipes_test.toml:2"), HasSubstr("happy.mouthSmlieLeft"),
                             HasSubstr("did you mean mouthSmileLeft?")));
  EXPECT_THAT(refusal("[happy]\njawOpen = 2\n"), HasSubstr("happy.jawOpen = 2: expected a weight"));
  EXPECT_THAT(refusal("[happy]\njawOpen = -0.1\n"), HasSubstr("a weight, 0 to 1.5"));
  EXPECT_THAT(refusal("[happy]\njawOpen = nan\n"), HasSubstr("a weight, 0 to 1.5"));
  EXPECT_THAT(refusal("[happy]\ntongueOut = 1\n"), HasSubstr("but not tongueOut"));
  EXPECT_THAT(refusal("happy = 1\n"), HasSubstr("a table of weights"));
  EXPECT_THAT(refusal("[happy]\n"), HasSubstr("at least one weight below [happy]"));
  EXPECT_THAT(refusal("[jawOpen_mouthClose]\njawOpen = 1\n"), HasSubstr("not of two shapes"));
  EXPECT_THAT(refusal("[\"a b\"]\njawOpen = 1\n"), HasSubstr("letters, digits and underscores"));
  EXPECT_THAT(refusal(""), HasSubstr("a table for each shape"));
  EXPECT_THAT(refusal("[happy\n"), HasSubstr("sound TOML"));
  EXPECT_THROW(read_recipes({"nowhere.toml"}), InputError);
}

TEST(Recipes, OfSeveralFilesAreJoined) {
  const auto dir = std::filesystem::path(testing::TempDir());
  std::ofstream(dir / "recipes_a.toml") << "[happy]\njawOpen = 1\n";
  std::ofstream(dir / "recipes_b.toml") << "[angry]\njawOpen = 0.5\n";
  const auto recipes = read_recipes({dir / "recipes_a.toml", dir / "recipes_b.toml"});
  ASSERT_EQ(recipes.size(), 2u);
  EXPECT_EQ(recipes[1].name, "angry");
  EXPECT_THROW(read_recipes({dir / "recipes_a.toml", dir / "recipes_a.toml"}), InputError);
  EXPECT_TRUE(read_recipes({}).empty());
}

TEST(Recipes, WithATypingErrorInTheNameAreSuspected) {
  EXPECT_EQ(probably_meant({"mouthSmileleft", {}}), "mouthSmileLeft");
  EXPECT_EQ(probably_meant({"jawOpne", {}}), "jawOpen");
  EXPECT_EQ(probably_meant({"jawOpen", {}}), "");
  for (const Recipe& vrm : read_recipes(
           {std::filesystem::path(HYPEREX_SOURCE_DIR) / "examples/rig/vrm_expressions.toml"}))
    EXPECT_EQ(probably_meant(vrm), "") << vrm.name;
}

TEST(Recipes, LeaveOutTheLidsAndTheGazeOfAnEye) {
  const std::vector<Recipe> all = {
      {"one", {{"eyeBlinkLeft", 1}, {"eyeLookUpRight", 0.5}, {"cheekSquintRight", 1}}}};
  const std::vector<Recipe> left = without_eyes(all, {"Right"});
  ASSERT_EQ(left.size(), 1u);
  EXPECT_THAT(left[0].weights, testing::ElementsAre(std::pair{"eyeBlinkLeft", 1.0},
                                                    std::pair{"cheekSquintRight", 1.0}));
  EXPECT_EQ(without_eyes(all, {}), all);
}

class RigWithRecipes : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    anatomy::EmbeddedFace face = anatomy::embedded_face();
    session::Face given;
    given.scan.mesh = std::move(face.mesh);
    given.landmarks = std::move(face.landmarks);
    rig_ = std::make_unique<FaceRig>(
        make_rig(std::move(given), {{"mesh.element_size_mm", 8}, {"mesh.layers", 1}}, {},
                 Correctives::of_clashing_pairs,
                 {{"happy", {{"mouthSmileLeft", 0.8}, {"mouthSmileRight", 0.8}}},
                  {"mouthFrownLeft", {{"jawOpen", 0.5}}},
                  {"aside", {{"eyeLookInLeft", 0.5}, {"eyeLookOutRight", 0.5}}}}));
  }
  static void TearDownTestSuite() { rig_.reset(); }
  static const report::RigShape& shape(const std::string& name) {
    for (const report::RigShape& one : rig_->shapes)
      if (one.name == name) return one;
    throw std::out_of_range(name);
  }
  static double greatest_mm(const PointsF& moved) {
    return 1e3 * double(moved.rowwise().norm().maxCoeff());
  }
  static inline std::unique_ptr<FaceRig> rig_;
};

TEST_F(RigWithRecipes, HasThemBehindArkitsAndBeforeCorrectives) {
  ASSERT_EQ(rig_->shapes.size(), 52u + 2 + 7);
  for (std::size_t i = 0; i < 52; ++i)
    EXPECT_EQ(rig_->shapes[i].name, expression::arkit_shapes()[i]);
  EXPECT_EQ(rig_->shapes[52].name, "happy");
  EXPECT_EQ(rig_->shapes[53].name, "aside");
  EXPECT_TRUE(rig_->shapes[54].corrects);
}

TEST_F(RigWithRecipes, SimulatesThemAsOneExpression) {
  const PointsF sum =
      0.8F * (shape("mouthSmileLeft").displacement_m + shape("mouthSmileRight").displacement_m);
  const PointsF& happy = shape("happy").displacement_m;
  EXPECT_GT(greatest_mm(happy), 6);
  EXPECT_LT((happy - sum).norm(), 0.3 * sum.norm());
  EXPECT_GT(greatest_mm(happy - sum), 0.05) << "muscles of both sides act together";
}

TEST_F(RigWithRecipes, PutsOneInThePlaceOfArkits) {
  const PointsF half = 0.5F * shape("jawOpen").displacement_m;
  EXPECT_LT((shape("mouthFrownLeft").displacement_m - half).norm(), 0.2 * half.norm());
  EXPECT_GT(Eigen::AngleAxisd(shape("mouthFrownLeft").jaw_now_from_rest.linear()).angle(), 0.05);
}

TEST_F(RigWithRecipes, TurnsTheEyesByTheirWeights) {
  const report::RigShape& aside = shape("aside");
  ASSERT_TRUE(aside.left_eye && aside.right_eye);
  EXPECT_DOUBLE_EQ(aside.left_eye->left_rad, 0.5 * shape("eyeLookInLeft").left_eye->left_rad);
  EXPECT_DOUBLE_EQ(aside.right_eye->left_rad, 0.5 * shape("eyeLookOutRight").right_eye->left_rad);
  EXPECT_FALSE(shape("happy").left_eye);
}

/// The embedded face with the opening of the right eye filled, as scanners see a closed eye.
session::Face with_closed_right_eye() {
  anatomy::EmbeddedFace face = anatomy::embedded_face();
  const Vec3 eye = (face.landmarks.at(face::ibug(36)) + face.landmarks.at(face::ibug(39))) / 2;
  Points& points = face.mesh.points;
  for (const std::vector<int>& loop : boundary_loops(face.mesh.triangles)) {
    Vec3 middle = Vec3::Zero();
    for (const int v : loop) middle += points.row(v).transpose() / double(loop.size());
    if ((middle - eye).norm() > 5e-3) continue;
    const auto centre = int(points.rows());
    points.conservativeResize(centre + 1, 3);
    points.row(centre) = middle.transpose();
    Triangles& triangles = face.mesh.triangles;
    const Eigen::Index first = triangles.rows();
    triangles.conservativeResize(first + Eigen::Index(loop.size()), 3);
    for (std::size_t i = 0; i < loop.size(); ++i)
      triangles.row(first + Eigen::Index(i)) << loop[(i + 1) % loop.size()], loop[i], centre;
  }
  session::Face given;
  given.scan.mesh = std::move(face.mesh);
  given.landmarks = std::move(face.landmarks);
  return given;
}

TEST(RigOfAClosedEye, HasRecipesThatLeaveItsLidsStill) {
  const session::Face closed = with_closed_right_eye();
  const FaceRig rig =
      make_rig(closed, {{"mesh.element_size_mm", 8}, {"mesh.layers", 1}}, {}, Correctives::none,
               {{"blink", {{"eyeBlinkLeft", 1}, {"eyeBlinkRight", 1}}}});
  ASSERT_EQ(rig.closed_eyes, std::vector<std::string>{"Right"});
  const auto moved_mm = [&](const std::string& name, int point) {
    const Points& rest = rig.performance.skin_rest.points;
    const Eigen::RowVector3d at = closed.landmarks.at(face::ibug(point)).transpose();
    Eigen::Index nearest = 0;
    (rest.rowwise() - at).rowwise().squaredNorm().minCoeff(&nearest);
    for (const report::RigShape& one : rig.shapes)
      if (one.name == name) return 1e3 * double(one.displacement_m.row(nearest).norm());
    throw std::out_of_range(name);
  };
  EXPECT_GT(moved_mm("blink", 43), 4);
  EXPECT_LT(moved_mm("blink", 38), 0.5);
  EXPECT_EQ(moved_mm("eyeBlinkRight", 38), 0);
}

}  // namespace
}  // namespace hyperex::rig
