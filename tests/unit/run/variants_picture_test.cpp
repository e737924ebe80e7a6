// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/variants_picture.hpp"

#include <gtest/gtest.h>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/run/face_box.hpp"

namespace hyperex::run {
namespace {

constexpr int kWidth_px = 300, kHeight_px = 380;

class VariantsPicture : public testing::Test {
 protected:
  const anatomy::EmbeddedFace face_ = anatomy::embedded_face();
  const face::FaceFrame frame_ = face::face_frame(face_.landmarks);
  const Points shown_ =
      points_within(face_box(face_.landmarks, frame_), frame_.local_points(face_.mesh.points));
  const std::array<render::Camera, 3> cameras_ = cameras_on(shown_, double(kWidth_px) / kHeight_px);
};

/// The first variant is farthest at 2, and both together would be at 1.
TEST(VariantsPictureFrame, IsThatOfTheVariantThatDiffersMost) {
  std::vector<metrics::VariantComparison> compared(2);
  compared[0].difference.frame_max_m = {0, 0.009, 0.010, 0.010};
  compared[1].difference.frame_max_m = {0, 0.004, 0.001, 0};
  const MostDifferent most = differs_most(compared);
  EXPECT_EQ(most.variant, 0u);
  EXPECT_EQ(most.frame, 2u);
  compared[1].difference.frame_max_m[1] = 0.011;
  EXPECT_EQ(differs_most(compared).variant, 1u);
  EXPECT_EQ(differs_most(compared).frame, 1u);
}

TEST_F(VariantsPicture, HoldsTheForeheadInEachView) {
  double highest_m = -1, brow_m = frame_.local(face_.landmarks.at(face::ibug(19))).y();
  for (Eigen::Index v = 0; v < shown_.rows(); ++v) highest_m = std::max(highest_m, shown_(v, 1));
  EXPECT_GT(highest_m, brow_m + 0.03) << "up to the hairline";
  for (const render::Camera& camera : cameras_)
    for (Eigen::Index v = 0; v < shown_.rows(); ++v) {
      const auto at = render::project(camera, kWidth_px, kHeight_px, shown_.row(v));
      ASSERT_TRUE(at.x > 0 && at.x < kWidth_px && at.y > 0 && at.y < kHeight_px)
          << shown_.row(v) << ": " << at.x << ' ' << at.y;
    }
}

TEST_F(VariantsPicture, ShowsEachSideAndToOneScale) {
  // Towards the viewer first the subject's right (-x), then the front, then the left.
  EXPECT_LT(cameras_[0].to_viewer.normalized().x(), -0.5);
  EXPECT_NEAR(cameras_[1].to_viewer.normalized().x(), 0, 1e-9);
  EXPECT_GT(cameras_[2].to_viewer.normalized().x(), 0.5);
  for (const render::Camera& camera : cameras_) EXPECT_EQ(camera.height_m, cameras_[0].height_m);
  // A change of the right cheek faces the first view and turns away from the last.
  const Vec3 cheek = frame_.local(face_.landmarks.at("cheek_R"));
  const auto towards = [&](std::size_t view) {
    return render::project(cameras_[view], kWidth_px, kHeight_px, cheek).towards_viewer_m;
  };
  EXPECT_GT(towards(0), towards(2) + 0.03);
}

}  // namespace
}  // namespace hyperex::run
