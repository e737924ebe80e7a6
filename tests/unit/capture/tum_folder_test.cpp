// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/tum_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "hyperex/capture/tum_writer.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "recording.hpp"
#include "support/sanitizers.hpp"

namespace hyperex::capture {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;
using namespace test;

class TumFolderTest : public testing::Test {
 protected:
  TumFolderTest() { write_recording(folder_.path(), 12); }

  std::vector<Frame> read(const SourceOptions& options = {}) const {
    return read_all(*open_tum_folder(folder_.path(), options));
  }
  /// All frames are valid but `faulty`, whose fault holds `why`.
  static void expect_one_fault(const std::vector<Frame>& frames, std::size_t faulty,
                               const std::string& why) {
    for (const Frame& frame : frames) {
      EXPECT_EQ(frame.valid, frame.index != faulty) << frame.index << ": " << frame.fault;
      EXPECT_EQ(frame.valid, frame.fault.empty());
      if (!frame.valid) {
        EXPECT_THAT(frame.fault, HasSubstr(why));
      }
      if (frame.valid) {
        EXPECT_FALSE(frame.colour.empty());
        EXPECT_FALSE(frame.depth_m.empty());
      }
    }
  }

  Folder folder_;
};

TEST_F(TumFolderTest, GivesEveryFrameAsWritten) {
  const auto source = open_tum_folder(folder_.path());
  EXPECT_TRUE(source->has_depth());
  EXPECT_FALSE(source->live());
  EXPECT_EQ(source->frame_count(), 12u);
  EXPECT_THAT(source->notes(), testing::IsEmpty());
  const Intrinsics& k = source->intrinsics();
  EXPECT_EQ(k.width_px, 64);
  EXPECT_EQ(k.height_px, 48);
  EXPECT_EQ(k.fx_px, 60);
  EXPECT_EQ(k.fy_px, 61);
  EXPECT_EQ(k.cx_px, 31.5);
  EXPECT_EQ(k.cy_px, 23.5);
  const auto frames = read_all(*source);
  ASSERT_EQ(frames.size(), 12u);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Frame& frame = frames[i];
    EXPECT_TRUE(frame.valid) << frame.fault;
    EXPECT_EQ(frame.index, i);
    EXPECT_NEAR(frame.time_s, 0.1 * static_cast<double>(i), 1e-9);
    ASSERT_EQ(frame.colour.type(), CV_8UC3);
    const cv::Mat written = colour_picture(static_cast<int>(i));
    EXPECT_LT(cv::norm(frame.colour, written, cv::NORM_L1) / (3 * 64 * 48), 2);
    ASSERT_EQ(frame.depth_m.type(), CV_32FC1);
    EXPECT_EQ(frame.depth_m.at<float>(0, 5), 0);
    EXPECT_FLOAT_EQ(frame.depth_m.at<float>(7, 20), 1.02f + 0.01f * static_cast<float>(i));
  }
  EXPECT_FALSE(source->next());
}

TEST_F(TumFolderTest, ReadsTheSameWithAndWithoutReadingAhead) {
  for (const std::size_t ahead : {0, 1, 100}) {
    const auto frames = read({.read_ahead_frames = ahead});
    ASSERT_EQ(frames.size(), 12u);
    for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_EQ(frames[i].index, i);
  }
}

TEST_F(TumFolderTest, LeavesTheDepthOut) {
  fs::remove_all(folder_ / "depth");
  const auto source = open_tum_folder(folder_.path(), {.colour_only = true});
  EXPECT_FALSE(source->has_depth());
  const auto frames = read_all(*source);
  ASSERT_EQ(frames.size(), 12u);
  for (const Frame& frame : frames) {
    EXPECT_TRUE(frame.valid);
    EXPECT_TRUE(frame.depth_m.empty());
  }
}

TEST_F(TumFolderTest, ColourAloneIsNotedWhereThereIsNoDepth) {
  fs::remove(folder_ / "associations.txt");
  fs::remove(folder_ / "depth.txt");
  const auto source = open_tum_folder(folder_.path());
  EXPECT_FALSE(source->has_depth());
  EXPECT_THAT(source->notes(), testing::ElementsAre(HasSubstr("colour only")));
  EXPECT_EQ(read_all(*source).size(), 12u);
}

