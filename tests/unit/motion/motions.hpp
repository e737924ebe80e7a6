// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Synthetic motions, and a check of error messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "hyperex/core/error.hpp"
#include "hyperex/motion/motion.hpp"
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

/// The path of a real recording; empty where there is none.
inline std::filesystem::path recording(const std::string& name) {
  const auto folder = std::filesystem::path(HYPEREX_SHARED_DIR) / "data/rgbd" / name;
  return std::filesystem::exists(folder) ? folder : std::filesystem::path();
}

}  // namespace hyperex::motion::testing
