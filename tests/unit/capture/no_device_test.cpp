// SPDX-License-Identifier: GPL-3.0-or-later
// The real libraries on a machine without a camera (where there is one, these tests skip).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hyperex/capture/kinect.hpp"
#include "hyperex/capture/openni.hpp"
#include "recording.hpp"

namespace hyperex::capture {
namespace {
using test::refusal;

void expect_one_clear_line(const std::string& error, const std::string& name) {
  if (error.empty()) GTEST_SKIP() << "there is a camera";
  EXPECT_THAT(error, testing::StartsWith(name + ": "));
  EXPECT_THAT(error, testing::Not(testing::HasSubstr("\n")));
}

TEST(NoDevice, KinectSaysSo) {
  expect_one_clear_line(refusal([] { open_kinect(); }), "kinect");
}

TEST(NoDevice, OpenniSaysSo) {
  expect_one_clear_line(refusal([] { open_openni(); }), "openni");
}

}  // namespace
}  // namespace hyperex::capture
