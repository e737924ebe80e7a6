// SPDX-License-Identifier: GPL-3.0-or-later
// The rendered recording agrees with its truth, and is tracked as accurately as when it was
// introduced. Bounds are about 1.5 times the measured values.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "hyperex/core/progress.hpp"
#include "hyperex/sample/camera_view.hpp"
#include "hyperex/sample/sample_data.hpp"
#include "hyperex/sample/second_face.hpp"
#include "hyperex/tracking/fit/depth_view.hpp"
#include "hyperex/tracking/fit/track_source.hpp"

namespace hyperex::sample {
namespace {

constexpr std::size_t kSmilePeak = 20, kOpenPeak = 46;

TEST(CameraView, DepthOfASlantedTriangleIsThatOfItsPlane) {
  TriMesh mesh;
  mesh.points.resize(3, 3);
  mesh.points << -0.1, -0.1, 0.5, 0.2, -0.1, 0.7, -0.1, 0.2, 0.6;
  mesh.triangles.resize(1, 3);
  mesh.triangles << 0, 1, 2;
  const capture::Intrinsics camera{200, 200, 49.5, 39.5, 100, 80};
  const cv::Mat depth = depth_of(mesh, camera);
  const Vec3 a = mesh.points.row(0), b = mesh.points.row(1), c = mesh.points.row(2);
  const Vec3 normal = (b - a).cross(c - a);
  int seen = 0;
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u) {
      const float z = depth.at<float>(v, u);
      if (z == 0) continue;
      ++seen;
      EXPECT_NEAR(z, normal.dot(a) / normal.dot(tracking::ray(camera, {u, v})), 1e-6);
    }
  EXPECT_GT(seen, 1000);
}

TEST(CameraView, ColourAndDepthSeeASurfaceInTheSamePlace) {
  TriMesh mesh;
  mesh.points.resize(4, 3);
  mesh.points << -0.05, -0.02, 0.6, 0.03, -0.02, 0.7, 0.03, 0.06, 0.7, -0.05, 0.06, 0.6;
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 2, 1, 0, 3, 2;
  const capture::Intrinsics camera{320, 320, 79.5, 59.5, 160, 120};
  render::VertexColours red(4, 3);
  red.rowwise() = Eigen::Matrix<std::uint8_t, 1, 3>(255, 0, 0);
  const cv::Mat colour = colour_of({{mesh, red}}, camera, 0.6), depth = depth_of(mesh, camera);
  int differ = 0, seen = 0;
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u) {
      const auto bgr = colour.at<cv::Vec3b>(v, u);
      const bool drawn = bgr[2] > bgr[0] + 30;
      const bool there = depth.at<float>(v, u) > 0;
      seen += there;
      differ += drawn != there;
    }
  EXPECT_GT(seen, 800);
  EXPECT_LT(differ, 0.06 * seen) << "pixels of the edge";
  EXPECT_THROW(colour_of({}, {320, 320, 70, 59.5, 160, 120}, 0.6), std::invalid_argument);
}

TEST(Person, SmilesOnTheRightAloneAndOpensTheJaw) {
  const Person person(second_face());
  const auto rest = person.landmarks({}), smile = person.landmarks({.smile = 1}),
             open = person.landmarks({.jaw_open = 1});
  const auto moved_mm = [&](const tracking::Points68& pose, int k) {
    return 1e3 * (pose.row(k) - rest.row(k)).norm();
  };
  EXPECT_NEAR(moved_mm(smile, 48), Person::kSmile_mm.norm(), 1) << "the right corner";
  EXPECT_LT(moved_mm(smile, 54), 0.1) << "the left corner";
  EXPECT_LT(moved_mm(smile, 8), 0.1) << "the chin";
  EXPECT_GT(moved_mm(open, 8), 15);
  EXPECT_GT(moved_mm(open, 57), 12);
  EXPECT_LT(moved_mm(open, 51), 0.1) << "the upper lip";
  EXPECT_NEAR(moved_mm(open, 48), moved_mm(open, 54), 1.5);
}

TEST(SampleClip, DepthIsWhereTheTruthSaysWithTheNoiseThatItStates) {
  RenderedFace clip = sample_clip();
  const tracking::Truth truth = clip.truth();
  ASSERT_EQ(truth.time_s.size(), *clip.frame_count());
  EXPECT_NEAR(truth.time_s.back(), 59 / 30.0, 1e-12);
  const capture::Frame frame = *clip.next();
  ASSERT_EQ(frame.colour.size(), frame.depth_m.size());
  double squares = 0;
  const std::vector<int> on_the_front = {30, 8, 51, 57, 27, 31, 35, 21, 22};
  for (const int k : on_the_front) {
    const Vec3 at = truth.landmarks_m[0].row(k).transpose();
    const Eigen::Vector2d px = tracking::project(clip.intrinsics(), at);
    const double seen = frame.depth_m.at<float>(int(std::lround(px.y())), int(std::lround(px.x())));
    EXPECT_NEAR(seen, at.z(), 0.005) << k;
    squares += (seen - at.z()) * (seen - at.z());
  }
  EXPECT_GT(std::sqrt(squares / double(on_the_front.size())), 0.0003) << "there is noise";
}

TEST(SampleClip, IsTrackedWithinAMillimetre) {
  Progress::silence(true);
  RenderedFace clip = sample_clip();
  const expression::FaceModel& model = expression::canonical_model();
  const tracking::Tracking tracked = tracking::track(clip, model);
  const tracking::Truth truth = clip.truth();
  const tracking::Score score = tracking::score(model, tracked.frames, truth);
  EXPECT_EQ(score.lost, 0U);
  EXPECT_LT(score.deformation_mm.median, 0.75);
  EXPECT_LT(score.deformation_mm.p95, 3.6);
  EXPECT_LT(score.rotation_deg.p95, 1.1);
  EXPECT_LT(score.translation_mm.p95, 0.45);
  EXPECT_GT(score.jaw_correlation.value_or(0), 0.99);
  EXPECT_GT(truth.jaw_open[kOpenPeak], 0.99);
  EXPECT_EQ(truth.jaw_open[kSmilePeak], 0);
}

}  // namespace
}  // namespace hyperex::sample
