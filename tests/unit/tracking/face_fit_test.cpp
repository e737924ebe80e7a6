// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hyperex/core/error.hpp"
#include "hyperex/tracking/fit/frame_fit.hpp"
#include "hyperex/tracking/fit/neutral.hpp"
#include "hyperex/tracking/fit/score.hpp"

namespace hyperex::tracking {
namespace {

const capture::Intrinsics kCamera{525, 525, 319.5, 239.5, 640, 480};

Eigen::Isometry3d pose(double turn_deg, const Vec3& at) {
  Eigen::Isometry3d made = Eigen::Isometry3d::Identity();
  made.linear() =
      (Eigen::AngleAxisd(turn_deg * std::numbers::pi / 180, Vec3(0.2, 1, 0.1).normalized()) *
       Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()))
          .toRotationMatrix();
  made.translation() = at;
  return made;
}

Observation seen_from(const Points& head, const Eigen::Isometry3d& camera_from_head) {
  Observation seen;
  seen.network_px = Points::Zero(468, 3);
  for (Eigen::Index v = 0; v < head.rows(); ++v) {
    const Vec3 p = camera_from_head * Vec3(head.row(v).transpose());
    seen.network_px.row(v).head<2>() = project(kCamera, p).transpose();
    seen.network_px(v, 2) = p.z() * kCamera.fx_px / 0.6;
  }
  return seen;
}

TEST(CanonicalModel, UnitsMoveWhatTheirNamesSay) {
  const expression::FaceModel& model = expression::canonical_model();
  const auto moved = [&](const std::string& name, const std::string& landmark) {
    const int k = model.animation_unit(name);
    EXPECT_GE(k, 0) << name;
    Eigen::VectorXd weights = Eigen::VectorXd::Unit(Eigen::Index(model.animation_units.size()), k);
    const auto& vertices = model.landmarks.at(landmark);
    return Vec3(
        expression::landmark_at(
            vertices, expression::deformed(model.mesh.points, model.animation_units, weights)) -
        expression::landmark_at(vertices, model.mesh.points));
  };
  EXPECT_LT(moved("jawOpen", "ibug68_8").y(), -0.02);
  EXPECT_LT(moved("jawOpen", "ibug68_57").y(), -0.015);
  EXPECT_EQ(moved("jawOpen", "pronasale").norm(), 0);
  EXPECT_GT(moved("mouthSmile_L", "cheilion_L").x(), 0.005);
  EXPECT_LT(moved("mouthSmile_R", "cheilion_R").x(), -0.005);
  EXPECT_LT(moved("mouthSmile_L", "cheilion_R").norm(), 0.001);
  EXPECT_GT(moved("browInnerUp_L", "ibug68_22").y(), 0.003);
  EXPECT_LT(moved("eyeBlink_R", "ibug68_37").y(), -0.004);
  EXPECT_NEAR(moved("mouthPucker", "cheilion_L").x(), -moved("mouthPucker", "cheilion_R").x(),
              1e-9);
}

TEST(FrameFit, GradientAgreesWithFiniteDifferences) {
  const expression::FaceModel& model = expression::canonical_model();
  FitOptions options;
  options.network_robust_px = 1e9;  // the cost is then a plain sum of squares
  options.network_px = options.network_outline_px = options.network_inner_lip_px = 1;
  const FrameFit fit(model, kCamera, model.mesh.points, 1, options);
  FaceState truth = fit.at_rest(), state = fit.at_rest();
  truth.camera_from_head = pose(6, {0.01, 0, 0.6});
  truth.weights[model.jaw_drop] = 0.5;
  state.camera_from_head = pose(2, {0, 0.01, 0.62});
  const Observation seen = seen_from(fit.vertices(truth), truth.camera_from_head);
  const Eigen::VectorXd gradient =
      fit.parameter_jacobian(state).transpose() * fit.measure(seen, state, nullptr).gradient();
  const auto cost = [&](int parameter, double step) {
    FaceState moved = state;
    Eigen::Isometry3d head = Eigen::Isometry3d::Identity();
    if (parameter < 3)
      head.linear() = Eigen::AngleAxisd(step, Vec3::Unit(parameter)).toRotationMatrix();
    else if (parameter < 6)
      head.translation()[parameter - 3] = step;
    else
      moved.weights[parameter - 6] += step;
    moved.camera_from_head = moved.camera_from_head * head;
    const Points points = fit.vertices(moved);
    double sum = 0;
    for (Eigen::Index v = 0; v < points.rows(); ++v)
      sum += 0.5 * (project(kCamera, moved.camera_from_head * Vec3(points.row(v).transpose())) -
                    seen.network_px.row(v).head<2>().transpose())
                       .squaredNorm();
    return sum;
  };
  for (int k = 0; k < gradient.size(); ++k) {
    const double numeric = (cost(k, 1e-6) - cost(k, -1e-6)) / 2e-6;
    EXPECT_NEAR(gradient[k], numeric, 1e-4 * (1 + std::abs(numeric))) << k;
  }
}

TEST(FrameFit, FindsPoseAndJawFromExactPoints) {
  const expression::FaceModel& model = expression::canonical_model();
  FitOptions options;
  options.iterations = 10;
  options.network_px = options.network_outline_px = options.network_inner_lip_px = 0.1;
  options.off_units_share = options.off_units_lip_m = 0;  // the points are the model's own
  FrameFit fit(model, kCamera, model.mesh.points, 1, options);
  FaceState truth = fit.at_rest();
  truth.camera_from_head = pose(8, {0.02, 0.01, 0.6});
  truth.weights[model.jaw_drop] = 0.6;
  const Observation seen = seen_from(fit.vertices(truth), truth.camera_from_head);
  FaceState start = fit.at_rest();
  start.camera_from_head = fit.first_pose(seen);
  const FaceState found = fit.fit(seen, start, nullptr, nullptr);
  EXPECT_NEAR(found.weights[model.jaw_drop], 0.6, 0.03);
  const Eigen::Isometry3d off = truth.camera_from_head.inverse() * found.camera_from_head;
  EXPECT_LT(Eigen::AngleAxisd(off.linear()).angle(), 0.005);
  EXPECT_LT((fit.vertices(found) - fit.vertices(truth)).rowwise().norm().maxCoeff(), 0.002);
}

TEST(FrameFit, AVertexThatNothingMeasuresComesToRest) {
  expression::FaceModel model = expression::canonical_model();
  const Eigen::Index lone = model.mesh.points.rows();  // of no triangle, as some of CANDIDE-3's are
  model.mesh.points.conservativeResize(lone + 1, 3);
  model.mesh.points.row(lone) << 0, 0.02, 0.05;
  FrameFit fit(model, kCamera, model.mesh.points, 1, {});
  FaceState state = fit.at_rest();
  state.camera_from_head = pose(8, {0.02, 0.01, 0.6});
  const Observation seen = seen_from(fit.vertices(state).topRows(lone), state.camera_from_head);
  state.free_m.row(lone) << 0.001, 0, 0;
  for (int frame = 0; frame < 20; ++frame) {
    const FaceState before = state;
    state = fit.fit(seen, before, &before, nullptr);
    EXPECT_LE(state.free_m.row(lone).norm(), before.free_m.row(lone).norm() + 1e-12);
  }
  EXPECT_LT(state.free_m.row(lone).norm(), 0.0009);
}

TEST(Neutral, ASizeThatNoFaceHasIsRefused) {
  const expression::FaceModel& model = expression::canonical_model();
  Neutral neutral;
  neutral.points_m = model.mesh.points;
  neutral.metric = true;
  EXPECT_NO_THROW(check_size(model, neutral));
  neutral.points_m *= 5;
  EXPECT_THROW(check_size(model, neutral), InputError);
  neutral.points_m /= 50;
  EXPECT_THROW(check_size(model, neutral), InputError);
  neutral.metric = false;  // stated then, not measured
  EXPECT_NO_THROW(check_size(model, neutral));
}

TEST(SurfacePatch, MeetsATiltedPlaneAndLeavesOutWhatIsFar) {
  const Vec3 normal = Vec3(0.3, -0.2, -1).normalized(), at(0.01, 0.02, 0.6);
  cv::Mat depth(480, 640, CV_32F);
  for (int v = 0; v < 480; ++v)
    for (int u = 0; u < 640; ++u) {
      const Vec3 r = ray(kCamera, {u, v});
      depth.at<float>(v, u) = float(normal.dot(at) / normal.dot(r));
    }
  depth.at<float>(256, 331) = 0.9f;
  depth.at<float>(255, 329) = 0;
  const Eigen::Vector2d px = project(kCamera, at);
  const auto patch = surface_patch(depth, kCamera, px, 0.603);
  ASSERT_TRUE(patch);
  EXPECT_LT((patch->point - at).norm(), 2e-4);
  EXPECT_GT(patch->normal.dot(normal), 0.999);
  EXPECT_LT(patch->share, 1);
  EXPECT_FALSE(surface_patch(depth, kCamera, px, 0.7));
  EXPECT_FALSE(surface_patch(depth, kCamera, {1, 1}, 0.6));
}

/// A truth of five frames, and the same motion in another head frame.
struct TruthAndTrack {
  Truth truth;
  std::vector<TrackedFrame> tracked;
};

TruthAndTrack truth_and_track(double error_m) {
  const expression::FaceModel& model = expression::canonical_model();
  Eigen::Isometry3d face_from_head = Eigen::Isometry3d::Identity();
  face_from_head.rotate(Eigen::AngleAxisd(0.3, Vec3::UnitX()));
  face_from_head.translation() = Vec3(0.01, -0.02, 0.03);
  TruthAndTrack made;
  for (int k = 0; k < 5; ++k) {
    TrackedFrame frame;
    frame.time_s = k / 30.0;
    frame.valid = true;
    frame.weights =
        0.1 * k * Eigen::VectorXd::Unit(Eigen::Index(model.animation_units.size()), model.jaw_drop);
    frame.vertices_m =
        expression::deformed(model.mesh.points, model.animation_units, frame.weights);
    const Eigen::Isometry3d camera_from_face = pose(2.0 * k, {0.002 * k, 0, 0.6});
    frame.camera_from_head = camera_from_face * face_from_head;
    Points68 landmarks;
    for (int i = 0; i < 68; ++i)
      landmarks.row(i) = (frame.camera_from_head *
                          expression::landmark_at(model.landmarks.at("ibug68_" + std::to_string(i)),
                                                  frame.vertices_m))
                             .transpose();
    if (k > 0) frame.vertices_m.col(2).array() += error_m;
    made.truth.time_s.push_back(frame.time_s);
    made.truth.camera_from_face.push_back(camera_from_face);
    made.truth.landmarks_m.push_back(landmarks);
    made.truth.jaw_open.push_back(0.2 * k);
    made.tracked.push_back(frame);
  }
  return made;
}

TEST(Score, IsZeroForTheSameMotionInAnotherFrame) {
  const TruthAndTrack same = truth_and_track(0);
  const Score score = tracking::score(expression::canonical_model(), same.tracked, same.truth);
  EXPECT_EQ(score.frames, 5u);
  EXPECT_EQ(score.lost, 0u);
  EXPECT_LT(score.rotation_deg.p95, 1e-5);
  EXPECT_LT(score.translation_mm.p95, 1e-6);
  EXPECT_LT(score.deformation_mm.p95, 1e-6);
  EXPECT_NEAR(score.jaw_correlation.value(), 1, 1e-9);
  EXPECT_FALSE(score.rest_jitter_mm);
}

TEST(Score, TellsErrorsAndLostFrames) {
  TruthAndTrack off = truth_and_track(0.002);
  off.tracked[3].valid = false;
  off.tracked[2].camera_from_head.translation().x() += 0.005;
  const Score score = tracking::score(expression::canonical_model(), off.tracked, off.truth);
  EXPECT_EQ(score.lost, 1u);
  EXPECT_NEAR(score.deformation_mm.median, 2, 1e-6);
  EXPECT_NEAR(score.translation_mm.p95, 4.5, 1e-6);  // between 0, 0 and 5: 0.9 of the way
}

}  // namespace
}  // namespace hyperex::tracking