TEST_F(TumFolderTest, PairsByNearestTimeWithoutAssociations) {
  fs::remove(folder_ / "associations.txt");
  std::string depth;
  for (int i = 0; i < 12; ++i)  // late by up to 11 ms; the sixth too late
    depth += std::to_string(0.1 * i + (i == 5 ? 0.03 : 0.001 * i)) + " depth/" + std::to_string(i) +
             ".png\n";
  write_text(folder_ / "depth.txt", depth);
  const auto source = open_tum_folder(folder_.path());
  EXPECT_THAT(source->notes(), testing::ElementsAre(HasSubstr("paired by nearest time")));
  const auto frames = read_all(*source);
  ASSERT_EQ(frames.size(), 12u);
  expect_one_fault(frames, 5, "no depth picture within 20 ms");
  EXPECT_FALSE(frames[5].colour.empty());
  EXPECT_FLOAT_EQ(frames[9].depth_m.at<float>(7, 0), 1.09f);
}

TEST_F(TumFolderTest, AssociationsMayNameDepthFirst) {
  std::string pairs;
  for (int i = 0; i < 12; ++i) {
    const std::string n = std::to_string(i);
    pairs += n + ".5 depth/" + n + ".png " + n + ".25 rgb/" + n + ".jpg\n";
  }
  write_text(folder_ / "associations.txt", pairs);
  const auto frames = read();
  expect_one_fault(frames, 99, "");
  EXPECT_EQ(frames[3].time_s, 3.25);
}

TEST_F(TumFolderTest, ATornPictureCostsOneFrame) {
  for (const double share : {0.0, 0.02, 0.5, 0.98}) {
    write_recording(folder_.path(), 12);
    tear(folder_ / "rgb/4.jpg", share);
    expect_one_fault(read(), 4, "rgb/4.jpg: ");
  }
  for (const double share : {0.0, 0.05, 0.5, 0.98}) {
    write_recording(folder_.path(), 12);
    tear(folder_ / "depth/4.png", share);
    const auto frames = read();
    expect_one_fault(frames, 4, "depth/4.png: ");
    EXPECT_FALSE(frames[4].colour.empty()) << "what could be read is handed out";
  }
}

TEST_F(TumFolderTest, DamageInsideAPictureIsSeen) {
  for (const char* name : {"rgb/4.jpg", "depth/4.png"}) {
    write_recording(folder_.path(), 12);
    std::string bytes = read_file(folder_ / name);
    for (std::size_t i = bytes.size() * 7 / 10; i < bytes.size() * 7 / 10 + 20; ++i) bytes[i] = 0;
    write_text(folder_ / name, bytes);
    expect_one_fault(read(), 4, name);
  }
}

TEST_F(TumFolderTest, AMissingPictureCostsOneFrame) {
  fs::remove(folder_ / "rgb/4.jpg");
  expect_one_fault(read(), 4, "rgb/4.jpg: no such file");
  write_recording(folder_.path(), 12);
  fs::remove(folder_ / "depth/11.png");
  expect_one_fault(read(), 11, "depth/11.png: no such file");
}

TEST_F(TumFolderTest, AMissingPairLeavesAFaultyFrame) {
  std::string pairs = read_file(folder_ / "associations.txt");
  const auto line = pairs.find("0.4 rgb/4.jpg");
  pairs.erase(line, pairs.find('\n', line) + 1 - line);
  write_text(folder_ / "associations.txt", pairs);
  const auto frames = read();
  ASSERT_EQ(frames.size(), 12u);
  expect_one_fault(frames, 4, "rgb/4.jpg: no pair in associations.txt");
  EXPECT_NEAR(frames[4].time_s, 0.4, 1e-9);
}

TEST_F(TumFolderTest, AssociationsMayCutTheRecording) {
  write_text(folder_ / "associations.txt",
             "0.1 rgb/1.jpg 0.1 depth/1.png\n0.2 rgb/2.jpg 0.2 depth/2.png\n");
  const auto frames = read();
  ASSERT_EQ(frames.size(), 2u);
  expect_one_fault(frames, 99, "");
}

TEST_F(TumFolderTest, TimeGoingBackCostsTheFramesOutOfOrder) {
  for (const char* wrong :
       {"-5", "7e9", "0.15"}) {  // before the start, far ahead, and between others
    write_recording(folder_.path(), 12);
    std::string pairs = read_file(folder_ / "associations.txt");
    pairs.replace(pairs.find("0.4 rgb"), 3, wrong);
    write_text(folder_ / "associations.txt", pairs);
    expect_one_fault(read(), 4, "is out of order (time must rise)");
  }
}

