// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/video_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "hyperex/capture/video.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "recording.hpp"
#include "support/video.hpp"

namespace hyperex::capture {
namespace {
namespace fs = std::filesystem;
using namespace test;

std::size_t files_in(const Folder& folder) {
  return std::size_t(
      std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()));
}

cv::Mat grey(int level) {
  return cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(level));
}

TEST(VideoWriter, WritesH264ThatComesBackPictureForPicture) {
  SKIP_WITHOUT_VIDEO();
  const Folder folder;
  const fs::path file = folder / "film.mp4";
  VideoWriter writer(file, 64, 48, 25);
  for (int i = 0; i < 10; ++i) writer.add(grey(20 * i + 20));
  EXPECT_FALSE(fs::exists(file)) << "under its name before it is whole";
  writer.finish();
  EXPECT_EQ(files_in(folder), 1u);
  EXPECT_THAT(read_file(file), testing::HasSubstr("avc1"));
  const auto source = open_video(file, {});
  const auto frames = read_all(*source);
  ASSERT_EQ(frames.size(), 10u);
  for (int i = 0; i < 10; ++i) {
    EXPECT_NEAR(frames[i].time_s, 0.04 * i, 1e-4);
    EXPECT_NEAR(cv::mean(frames[i].colour)[1], 20 * i + 20, 4);
  }
}

TEST(VideoWriter, LeavesNothingWhereItIsNotFinished) {
  SKIP_WITHOUT_VIDEO();
  const Folder folder;
  {
    VideoWriter writer(folder / "film.mp4", 64, 48, 25);
    writer.add(grey(100));
  }
  EXPECT_EQ(files_in(folder), 0u);
}

TEST(VideoWriter, RefusesOtherNamesPlacesAndPictures) {
  SKIP_WITHOUT_VIDEO();
  const Folder folder;
  EXPECT_THROW(VideoWriter(folder / "film.avi", 64, 48, 25), InputError);
  EXPECT_THROW(VideoWriter("/nowhere/film.mp4", 64, 48, 25), InputError);
  EXPECT_THROW(VideoWriter(folder / "film.mp4", 63, 48, 25), std::invalid_argument);
  EXPECT_THROW(VideoWriter(folder / "film.mp4", 64, 48, 0), std::invalid_argument);
  VideoWriter writer(folder / "film.mp4", 64, 48, 25);
  EXPECT_THROW(writer.add(cv::Mat(48, 62, CV_8UC3)), std::invalid_argument);
}

}  // namespace
}  // namespace hyperex::capture
