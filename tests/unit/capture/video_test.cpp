// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/video.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/videoio.hpp>

#include "hyperex/capture/open_source.hpp"
#include "recording.hpp"

namespace hyperex::capture {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;
using namespace test;

/// At 25 Hz.
fs::path write_video(const Folder& folder, int frames = 12) {
  const fs::path file = folder / "film.avi";
  cv::VideoWriter writer(file.string(), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25, {64, 48});
  for (int i = 0; i < frames; ++i) writer.write(colour_picture(i));
  return file;
}

TEST(Video, GivesEveryFrameWithItsTime) {
  const Folder folder;
  const auto source = open_source(write_video(folder).string());
  EXPECT_FALSE(source->has_depth());
  EXPECT_FALSE(source->live());
  EXPECT_EQ(source->frame_count(), 12u);
  const auto frames = read_all(*source);
  ASSERT_EQ(frames.size(), 12u);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_TRUE(frames[i].valid) << frames[i].fault;
    EXPECT_EQ(frames[i].index, i);
    EXPECT_NEAR(frames[i].time_s, 0.04 * static_cast<double>(i), 1e-6);
    ASSERT_EQ(frames[i].colour.type(), CV_8UC3);
    const cv::Mat written = colour_picture(static_cast<int>(i));
    EXPECT_LT(cv::norm(frames[i].colour, written, cv::NORM_L1) / (3 * 64 * 48), 6);
    EXPECT_TRUE(frames[i].depth_m.empty());
  }
}

TEST(Video, GuessesTheCameraFromAnAngleAndSaysSo) {
  const Folder folder;
  const fs::path file = write_video(folder);
  const auto source = open_video(file, {.field_of_view_deg = 90});
  EXPECT_NEAR(source->intrinsics().fx_px, 32, 1e-9);
  EXPECT_THAT(source->notes(), testing::ElementsAre(HasSubstr("90 degrees")));
}

TEST(Video, TakesTheUsersCameraWhereItFits) {
  const Folder folder;
  const fs::path file = write_video(folder);
  const std::string k = "fx = 70\nfy = 71\ncx = 31\ncy = 23\n";
  write_text(folder / "fits.toml", "width = 64\nheight = 48\n" + k);
  write_text(folder / "large.toml", "width = 640\nheight = 480\n" + k);
  const auto source = open_video(file, {.camera_file = folder / "fits.toml"});
  EXPECT_EQ(source->intrinsics().fy_px, 71);
  EXPECT_THAT(source->notes(), testing::IsEmpty());
  EXPECT_THAT(refusal([&] { open_video(file, {.camera_file = folder / "large.toml"}); }),
              HasSubstr("describes pictures of 640 x 480, but those of"));
}

TEST(Video, ATornFileIsReadAsFarAsItGoes) {
  const Folder folder;
  const fs::path file = write_video(folder, 60);
  tear(file, 0.6);
  std::vector<std::string> notes;
  std::vector<Frame> frames;
  const std::string error = refusal([&] {
    const auto source = open_video(file);
    frames = read_all(*source);
    notes = source->notes();
  });
  EXPECT_EQ(error, "");
  EXPECT_GT(frames.size(), 10u);
  EXPECT_LT(frames.size(), 60u);
  EXPECT_THAT(notes, testing::Contains(HasSubstr("ends after")));
}

TEST(Video, RefusesWhatIsNone) {
  const Folder folder;
  EXPECT_THAT(refusal([&] { open_video(folder / "none.mp4"); }), HasSubstr("no such file"));
  write_text(folder / "text.mp4", "not a video");
  EXPECT_THAT(refusal([&] { open_video(folder / "text.mp4"); }), HasSubstr("no video"));
  write_text(folder / "empty.avi", "");
  EXPECT_THAT(refusal([&] { open_video(folder / "empty.avi"); }), HasSubstr("no video"));
}

TEST(OpenSource, NamesWhatCanBeOpened) {
  const std::string error = refusal([] { open_source("kinnect"); });
  EXPECT_THAT(error, HasSubstr("kinnect: "));
  for (const char* word : {"folder", "video", ".oni", "kinect", "openni", "webcam:N"})
    EXPECT_THAT(error, HasSubstr(word));
  EXPECT_THAT(refusal([] { open_source(""); }), HasSubstr("expected a recording"));
}

TEST(OpenSource, WebcamsGoByNumber) {
  EXPECT_THAT(refusal([] { open_source("webcam:255"); }), HasSubstr("no /dev/video255"));
  EXPECT_THAT(refusal([] { open_source("webcam:x"); }), HasSubstr("webcam:N"));
  EXPECT_THAT(refusal([] { open_source("webcam:-1"); }), HasSubstr("webcam:N"));
}

TEST(OpenSource, OpensAFolder) {
  const Folder folder;
  write_recording(folder.path(), 3);
  EXPECT_EQ(open_source(folder.path().string())->frame_count(), 3u);
}

}  // namespace
}  // namespace hyperex::capture
