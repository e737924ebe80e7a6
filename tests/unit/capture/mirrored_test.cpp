// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/mirrored.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hyperex::capture {
namespace {

/// Two frames of 4 x 1 pixels, the second without a picture.
class Strip : public FrameSource {
 public:
  const Intrinsics& intrinsics() const override { return camera_; }
  bool has_depth() const override { return true; }
  bool live() const override { return true; }
  std::optional<std::size_t> frame_count() const override { return 2; }
  std::optional<Frame> next() override {
    Frame frame;
    frame.index = given_++;
    frame.time_s = 0.1 * double(frame.index);
    if (frame.index == 0) {
      frame.colour = colour;
      frame.depth_m = (cv::Mat_<float>(1, 4) << 0, 1, 2, 3);
    } else if (frame.index == 1) {
      frame.valid = false;
      frame.fault = "torn";
    } else {
      return std::nullopt;
    }
    return frame;
  }
  std::size_t dropped() const override { return 7; }
  std::vector<std::string> notes() const override { return {"a strip"}; }

  cv::Mat colour = (cv::Mat_<cv::Vec3b>(1, 4) << cv::Vec3b(1, 2, 3), cv::Vec3b(4, 5, 6),
                    cv::Vec3b(7, 8, 9), cv::Vec3b(10, 11, 12));

 private:
  Intrinsics camera_{5, 6, 1, 0.25, 4, 1};
  std::size_t given_ = 0;
};

TEST(Mirrored, FlipsColourDepthAndThePrincipalPoint) {
  auto strip = std::make_unique<Strip>();
  const cv::Mat original = strip->colour;
  Mirrored source(std::move(strip));
  EXPECT_EQ(source.intrinsics().cx_px, 2);  // of pixels 0 to 3
  EXPECT_EQ(source.intrinsics().cy_px, 0.25);
  EXPECT_EQ(source.intrinsics().fx_px, 5);
  const auto frame = source.next();
  ASSERT_TRUE(frame);
  for (int x = 0; x < 4; ++x) {
    EXPECT_EQ(frame->colour.at<cv::Vec3b>(0, x), original.at<cv::Vec3b>(0, 3 - x));
    EXPECT_EQ(frame->depth_m.at<float>(0, x), float(3 - x));
  }
  EXPECT_EQ(original.at<cv::Vec3b>(0, 0), cv::Vec3b(1, 2, 3)) << "the source's own picture";
}

TEST(Mirrored, LeavesAllElseAsItIs) {
  Mirrored source(std::make_unique<Strip>());
  EXPECT_TRUE(source.has_depth());
  EXPECT_TRUE(source.live());
  EXPECT_EQ(source.frame_count(), 2u);
  EXPECT_EQ(source.dropped(), 7u);
  EXPECT_THAT(source.notes(), testing::ElementsAre("a strip", testing::HasSubstr("turned back")));
  source.next();
  const auto torn = source.next();
  ASSERT_TRUE(torn);
  EXPECT_FALSE(torn->valid);
  EXPECT_EQ(torn->fault, "torn");
  EXPECT_EQ(torn->index, 1u);
  EXPECT_DOUBLE_EQ(torn->time_s, 0.1);
  EXPECT_TRUE(torn->colour.empty());
  EXPECT_FALSE(source.next());
}

}  // namespace
}  // namespace hyperex::capture
