// SPDX-License-Identifier: GPL-3.0-or-later
// The measurements of FrameFit compared with finite differences; the person's shape from synthetic
// observations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "face_depth.hpp"
#include "hyperex/core/quantile.hpp"
#include "hyperex/geometry/transform.hpp"
#include "hyperex/tracking/fit/neutral.hpp"

namespace hyperex::tracking {
namespace {

const capture::Intrinsics kSensor{525, 525, 319.5, 239.5, 640, 480};

Eigen::Isometry3d head_pose(double turn_deg, const Vec3& at) {
  Eigen::Isometry3d made = Eigen::Isometry3d::Identity();
  made.linear() =
      (Eigen::AngleAxisd(turn_deg * std::numbers::pi / 180, Vec3(0.3, 1, -0.2).normalized()) *
       Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()))
          .toRotationMatrix();
  made.translation() = at;
  return made;
}

/// `state` with parameter k (rotation, translation, weights) changed by `step`.
FaceState moved(FaceState state, int k, double step) {
  Eigen::Isometry3d head = Eigen::Isometry3d::Identity();
  if (k < 3)
    head.linear() = Eigen::AngleAxisd(step, Vec3::Unit(k)).toRotationMatrix();
  else if (k < 6)
    head.translation()[k - 3] = step;
  else
    state.weights[k - 6] += step;
  state.camera_from_head = state.camera_from_head * head;
  return state;
}

/// A face with its mouth half open, as the network and a depth camera see it.
struct Seen {
  FaceState truth;
  Observation observation;
};
Seen seen_by(const expression::FaceModel& model, const FrameFit& fit) {
  Seen seen{fit.at_rest(), {}};
  seen.truth.camera_from_head = head_pose(6, {0.01, 0, 0.6});
  seen.truth.weights[model.jaw_drop] = 0.3;
  const Points camera = in_camera(seen.truth.camera_from_head, fit.vertices(seen.truth));
  seen.observation.network_px = network_of(camera, kSensor);
  seen.observation.depth_m = depth_of({camera, model.mesh.triangles}, kSensor);
  return seen;
}

/// Compares the gradient of `fit.measure` at `state` with that of `cost`.
template <class Cost>
void expect_gradient_of(const FrameFit& fit, const Observation& seen, const FaceState& state,
                        const Cost& cost) {
  const Eigen::VectorXd gradient =
      fit.parameter_jacobian(state).transpose() * fit.measure(seen, state, nullptr).gradient();
  EXPECT_GT(gradient.norm(), 1);
  for (int k = 0; k < gradient.size(); ++k) {
    const double numeric = (cost(moved(state, k, 1e-6)) - cost(moved(state, k, -1e-6))) / 2e-6;
    EXPECT_NEAR(gradient[k], numeric, 1e-5 * (gradient.norm() + std::abs(numeric))) << k;
  }
}

TEST(Measure, JacobianOfTheProjectionAgreesWithFiniteDifferences) {
  const capture::Intrinsics camera{525, 480, 319.5, 239.5, 640, 480};  // pixels that are not square
  for (const Vec3& p : {Vec3(0.2, -0.15, 0.6), Vec3(-0.1, 0.25, 0.9), Vec3(0, 0, 0.5)}) {
    const Eigen::Matrix<double, 2, 3> jacobian = project_jacobian(camera, p);
    for (int k = 0; k < 3; ++k) {
      const Vec3 step = 1e-6 * Vec3::Unit(k);
      const Eigen::Vector2d numeric =
          (project(camera, p + step) - project(camera, p - step)) / 2e-6;
      EXPECT_LT((jacobian.col(k) - numeric).norm(), 1e-4) << k << " at " << p.transpose();
    }
  }
}

TEST(Measure, NetworkTermAgreesWithFiniteDifferencesAtFrozenWeights) {
  const expression::FaceModel& model = expression::canonical_model();
  const FrameFit fit(model, kSensor, model.mesh.points, 1, {});
  Seen seen = seen_by(model, fit);
  seen.observation.depth_m.release();
  seen.observation.network_px.row(4).x() += 25;  // far off: hardly counts
  FaceState state = fit.at_rest();
  state.camera_from_head = head_pose(4, {0.012, 0.004, 0.61});
  const VertexSystem system = fit.measure(seen.observation, state, nullptr);
  // What the normal matrix says that a vertex counts: its block is weight * J^T J.
  const Points points = fit.vertices(state);
  std::vector<double> weight;
  for (int v = 0; v < points.rows(); ++v) {
    const Vec3 p = state.camera_from_head * Vec3(points.row(v).transpose());
    weight.push_back(system.diagonal(v).trace() / project_jacobian(kSensor, p).squaredNorm());
  }
  EXPECT_LT(weight[4], 0.2 * weight[5]);
  expect_gradient_of(fit, seen.observation, state, [&](const FaceState& at) {
    const Points now = fit.vertices(at);
    double sum = 0;
    for (int v = 0; v < now.rows(); ++v)
      sum += 0.5 * weight[std::size_t(v)] *
             (project(kSensor, at.camera_from_head * Vec3(now.row(v).transpose())) -
              seen.observation.network_px.row(v).head<2>().transpose())
                 .squaredNorm();
    return sum;
  });
}

TEST(Measure, DepthTermAgreesWithFiniteDifferencesAtFrozenPlanes) {
  expression::FaceModel model = expression::canonical_model();
  const FrameFit whole(model, kSensor, model.mesh.points, 1, {});
  const Seen seen = seen_by(model, whole);
  model.pairs.clear();  // depth alone
  const FitOptions options;
  const FrameFit fit(model, kSensor, model.mesh.points, 1, options);
  FaceState state = seen.truth;
  state.camera_from_head = state.camera_from_head * Eigen::Translation3d(0.001, -0.0005, 0.002) *
                           Eigen::AngleAxisd(0.01, Vec3::UnitY());
  state.weights[model.jaw_drop] += 0.03;
  const VertexSystem system = fit.measure(seen.observation, state, nullptr);
  struct Plane {
    int vertex;
    double weight;
    SurfacePatch patch;
  };
  std::vector<Plane> planes;
  const Points points = fit.vertices(state);
  for (int v = 0; v < points.rows(); ++v) {
    const double weight = system.diagonal(v).trace();  // weight * |n|^2
    if (weight == 0) continue;
    const Vec3 p = state.camera_from_head * Vec3(points.row(v).transpose());
    const auto patch =
        surface_patch(seen.observation.depth_m, kSensor, project(kSensor, p), p.z(), options.patch);
    ASSERT_TRUE(patch) << v;
    EXPECT_LE(weight, 1 / (options.depth_m * options.depth_m)) << v;
    planes.push_back({v, weight, *patch});
  }
  EXPECT_GT(planes.size(), 150u);
  expect_gradient_of(fit, seen.observation, state, [&](const FaceState& at) {
    const Points now = fit.vertices(at);
    double sum = 0;
    for (const Plane& plane : planes) {
      const Vec3 p = at.camera_from_head * Vec3(now.row(plane.vertex).transpose());
      sum += 0.5 * plane.weight * std::pow(plane.patch.normal.dot(p - plane.patch.point), 2);
    }
    return sum;
  });
}

TEST(Measure, WithDepthAFaceIsPutWhereItIs) {
  const expression::FaceModel& model = expression::canonical_model();
  FitOptions options;
  options.iterations = 8;
  FrameFit fit(model, kSensor, model.mesh.points, 1, options);
  const Seen seen = seen_by(model, fit);
  FaceState start = fit.at_rest();
  start.camera_from_head = fit.first_pose(seen.observation);
  FitReport report;
  const FaceState found = fit.fit(seen.observation, start, nullptr, nullptr, &report);
  const Eigen::Isometry3d off = seen.truth.camera_from_head.inverse() * found.camera_from_head;
  EXPECT_LT(off.translation().norm(), 1e-3);
  EXPECT_LT(Eigen::AngleAxisd(off.linear()).angle(), 0.01);
  EXPECT_LT(report.depth_rms_m, 5e-4);
  EXPECT_GT(report.depth_share, 0.8);
}

/// A person: the canonical face enlarged by a fifth, broader and with a longer nose.
Points person(const expression::FaceModel& model) {
  Points points = 1.2 * model.mesh.points;
  points.col(0) *= 1.05;
  const Eigen::RowVector3d tip = points.row(4);
  for (Eigen::Index v = 0; v < points.rows(); ++v)
    points(v, 2) += 0.005 * std::exp(-(points.row(v) - tip).squaredNorm() / (2 * 0.01 * 0.01));
  return points;
}

TEST(EstimateNeutral, FindsAPersonsShapeAndSizeFromDepth) {
  const expression::FaceModel& model = expression::canonical_model();
  const Points truth = person(model);
  std::vector<Observation> frames;
  for (const double turn : {-8.0, 0.0, 8.0}) {
    const Points camera = in_camera(head_pose(turn, {0.001 * turn, 0, 0.6}), truth);
    frames.push_back(
        {network_of(camera, kSensor), depth_of({camera, model.mesh.triangles}, kSensor), {}});
  }
  const Neutral neutral = estimate_neutral(model, kSensor, frames);
  EXPECT_TRUE(neutral.metric);
  EXPECT_NEAR(neutral.scale, 1.22, 0.03);
  const Eigen::VectorXd all = Eigen::VectorXd::Ones(truth.rows());
  const Similarity onto = fit_similarity(neutral.points_m, truth, all);
  EXPECT_NEAR(onto.scale, 1, 0.01);
  const Eigen::VectorXd off = (onto.apply(neutral.points_m) - truth).rowwise().norm();
  std::vector<double> errors(off.begin(), off.end());
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(quantile_of_sorted(errors, 0.5), 7e-4);
  EXPECT_LT(quantile_of_sorted(errors, 0.95), 2.7e-3);
  EXPECT_LT(off[4], 2.5e-3);  // the tip of the nose, finer than the patches of depth
}

TEST(EstimateNeutral, WithoutDepthTakesTheStatedDistanceOfTheEyes) {
  const expression::FaceModel& model = expression::canonical_model();
  const Points camera = in_camera(head_pose(5, {0, 0, 0.6}), person(model));
  NeutralOptions options;
  options.eye_distance_m = 0.101;
  const Neutral neutral =
      estimate_neutral(model, kSensor, {{network_of(camera, kSensor), {}, {}}}, options);
  EXPECT_FALSE(neutral.metric);
  const auto corner = [&](const char* name) {
    return expression::landmark_at(model.landmarks.at(name), neutral.points_m);
  };
  EXPECT_NEAR((corner("exocanthion_L") - corner("exocanthion_R")).norm(), 0.101, 1e-9);
}

}  // namespace
}  // namespace hyperex::tracking
