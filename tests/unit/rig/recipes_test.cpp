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
    read_recipes(written(text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Recipes, AreReadInTheirOrder) {
  const auto recipes =
      read_recipes(written("[happy]\nmouthSmileLeft = 0.8\njawOpen = 0\n"
                           "[angry]\nbrowDownLeft = 1\n"));
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
  EXPECT_THAT(refusal("[happy]\n"), HasSubstr("a table of weights"));
  EXPECT_THAT(refusal("[jawOpen_mouthClose]\njawOpen = 1\n"), HasSubstr("not of two shapes"));
  EXPECT_THAT(refusal("[\"a b\"]\njawOpen = 1\n"), HasSubstr("letters, digits and underscores"));
  EXPECT_THAT(refusal(""), HasSubstr("a table for each shape"));
  EXPECT_THAT(refusal("[happy\n"), HasSubstr("sound TOML"));
  EXPECT_THROW(read_recipes("nowhere.toml"), InputError);
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

}  // namespace
}  // namespace hyperex::rig
