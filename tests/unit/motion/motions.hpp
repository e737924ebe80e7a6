// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Synthetic motions, and a check of error messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "hyperex/core/error.hpp"
#include "hyperex/motion/motion.hpp"
#include "hyperex/motion/read_motion.hpp"
#include "hyperex/motion/stabilise.hpp"
#include "support/refusal.hpp"

namespace hyperex::motion::testing {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double kDegree = M_PI / 180;

/// The default points for the head pose that a motion has.
inline std::vector<std::string> default_points(const Motion& motion) {
  std::vector<std::string> names;
  for (const auto& name : default_rigid_points())
    if (motion.index_of(name) >= 0) names.push_back(name);
  return names;
}

/// Checks that `work` throws an InputError of one line that contains every one of `parts`.
inline void expect_refused(const std::function<void()>& work,
                           const std::vector<std::string>& parts) {
  const std::string text = test::refusal(work);
  EXPECT_NE(text, "") << "was not refused";
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  for (const auto& part : parts) EXPECT_THAT(text, ::testing::HasSubstr(part));
}

/// A motion of `samples` samples, `step_s` apart. The coordinates of its points are `at(t, point,
/// axis)`.
inline Motion sampled(int samples, double step_s, const std::vector<std::string>& names,
                      const std::function<double(double, int, int)>& at) {
  Motion motion;
  motion.names = names;
  for (int k = 0; k < samples; ++k) {
    Points sample(Eigen::Index(names.size()), 3);
    for (int p = 0; p < sample.rows(); ++p)
      for (int axis = 0; axis < 3; ++axis) sample(p, axis) = at(k * step_s, p, axis);
    motion.time_s.push_back(k * step_s);
    motion.positions.push_back(sample);
  }
  return motion;
}

/// The largest difference of a coordinate between two motions of the same samples and points, m.
inline double greatest_difference(const Motion& a, const Motion& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.positions.size(); ++k)
    most = std::max(most, (a.positions[k] - b.positions[k]).cwiseAbs().maxCoeff());
  return most;
}

/// The shared recordings of real and rendered faces; none where they are not here.
inline std::vector<Motion> recordings_of_faces() {
  const auto data = std::filesystem::path(HYPEREX_SHARED_DIR) / "data";
  std::vector<Motion> all;
  if (!std::filesystem::exists(data)) return all;
  for (const char* file : {"real/animface/cheeks_mm.csv", "real/spacetime/smile_mm.csv",
                           "real/spacetime/smile_7_mm.csv"})
    all.push_back(read_motion(data / file));
  for (const char* folder : {"subject_A_mouth_open", "subject_A_talk", "subject_A_still"})
    all.push_back(read_motion(data / "rgbd" / folder / "truth_landmarks68_camera_m.csv"));
  return all;
}

/// The path of a real recording; empty where there is none.
inline std::filesystem::path recording(const std::string& name) {
  const auto folder = std::filesystem::path(HYPEREX_SHARED_DIR) / "data/rgbd" / name;
  return std::filesystem::exists(folder) ? folder : std::filesystem::path();
}

}  // namespace hyperex::motion::testing
