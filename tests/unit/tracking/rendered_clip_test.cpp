// SPDX-License-Identifier: GPL-3.0-or-later
// Tracking of a clip rendered by this code: the whole way from pictures to pose and motion, without
// external data. Bounds are about 1.5 times the measured values.
#include "support/rendered_clip.hpp"

#include <gtest/gtest.h>

#include "hyperex/core/progress.hpp"
#include "hyperex/tracking/fit/score.hpp"
#include "hyperex/tracking/fit/track_source.hpp"

namespace hyperex::tracking {
namespace {

const Tracking& tracked() {
  static const Tracking tracking = [] {
    Progress::silence(true);
    test::RenderedClip clip;
    return track(clip, expression::canonical_model());
  }();
  return tracking;
}

/// The distance between the outer edges of the lips' middle (mm), tracked and true.
std::pair<double, double> lip_opening_mm(const TrackedFrame& frame, const Truth& truth) {
  const expression::FaceModel& model = expression::canonical_model();
  const auto at = [&](const char* name) {
    return expression::landmark_at(model.landmarks.at(name), frame.vertices_m);
  };
  const auto& points = truth.landmarks_m[frame.index];
  return {1e3 * (at("ibug68_51") - at("ibug68_57")).norm(),
          1e3 * (points.row(51) - points.row(57)).norm()};
}

TEST(RenderedClip, PoseAndMotionAreFound) {
  const Score s =
      score(expression::canonical_model(), tracked().frames, test::RenderedClip().truth());
  EXPECT_EQ(s.lost, 0u);
  EXPECT_LT(s.rotation_deg.median, 0.17);
  EXPECT_LT(s.rotation_deg.p95, 0.28);
  EXPECT_LT(s.translation_mm.median, 0.14);
  EXPECT_LT(s.translation_mm.p95, 0.25);
  EXPECT_LT(s.deformation_mm.median, 0.8);
  // Lips that are closed at rest are found worse as they part than parted ones (3.1 mm).
  EXPECT_LT(s.deformation_mm.p95, 4.6);
  EXPECT_GT(s.jaw_correlation.value_or(0), 0.99);
}

TEST(RenderedClip, TheLipsOpenAsFarAsTheyDo) {
  const Truth truth = test::RenderedClip().truth();
  double most = 0;
  for (const TrackedFrame& frame : tracked().frames) {
    ASSERT_TRUE(frame.valid) << frame.index << ": " << frame.fault;
    const auto [found, wanted] = lip_opening_mm(frame, truth);
    EXPECT_NEAR(found, wanted, 1.2) << frame.index;
    most = std::max(most, wanted);
  }
  EXPECT_GT(most, lip_opening_mm(tracked().frames.front(), truth).second + 15);
}

}  // namespace
}  // namespace hyperex::tracking
