// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/uncertainty/perturbed_face.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/face/landmark_errors.hpp"

namespace hyperex::uncertainty {
namespace {

scene::Scene scene_with_variant(const std::string& drive) {
  return scene::read_scene_text(
      "scan.file = \"embedded\"\nmotion.file = \"embedded\"\ndrive.by = \"" + drive +
          "\"\n[[variant]]\nname = \"weak\"\nmuscles.gain = { side_R = 0.5 }",
      "made_up.toml");
}

std::vector<PerturbedFace> faces_of(const scene::Scene& scene) {
  const anatomy::EmbeddedFace face = anatomy::embedded_face();
  return perturbed_faces(scene, face.landmarks);
}

int count(const std::vector<PerturbedFace>& faces, metrics::ErrorPart part) {
  return int(std::ranges::count(faces, part, &PerturbedFace::part));
}

TEST(PerturbedFace, DiffersInOneRespectInBaseAndVariants) {
  const scene::Scene scene = scene_with_variant("muscles");
  for (const PerturbedFace& face : faces_of(scene)) {
    const scene::Scene& variant = face.scene.variants.at(0).scene;
    EXPECT_EQ(variant.muscles.own, face.scene.muscles.own) << face.how;
    EXPECT_EQ(variant.muscles.skull_layer, face.scene.muscles.skull_layer) << face.how;
    EXPECT_EQ(variant.model.strain, face.scene.model.strain) << face.how;
    EXPECT_EQ(variant.mesh.element_size_m, face.scene.mesh.element_size_m) << face.how;
    EXPECT_EQ(variant.muscles.gains, scene.variants[0].scene.muscles.gains) << face.how;
    const int differs = (face.scene.muscles.own != scene.muscles.own) +
                        !(face.scene.muscles.skull_layer == scene.muscles.skull_layer) +
                        (face.scene.model.strain != scene.model.strain) +
                        (face.scene.mesh.element_size_m != scene.mesh.element_size_m) +
                        !face.scene.given.landmarks.empty();
    EXPECT_EQ(differs, 1) << face.how;
  }
}

TEST(PerturbedFace, HasMusclesWhereTheyDrive) {
  using metrics::ErrorPart;
  const auto by_muscles = faces_of(scene_with_variant("muscles"));
  EXPECT_EQ(count(by_muscles, ErrorPart::muscles), kMuscleDraws);
  EXPECT_EQ(count(by_muscles, ErrorPart::mesh), int(kElementSizes.size()));
  EXPECT_EQ(count(by_muscles, ErrorPart::landmarks), kLandmarkDraws);
  EXPECT_EQ(count(by_muscles, ErrorPart::stiffness), 1);
  EXPECT_EQ(count(by_muscles, ErrorPart::law), 1);
}

TEST(PerturbedFace, WithoutMusclesHasNoneToMove) {
  scene::Scene scene = scene_with_variant("muscles");
  scene.drive.by = simulate::DriveBy::displacement;
  EXPECT_EQ(count(faces_of(scene), metrics::ErrorPart::muscles), 0);
}

TEST(PerturbedFace, LandmarksOfOnePlaceStayTogether) {
  const anatomy::EmbeddedFace embedded = anatomy::embedded_face();
  ASSERT_EQ(embedded.landmarks.at("cheilion_L"), embedded.landmarks.at("ibug68_54"));
  double squares = 0, coordinates = 0;
  for (const PerturbedFace& face : faces_of(scene_with_variant("muscles"))) {
    const io::Landmarks& moved = face.scene.given.landmarks;
    if (moved.empty()) continue;
    EXPECT_EQ(moved.at("cheilion_L"), moved.at("ibug68_54"));
    EXPECT_NE(moved.at("cheilion_L"), embedded.landmarks.at("cheilion_L"));
    for (const auto& [name, place] : moved) {
      squares += (place - embedded.landmarks.at(name)).squaredNorm();
      coordinates += 3;
    }
  }
  EXPECT_NEAR(std::sqrt(squares / coordinates), face::kLandmarkError_m,
              0.1 * face::kLandmarkError_m);
}

}  // namespace
}  // namespace hyperex::uncertainty
