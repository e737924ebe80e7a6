// SPDX-License-Identifier: GPL-3.0-or-later
// Linked to libfreenect's fakenect library, which acts as a Kinect and replays the test's
// recording. It does so once per process, since it keeps its position in the recording; CTest runs
// each case in its own process.
#include "hyperex/capture/kinect.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <utility>

#include "hyperex/capture/kinect_depth.hpp"
#include "hyperex/capture/open_source.hpp"
#include "recording.hpp"
#include "support/fakenect_recording.hpp"

namespace hyperex::capture {
namespace {
using hyperex::test::FakenectRecording;
using testing::HasSubstr;
using namespace test;

double metres(int raw) {
  return kinect_depth_m(raw);
}

constexpr int frames = 8;
constexpr std::uint32_t period_ticks = 2000000;
/// The device's 32-bit clock wraps between the third and the fourth frame.
constexpr std::uint32_t first_ticks = 0u - 5 * period_ticks / 2;

cv::Mat colour(int frame) {
  return {480, 640, CV_8UC3, cv::Scalar(50 + frame, 100, 200)};
}

/// The upper half is a wall that comes nearer; the lower half is near, with a right edge at column
/// 320.
cv::Mat raw_depth(int frame) {
  cv::Mat raw(480, 640, CV_16UC1, cv::Scalar(800 - 8 * frame));
  raw.rowRange(240, 480).colRange(0, 320) = 700;
  raw.rowRange(240, 480).colRange(320, 640) = 2047;
  return raw;
}

class KinectTest : public testing::Test {
 protected:
  KinectTest() {
    setenv("FAKENECT_PATH", folder_.path().c_str(), 1);
    setenv("FAKENECT_LOOP", "0", 1);  // newer ones begin anew at the end
  }
  void SetUp() override {
    static bool replayed = false;
    if (std::exchange(replayed, true)) GTEST_SKIP() << "fakenect replays once a process: use ctest";
  }
  /// `skipped` lacks its depth, `blind` has depth without a reading.
  void record(int skipped = -1, int blind = -1) const {
    FakenectRecording recording(folder_.path());
    for (int i = 0; i < frames; ++i) {
      const double time_s = 100 + i / 30.0;
      const std::uint32_t ticks = first_ticks + static_cast<std::uint32_t>(i) * period_ticks;
      recording.add_tilt(time_s, ticks);
      recording.add_colour(time_s + 0.001, ticks, colour(i));
      if (i == skipped) continue;
      const cv::Mat depth =
          i == blind ? cv::Mat(480, 640, CV_16UC1, cv::Scalar(2047)) : raw_depth(i);
      recording.add_depth(time_s + 0.006, ticks + period_ticks / 6, depth);
    }
  }
  Folder folder_;
};

TEST_F(KinectTest, GivesColourAndDepthInMetres) {
  record();
  const auto source = open_kinect();
  EXPECT_TRUE(source->live());
  EXPECT_TRUE(source->has_depth());
  EXPECT_FALSE(source->frame_count());
  EXPECT_EQ(source->intrinsics().width_px, 640);
  EXPECT_EQ(source->intrinsics().fx_px, 525);
  const auto all = read_all(*source);
  ASSERT_EQ(all.size(), static_cast<std::size_t>(frames));
  for (int i = 0; i < frames; ++i) {
    const Frame& frame = all[static_cast<std::size_t>(i)];
    EXPECT_TRUE(frame.valid) << frame.fault;
    EXPECT_EQ(frame.index, static_cast<std::size_t>(i));
    EXPECT_NEAR(frame.time_s, i / 30.0, 1e-9) << "across the wrap of the device's clock";
    ASSERT_EQ(frame.colour.type(), CV_8UC3);
    EXPECT_EQ(frame.colour.at<cv::Vec3b>(240, 320),
              cv::Vec3b(static_cast<uchar>(50 + i), 100, 200));
    ASSERT_EQ(frame.depth_m.type(), CV_32FC1);
    EXPECT_NEAR(frame.depth_m.at<float>(100, 400), metres(800 - 8 * i), 1e-5);
    EXPECT_NEAR(frame.depth_m.at<float>(400, 200), metres(700), 1e-5);
    EXPECT_EQ(frame.depth_m.at<float>(400, 400), 0);
  }
  EXPECT_THAT(source->notes(), testing::Contains(HasSubstr("nominal")));
  EXPECT_THAT(source->notes(), testing::Contains(HasSubstr("nominal calibration")));
  EXPECT_THAT(source->notes(), testing::Contains(HasSubstr("lost")));
}

TEST_F(KinectTest, RegistersDepthToColour) {
  record();
  const auto source = open_kinect();
  const auto frame = source->next();
  ASSERT_TRUE(frame);
  const cv::Mat row = frame->depth_m.row(400);
  int edge = 639;
  while (edge > 0 && row.at<float>(edge) == 0) --edge;
  // Column 319 of the depth camera, seen by the colour camera 23 mm beside it.
  const double shift_px = 525 * 0.023 / metres(700);
  EXPECT_NEAR(edge, 319.5 + 525 * (319 - 319.5) / 575.8 + shift_px, 0.6);
  EXPECT_GT(shift_px, 10) << "else this test shows nothing";
}

TEST(KinectDepth, FollowsTheGeometryOfItsSensor) {
  // On the reference plane nothing is shifted; nearer by what triangulation says:
  // disparity = f emitter (1 / z - 1 / z0), in pixels of 640 columns, an eighth of one a step.
  EXPECT_NEAR(metres(800), 1.2, 0.01);
  for (const int raw : {450, 600, 700, 900, 1000}) {
    const double disparity_px = 575.8 * 0.075 * (1 / metres(raw) - 1 / metres(800));
    EXPECT_NEAR(disparity_px, (800 - raw) / 8.0, 0.01) << raw;
  }
  EXPECT_EQ(metres(2047), 0);
  EXPECT_EQ(metres(1200), 0) << "behind infinity";
  EXPECT_EQ(metres(-1), 0);
}

TEST(KinectDepth, TheNearerReadingWinsAPixel) {
  const Intrinsics vga{525, 525, 319.5, 239.5, 640, 480};
  cv::Mat raw(480, 640, CV_16UC1, cv::Scalar(2047));
  const auto column = [&](int at) {  // where a reading at the column lands
    return 319.5 + 525 * ((at - 319.5) / 575.8 + 0.023 / metres(raw.at<ushort>(100, at)));
  };
  raw.at<ushort>(100, 300) = 500;
  const double near_column = column(300);
  int behind = 301;
  do {
    raw.at<ushort>(100, ++behind) = 900;
  } while (std::lround(column(behind)) < std::lround(near_column));
  const cv::Mat depth_m = registered_nominally(raw, vga);
  int row = 0;
  while (row < 479 && depth_m.at<float>(row, static_cast<int>(std::lround(near_column))) == 0)
    ++row;
  EXPECT_NEAR(depth_m.at<float>(row, static_cast<int>(std::lround(near_column))), metres(500),
              1e-5);
}

TEST_F(KinectTest, AFrameWithoutItsDepthIsLeftOut) {
  record(4);
  const auto all = read_all(*open_kinect());
  ASSERT_EQ(all.size(), static_cast<std::size_t>(frames - 1));
  EXPECT_NEAR(all[3].time_s, 3 / 30.0, 1e-9);
  EXPECT_NEAR(all[4].time_s, 5 / 30.0, 1e-9);
  EXPECT_EQ(all[4].colour.at<cv::Vec3b>(0, 0)[0], 55);
}

TEST_F(KinectTest, DepthWithoutAReadingIsAFault) {
  record(-1, 2);
  const auto all = read_all(*open_kinect());
  ASSERT_EQ(all.size(), static_cast<std::size_t>(frames));
  for (const Frame& frame : all) EXPECT_EQ(frame.valid, frame.index != 2) << frame.fault;
  EXPECT_THAT(all[2].fault, HasSubstr("without a single reading"));
}

TEST_F(KinectTest, ColourAlone) {
  record();
  const auto source = open_kinect({.colour_only = true});
  EXPECT_FALSE(source->has_depth());
  const auto all = read_all(*source);
  ASSERT_EQ(all.size(), static_cast<std::size_t>(frames));
  for (const Frame& frame : all) EXPECT_TRUE(frame.valid && frame.depth_m.empty()) << frame.fault;
}

TEST_F(KinectTest, GivesUpOnADeviceThatIsSilent) {
  record();
  write_text(folder_ / "INDEX.txt", "");
  EXPECT_THAT(refusal([] { open_kinect()->next(); }), HasSubstr("kinect: "));
}

TEST_F(KinectTest, TakesTheUsersCamera) {
  record();
  const std::string k = "fx = 517\nfy = 516\ncx = 318\ncy = 255\n";
  write_text(folder_ / "vga.toml", "width = 640\nheight = 480\n" + k);
  write_text(folder_ / "hd.toml", "width = 1280\nheight = 720\n" + k);
  EXPECT_EQ(open_kinect({.camera_file = folder_ / "vga.toml"})->intrinsics().fx_px, 517);
  EXPECT_THAT(refusal([&] { open_kinect({.camera_file = folder_ / "hd.toml"}); }),
              HasSubstr("640 x 480"));
}

TEST_F(KinectTest, OpensByItsNameAndDropsRatherThanWaits) {
  record();
  const auto source = open_source("kinect");
  EXPECT_TRUE(source->live());
  const auto all = read_all(*source);
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(all.size() + source->dropped(), static_cast<std::size_t>(frames));
  EXPECT_EQ(all.back().index, static_cast<std::size_t>(frames - 1));
}

}  // namespace
}  // namespace hyperex::capture
