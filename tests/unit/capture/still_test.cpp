// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/still.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "hyperex/capture/open_source.hpp"
#include "recording.hpp"

namespace hyperex::capture {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;
using namespace test;

TEST(Still, IsOneFrameOfColourAndTheCameraIsGuessed) {
  const Folder folder;
  const cv::Mat picture = colour_picture(3);
  for (const char* name : {"photo.png", "PHOTO.JPG"}) {
    cv::imwrite((folder / name).string(), picture, {cv::IMWRITE_JPEG_QUALITY, 95});
    const auto source = open_source((folder / name).string(), {.field_of_view_deg = 90});
    EXPECT_FALSE(source->has_depth());
    EXPECT_FALSE(source->live());
    EXPECT_EQ(source->frame_count(), 1u);
    EXPECT_EQ(source->intrinsics().width_px, 64);
    EXPECT_NEAR(source->intrinsics().fx_px, 32, 1e-9);
    EXPECT_THAT(source->notes(), testing::ElementsAre(HasSubstr("90 degrees")));
    const auto frames = read_all(*source);
    ASSERT_EQ(frames.size(), 1u);
    EXPECT_TRUE(frames[0].valid);
    EXPECT_EQ(frames[0].time_s, 0);
    EXPECT_TRUE(frames[0].depth_m.empty());
    EXPECT_LT(cv::norm(frames[0].colour, picture, cv::NORM_L1) / (3 * 64 * 48), 3) << name;
  }
}

TEST(Still, TakesTheUsersCameraWhereItFits) {
  const Folder folder;
  const fs::path file = folder / "photo.png";
  cv::imwrite(file.string(), colour_picture(0));
  const std::string k = "fx = 70\nfy = 71\ncx = 31\ncy = 23\n";
  write_text(folder / "fits.toml", "width = 64\nheight = 48\n" + k);
  write_text(folder / "large.toml", "width = 640\nheight = 480\n" + k);
  EXPECT_EQ(open_still(file, {.camera_file = folder / "fits.toml"})->intrinsics().fy_px, 71);
  EXPECT_THAT(
      refusal([&] { open_still(file, {.camera_file = folder / "large.toml"}); }),
      testing::AllOf(HasSubstr("large.toml"), HasSubstr("640 x 480"), HasSubstr("64 x 48")));
}

TEST(Still, TornOrMissingIsSaidInOneLine) {
  const Folder folder;
  for (const char* name : {"photo.png", "photo.jpg"}) {
    const fs::path file = folder / name;
    EXPECT_THAT(refusal([&] { open_still(file); }), HasSubstr(name));
    cv::imwrite(file.string(), colour_picture(0));
    tear(file, 0.5);
    const std::string error = refusal([&] { open_source(file.string()); });
    EXPECT_THAT(error, testing::AllOf(HasSubstr(name), HasSubstr("torn")));
    EXPECT_EQ(error.find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace hyperex::capture
