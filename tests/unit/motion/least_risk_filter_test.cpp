// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/least_risk_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace hyperex::motion {
namespace {

/// Two points that come and go once in two seconds, by 10 mm, at 60 Hz.
struct Smile {
  std::vector<double> time_s;
  Eigen::MatrixXd tracks{6, 120};
  Smile() {
    for (int k = 0; k < tracks.cols(); ++k) {
      time_s.push_back(k / 60.0);
      const double share = (1 - std::cos(std::numbers::pi * time_s.back())) / 2;
      tracks.col(k) << 0.01 * share, 0.005 * share, 0, 0, -0.01 * share, 0.002 * share;
    }
  }
};

Eigen::MatrixXd with_noise(Eigen::MatrixXd tracks, double noise_m) {
  std::mt19937 engine(5);
  std::normal_distribution<double> normal(0, noise_m);
  for (double& value : tracks.reshaped()) value += normal(engine);
  return tracks;
}

double rms(const Eigen::MatrixXd& error) {
  return std::sqrt(error.squaredNorm() / double(error.size()));
}

TEST(LeastRiskFilter, RemovesMostOfTheNoise) {
  const Smile smile;
  const double noise_m = 3e-4;
  const Eigen::MatrixXd noisy = with_noise(smile.tracks, noise_m);
  const Eigen::MatrixXd found = least_risk_filtered(smile.time_s, noisy, noise_m);
  EXPECT_LT(rms(found - smile.tracks), 0.45 * noise_m);
}

TEST(LeastRiskFilter, LeavesAQuickMotionThatNoiseDoesNotHide) {
  Smile smile;
  for (int k = 60; k < 66; ++k) smile.tracks(4, k) += 0.008;  // a blink
  const double noise_m = 3e-4;
  const Eigen::MatrixXd noisy = with_noise(smile.tracks, noise_m);
  const Eigen::MatrixXd found = least_risk_filtered(smile.time_s, noisy, noise_m);
  EXPECT_GT(found(4, 63) - found(4, 50), 0.9 * (smile.tracks(4, 63) - smile.tracks(4, 50)));
  EXPECT_LT(rms(found - smile.tracks), noise_m);
}

TEST(LeastRiskFilter, WithoutNoiseNothingChanges) {
  const Smile smile;
  for (const double noise_m : {0.0, double(NAN), 1e-7})
    EXPECT_LT(rms(least_risk_filtered(smile.time_s, smile.tracks, noise_m) - smile.tracks), 1e-6)
        << noise_m;
  EXPECT_EQ(least_risk_filtered(smile.time_s, smile.tracks, 0), smile.tracks);
}

TEST(LeastRiskFilter, PosesFarApartAreLeftAsTheyAre) {
  std::vector<double> time_s;
  for (int k = 0; k < 30; ++k) time_s.push_back(k / 5.0);
  const Eigen::MatrixXd tracks = with_noise(Eigen::MatrixXd::Zero(3, 30), 5e-3);
  EXPECT_EQ(least_risk_filtered(time_s, tracks, 5e-3), tracks);
}

TEST(LeastRiskFilter, AShortRecordingIsLeftAsItIs) {
  const std::vector<double> time_s = {0, 0.1, 0.2};
  const Eigen::MatrixXd tracks = with_noise(Eigen::MatrixXd::Zero(3, 3), 1e-3);
  EXPECT_EQ(least_risk_filtered(time_s, tracks, 1e-3), tracks);
}

}  // namespace
}  // namespace hyperex::motion