TEST_F(TumFolderTest, OneOfTwoEqualTimesIsFaulty) {
  std::string pairs = read_file(folder_ / "associations.txt");
  pairs.replace(pairs.find("0.4 rgb"), 3, "0.3");
  write_text(folder_ / "associations.txt", pairs);
  const auto frames = read();
  EXPECT_NE(frames[3].valid, frames[4].valid);
}

TEST_F(TumFolderTest, AWrongSizeCostsOneFrame) {
  cv::imwrite((folder_ / "rgb/4.jpg").string(), colour_picture(4, 32, 24));
  expect_one_fault(read(), 4, "rgb/4.jpg: 32 x 24 pixels, but the camera has 64 x 48");
  write_recording(folder_.path(), 12);
  cv::imwrite((folder_ / "depth/4.png").string(), depth_picture_mm(4, 48, 64));
  expect_one_fault(read(), 4, "depth/4.png: 48 x 64 pixels, but the camera has 64 x 48");
}

TEST_F(TumFolderTest, AWrongSizeIsToldByTheHeaderAlone) {
  // 16,384 x 16,384 pixels, of which none follows: decoding would say that it is torn.
  write_text(folder_ / "rgb/3.jpg", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x40\0\0\0\x40\0"
                                                "\x08\x02\0\0\0",
                                                29));
  expect_one_fault(read(), 3, "16384 x 16384 pixels, but the camera has 64 x 48");
}

TEST_F(TumFolderTest, PipesAndFilesOfOtherFoldersCostOneFrame) {
  const Folder elsewhere;
  fs::copy_file(folder_ / "rgb/3.jpg", elsewhere / "secret.jpg");
  const fs::path picture = folder_ / "rgb/3.jpg";
  fs::remove(picture);
  ASSERT_EQ(::mkfifo(picture.c_str(), 0600), 0);
  expect_one_fault(read(), 3, "is a pipe or device");
  fs::remove(picture);
  fs::create_symlink(elsewhere / "secret.jpg", picture);
  expect_one_fault(read(), 3, "lies outside of the folder");
}

TEST_F(TumFolderTest, ListsAndCamerasThatArePipesAreRefused) {
  for (const char* name : {"associations.txt", "camera.toml"}) {
    const std::string text = read_file(folder_ / name);
    fs::remove(folder_ / name);
    ASSERT_EQ(::mkfifo((folder_ / name).c_str(), 0600), 0);
    EXPECT_THAT(refusal([&] { read(); }), HasSubstr("is a pipe"));
    fs::remove(folder_ / name);
    write_text(folder_ / name, text);
  }
}

TEST_F(TumFolderTest, DepthWithoutReadingOrOfAnotherKindCostsOneFrame) {
  cv::imwrite((folder_ / "depth/4.png").string(), cv::Mat::zeros(48, 64, CV_16UC1));
  expect_one_fault(read(), 4, "depth without a single reading");
  cv::imwrite((folder_ / "depth/4.png").string(), cv::Mat::ones(48, 64, CV_8UC1));
  expect_one_fault(read(), 4, "16-bit picture of one channel");
}

TEST_F(TumFolderTest, GoesOnWithATenthButNotWithLess) {
  write_recording(folder_.path(), 20);
  for (int i = 2; i < 20; ++i) fs::remove(folder_ / ("rgb/" + std::to_string(i) + ".jpg"));
  EXPECT_EQ(read().size(), 20u);
  fs::remove(folder_ / "rgb/1.jpg");
  const std::string error = refusal([&] { read(); });
  EXPECT_THAT(error, HasSubstr("19 of 20 frames cannot be used"));
  EXPECT_THAT(error, HasSubstr("rgb/1.jpg: no such file"));
  EXPECT_THAT(error, testing::Not(HasSubstr("\n")));
}

TEST_F(TumFolderTest, RefusesListsThatAreNone) {
  const auto error_with = [&](const std::string& name, const std::string& text) {
    write_recording(folder_.path(), 3);
    write_text(folder_ / name, text);
    return refusal([&] { read(); });
  };
  EXPECT_THAT(error_with("associations.txt", "# a\n0.1 rgb/1.jpg 0.1\n"),
              HasSubstr("associations.txt:2: "));
  EXPECT_THAT(error_with("associations.txt", "x rgb/1.jpg 0.1 depth/1.png\n"),
              HasSubstr("expected TIME COLOUR TIME DEPTH"));
  EXPECT_THAT(error_with("rgb.txt", "0.1 rgb/1.jpg\nnan rgb/2.jpg\n"), HasSubstr("rgb.txt:2: "));
  EXPECT_THAT(error_with("associations.txt", "# nothing\n"), HasSubstr("name no picture"));
}

