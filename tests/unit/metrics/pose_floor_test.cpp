// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/pose_floor.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <random>

#include "hyperex/face/canonical_face.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/motion/stabilise.hpp"
#include "support/draws.hpp"

namespace hyperex::metrics {
namespace {

using motion::UncertainPose;

/// Two points, the left one at x = 30 mm, which move by `left` and `right` (mm) in the second
/// sample.
motion::Motion pair_moving(const Vec3& left, const Vec3& right) {
  motion::Motion out;
  out.names = {"cheilion_L", "cheilion_R"};
  out.time_s = {0, 1};
  Points rest(2, 3);
  rest << 0.03, 0, 0, -0.03, 0, 0;
  Points moved = rest;
  moved.row(0) += 1e-3 * left.transpose();
  moved.row(1) += 1e-3 * right.transpose();
  out.positions = {rest, moved};
  return out;
}

std::vector<UncertainPose> uncertain(int component, double sigma) {
  std::vector<UncertainPose> poses(2);
  poses[1].covariance(component, component) = sigma * sigma;
  return poses;
}

/// Pose floor of the difference of both sides where the filter leaves this share of jitter.
double pose_floor_mm(const motion::Motion& motion, const std::vector<UncertainPose>& poses,
                     double jitter_share = 1) {
  Excursions all;
  all.pairs.resize(1);
  all.pairs[0].jitter_share = jitter_share;
  add_pose_floors(all, {{"", pose_variance(motion, poses, 0, 1, 0)}});
  return all.pairs[0].pose_floor_mm;
}

TEST(PoseFloor, IsWhatAShiftOrATurnMakesOfTheDifference) {
  constexpr int turn_z = 2, shift_x = 3, shift_y = 4;
  const auto apart = pair_moving({5, 0, 0}, {-5, 0, 0}), up = pair_moving({0, 5, 0}, {0, 5, 0});
  // A shift aside lengthens one excursion as it shortens the other.
  EXPECT_NEAR(pose_floor_mm(apart, uncertain(shift_x, 1e-4)), 1.96 * 0.2, 1e-9);
  EXPECT_NEAR(pose_floor_mm(apart, uncertain(shift_y, 1e-4)), 0, 1e-9);
  EXPECT_NEAR(pose_floor_mm(up, uncertain(shift_y, 1e-4)), 0, 1e-9);
  // A roll lifts one corner and lowers the other by the same, 30 mm times the angle.
  EXPECT_NEAR(pose_floor_mm(up, uncertain(turn_z, 1e-3)), 1.96 * 2 * 0.03, 1e-9);
  EXPECT_EQ(pose_floor_mm(up, {}), 0);
}

TEST(PoseFloor, OfOneSideContainsWhatBothSidesShare) {
  const auto up = pair_moving({0, 5, 0}, {0, 5, 0});
  const PairPoseVariance shift_up = pose_variance(up, uncertain(4, 1e-4), 0, 1, 0);
  EXPECT_NEAR(shift_up.difference.all, 0, 1e-12);
  EXPECT_NEAR(shift_up.left.all, 0.01, 1e-9) << "0.1 mm, squared";
  Excursions all;
  all.pairs.resize(1);
  add_pose_floors(all, {{"", shift_up}}, 2);
  EXPECT_NEAR(all.pairs[0].right_side.pose_floor_mm, 2 * 1.96 * 0.1, 1e-9);
}

TEST(PoseFloor, FilteringTakesAwayJittersPartAlone) {
  const motion::Motion motion = pair_moving({5, 0, 0}, {-5, 0, 0});
  std::vector<UncertainPose> poses = uncertain(3, 1e-4);
  constexpr double left = 0.3;
  EXPECT_NEAR(pose_floor_mm(motion, poses, left), 1.96 * 0.2, 1e-9);
  for (UncertainPose& pose : poses) pose.of_jitter = 0.5 * pose.covariance;
  EXPECT_NEAR(pose_floor_mm(motion, poses, left), 1.96 * 0.2 * std::sqrt(1 - 0.5 * (1 - left)),
              1e-9);
  EXPECT_NEAR(pose_floor_mm(motion, poses), 1.96 * 0.2, 1e-9);
}

TEST(PoseFloor, IsTheSpreadOfDifferencesUnderRandomErrorsOfThePose) {
  const motion::Motion exact = pair_moving({4, 7, -2}, {-5, 6, -1});
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const auto noise = [&] { return normal(random); };
  std::vector<UncertainPose> poses(2);
  poses[1].centre = Vec3(0, 0.03, -0.02);
  const auto root = Eigen::Matrix<double, 6, 6>::NullaryExpr([&] { return 1e-3 * noise(); }).eval();
  Eigen::Matrix<double, 6, 6> scaled = root;
  scaled.bottomRows<3>() *= 0.2;
  poses[1].covariance = scaled * scaled.transpose();
  const double floor = pose_floor_mm(exact, poses);
  const double truth = excursions_of(exact).pairs.at(0).difference_mm();
  int beyond = 0;
  constexpr int draws = 4000;
  for (int i = 0; i < draws; ++i) {
    const Eigen::Matrix<double, 6, 1> error =
        scaled * Eigen::Matrix<double, 6, 1>::NullaryExpr(noise);
    motion::Motion seen = exact;
    for (auto point : seen.positions[1].rowwise())
      point += (motion::pose_derivative(point.transpose() - poses[1].centre) * error).transpose();
    beyond += std::abs(excursions_of(seen).pairs.at(0).difference_mm() - truth) > floor;
  }
  EXPECT_NEAR(double(beyond) / draws, 0.05, 0.015);
}

/// A symmetric smile of the canonical face's landmarks, mm.
Vec3 smile_mm(const std::string& name) {
  for (const auto& [point, side] : {std::pair{48, -1.0}, {54, 1.0}, {60, -0.9}, {64, 0.9}})
    if (name == face::ibug(point)) return {4 * side, 8, -3};
  return Vec3::Zero();
}

TEST(PoseFloor, ASymmetricSmileOfAMovingHeadIsRarelyCalledAsymmetric) {
  const face::CanonicalFace& face = face::canonical_face();
  motion::Motion rest;
  for (int k = 0; k < 68; ++k) rest.names.push_back(face::ibug(k));
  constexpr double noise_m = 0.3e-3;
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  // A second at rest, and a smile of two.
  constexpr int instants = 90, still = 30;
  constexpr double rate_hz = 30;
  const int draws = 2 * hyperex::test::draws();
  int decided = 0, found = 0, without_pose = 0;
  for (int i = 0; i < draws; ++i) {
    const bool weak = i % 2;  // every second one by 1.5 mm on the right
    motion::Motion seen = rest;
    const Vec3 axis = Vec3::NullaryExpr([&] { return normal(random); }).normalized();
    for (int k = 0; k < instants; ++k) {
      const double course =
          k < still ? 0 : (1 - std::cos(2 * M_PI * (k - still) / (instants - 1 - still))) / 2;
      Eigen::Isometry3d head = Eigen::Isometry3d::Identity();
      head.rotate(Eigen::AngleAxisd(0.1 * course, axis)).pretranslate(Vec3(0.005 * course, 0, 0));
      Points at(68, 3);
      for (int p = 0; p < 68; ++p) {
        Vec3 moved = smile_mm(face::ibug(p));
        if (weak && (p == 48 || p == 60)) moved *= 1 - 1.5 / moved.norm();
        at.row(p) =
            head * (face.landmark(face::ibug(p), face.mesh.points) + 1e-3 * course * moved) +
            noise_m * Vec3::NullaryExpr([&] { return normal(random); });
      }
      seen.time_s.push_back(k / rate_hz);
      seen.positions.push_back(at);
    }
    const motion::StabilisedMotion steady = motion::stabilise(seen);
    Excursions all = excursions_of(steady.motion, noise_m);
    const auto corners = [&]() -> const PairExcursion& {
      return *std::ranges::find(all.pairs, "ibug68_48/54", &PairExcursion::name);
    };
    without_pose += !weak && !corners().undecided;
    add_pose_floors(all, pose_variances(steady.motion, steady.poses, kUsualLowpass_hz));
    (weak ? found : decided) += !corners().undecided;
  }
  std::printf("decided: %d of %d symmetric ones (%d without the pose), %d of %d by 1.5 mm\n",
              decided, draws / 2, without_pose, found, draws / 2);
  EXPECT_LE(decided, 0.05 * draws / 2 + 1);
  EXPECT_GE(found, 0.8 * draws / 2 - 1);
}

}  // namespace
}  // namespace hyperex::metrics