TEST_F(TumFolderTest, RefusesAFolderThatIsNone) {
  EXPECT_THAT(refusal([&] { open_tum_folder(folder_ / "not_here"); }), HasSubstr("no such folder"));
  fs::remove(folder_ / "associations.txt");
  fs::remove(folder_ / "rgb.txt");
  EXPECT_THAT(refusal([&] { read(); }), HasSubstr("neither rgb.txt nor associations.txt"));
  write_recording(folder_.path(), 3);
  fs::remove(folder_ / "camera.toml");
  EXPECT_THAT(refusal([&] { read(); }), HasSubstr("camera.toml: missing"));
}

TEST_F(TumFolderTest, AFolderOfRecordingsNamesTheChoice) {
  Folder parent;
  const auto opened = [&] { open_tum_folder(parent.path()); };
  EXPECT_THAT(refusal(opened), testing::EndsWith("(docs/tracking.md)"));
  const auto add = [&](const std::string& name) {
    fs::create_directory(parent.path() / name);
    write_recording(parent.path() / name, 1);
  };
  add("talk");
  EXPECT_THAT(refusal(opened),
              testing::EndsWith("; it holds one: " + (parent.path() / "talk").string()));
  add("smile");
  add("open");
  EXPECT_THAT(refusal(opened),
              testing::EndsWith("; it holds 3 recordings, name one of them: open, smile or talk"));
  for (const char* name : {"a", "b", "c"}) add(name);
  EXPECT_THAT(
      refusal(opened),
      testing::EndsWith("; it holds 6 recordings, name one of them: a, b, c, open, smile ..."));
}

TEST_F(TumFolderTest, ACameraFileOfTheUsersGoesFirst) {
  fs::rename(folder_ / "camera.toml", folder_ / "other.toml");
  const auto source = open_tum_folder(folder_.path(), {.camera_file = folder_ / "other.toml"});
  EXPECT_EQ(source->intrinsics().fy_px, 61);
}

TEST(RecordedSubject, IsReadFasterThanItWasTaken) {
  const fs::path folder = fs::path(HYPEREX_SHARED_DIR) / "data/rgbd/subject_A_still";
  if (!fs::exists(folder)) GTEST_SKIP() << "no recording at " << folder;
  const auto source = open_tum_folder(folder);
  const auto start = std::chrono::steady_clock::now();
  const auto frames = read_all(*source);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ASSERT_EQ(frames.size(), 40u);
  for (const Frame& frame : frames) EXPECT_TRUE(frame.valid) << frame.fault;
  EXPECT_NEAR(frames.back().time_s, 1.3, 1e-6);
  std::printf("%.1f ms a frame\n", 1000 * seconds / 40);
#if !HYPEREX_SANITIZED
  EXPECT_LT(seconds, 1.3);
#endif
}

TEST(TumWriter, WritesWhatIsReadBack) {
  const Folder folder;
  const Intrinsics camera{300, 300, 31.5, 23.5, 64, 48};
  Frame frame;
  frame.time_s = 1.25;
  frame.colour = cv::Mat(48, 64, CV_8UC3, cv::Scalar(40, 90, 200));
  frame.depth_m = cv::Mat::zeros(48, 64, CV_32F);
  for (int x = 10; x < 60; ++x) frame.depth_m.at<float>(20, x) = 0.5F + 0.00117F * float(x);
  TumWriter writer(folder.path() / "made", camera);
  writer.add(frame);
  frame.colour.release();
  EXPECT_THROW(writer.add(frame), std::invalid_argument);
  writer.finish();
  const auto source = open_tum_folder(folder.path() / "made", {.read_ahead_frames = 0});
  EXPECT_EQ(source->intrinsics().fx_px, camera.fx_px);
  EXPECT_EQ(source->intrinsics().cy_px, camera.cy_px);
  const auto read = source->next();
  ASSERT_TRUE(read && read->valid) << (read ? read->fault : "no frame");
  EXPECT_DOUBLE_EQ(read->time_s, 1.25);
  const auto colour = read->colour.at<cv::Vec3b>(20, 30);
  EXPECT_NEAR(colour[0], 40, 3);
  EXPECT_NEAR(colour[1], 90, 3);
  EXPECT_NEAR(colour[2], 200, 3);
  EXPECT_LT(cv::norm(read->depth_m, frame.depth_m, cv::NORM_INF), 0.6 / 5000) << "0.1 mm";
  EXPECT_FALSE(source->next());
}

}  // namespace
}  // namespace hyperex::capture
