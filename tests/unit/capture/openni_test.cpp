// SPDX-License-Identifier: GPL-3.0-or-later
// OpenNI2 with a driver of our own (made_up_driver.cpp), and with its player of recordings.
#include "hyperex/capture/openni.hpp"

#include <OpenNI.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <thread>

#include "hyperex/capture/open_source.hpp"
#include "recording.hpp"

namespace hyperex::capture {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;
using namespace test;

void must(openni::Status status) {
  if (status != openni::STATUS_OK) throw std::runtime_error(openni::OpenNI::getExtendedError());
}

void record_here(const fs::path& file) {
  must(openni::OpenNI::initialize());
  {
    openni::Device device;
    must(device.open("made-up"));
    must(device.setImageRegistrationMode(openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR));
    openni::VideoStream colour, depth;
    must(colour.create(device, openni::SENSOR_COLOR));
    must(depth.create(device, openni::SENSOR_DEPTH));
    openni::Recorder recorder;
    must(recorder.create(file.c_str()));
    must(recorder.attach(colour));
    must(recorder.attach(depth));
    must(recorder.start());
    must(colour.start());
    must(depth.start());
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
    recorder.stop();
    recorder.destroy();
    colour.stop();
    depth.stop();
    colour.destroy();
    depth.destroy();
    device.close();
  }
  openni::OpenNI::shutdown();
}

/// Records the made-up device with OpenNI2's own recorder, mirrored by default. This runs in a
/// process of its own, since OpenNI2 would later access the recorder's ended thread and crash.
void record(const fs::path& file) {
  const pid_t child = fork();
  if (child == 0) {
    try {
      record_here(file);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
      _exit(1);
    }
    _exit(0);
  }
  int status = -1;
  if (child < 0 || waitpid(child, &status, 0) != child || status != 0)
    throw std::runtime_error("the made-up device cannot be recorded");
}

/// Checks that a frame is the driver's frame `made`, not mirrored, and registered.
void expect_frame(const Frame& frame, int made) {
  EXPECT_TRUE(frame.valid) << frame.fault;
  ASSERT_EQ(frame.colour.type(), CV_8UC3);
  ASSERT_EQ(frame.colour.size(), cv::Size(64, 48));
  EXPECT_EQ(frame.colour.at<cv::Vec3b>(7, 20), cv::Vec3b(static_cast<uchar>(10 * made), 7, 20));
  ASSERT_EQ(frame.depth_m.type(), CV_32FC1);
  EXPECT_NEAR(frame.depth_m.at<float>(7, 20), 1.02 + 0.01 * made, 1e-6);
}

TEST(OpenniDevice, GivesRegisteredDepthUnmirrored) {
  const auto source = open_openni("made-up");
  EXPECT_TRUE(source->live());
  EXPECT_TRUE(source->has_depth());
  EXPECT_EQ(source->intrinsics().width_px, 64);
  EXPECT_NEAR(source->intrinsics().fx_px, 32 / std::tan(0.5), 1e-4)
      << "1 rad, as the driver states";
  std::size_t seen = 0;
  for (; seen < 8; ++seen) {
    const auto frame = source->next();
    ASSERT_TRUE(frame);
    const int made = static_cast<int>(std::lround(frame->colour.at<cv::Vec3b>(0, 0)[0] / 10.0));
    expect_frame(*frame, made);
  }
}

TEST(OpenniDevice, OpensByNameAndFindsTheOnlyOne) {
  const auto source = open_source("openni");
  EXPECT_TRUE(source->live());
  EXPECT_TRUE(source->next());
  EXPECT_THAT(refusal([] { open_source("openni:not-here"); }), HasSubstr("openni:not-here: "));
}

TEST(OniFile, GivesEveryFrameAsRecorded) {
  const Folder folder;
  // On a busy machine OpenNI2's recorder starts late or drops frames: that file is no measure.
  for (int attempt = 0; attempt < 5; ++attempt) {
    fs::remove(folder / "a.oni");
    record(folder / "a.oni");
    if (read_all(*open_oni(folder / "a.oni", {.read_ahead_frames = 0})).size() == 16) break;
  }
  for (const std::size_t ahead : {0, 4}) {
    const auto source = open_oni(folder / "a.oni", {.read_ahead_frames = ahead});
    EXPECT_FALSE(source->live());
    EXPECT_TRUE(source->has_depth());
    EXPECT_NEAR(source->intrinsics().fx_px, 32 / std::tan(0.5), 1e-4);
    EXPECT_THAT(source->notes(), testing::Contains(HasSubstr("registered")));
    const auto frames = read_all(*source);
    ASSERT_EQ(frames.size(), 16u);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      EXPECT_EQ(frames[i].index, i);
      EXPECT_NEAR(frames[i].time_s, 0.02 * static_cast<double>(i), 1e-9);
      expect_frame(frames[i], static_cast<int>(i));
    }
    EXPECT_FALSE(source->next());
  }
}

TEST(OniFile, ColourAloneAndTheUsersCamera) {
  const Folder folder;
  record(folder / "a.ONI");
  write_text(folder / "camera.toml",
             "width = 64\nheight = 48\nfx = 70\nfy = 70\ncx = 31\ncy = 23\n");
  const auto source = open_source((folder / "a.ONI").string(),
                                  {.colour_only = true, .camera_file = folder / "camera.toml"});
  EXPECT_FALSE(source->has_depth());
  EXPECT_EQ(source->intrinsics().fx_px, 70);
  const auto frames = read_all(*source);
  ASSERT_EQ(frames.size(), 16u);
  for (const Frame& frame : frames) EXPECT_TRUE(frame.valid && frame.depth_m.empty());
}

TEST(OniFile, RefusesWhatIsNone) {
  const Folder folder;
  EXPECT_THAT(refusal([&] { open_oni(folder / "none.oni"); }), HasSubstr("no such file"));
  write_text(folder / "text.oni", "not a recording");
  const std::string error = refusal([&] { open_oni(folder / "text.oni"); });
  EXPECT_THAT(error, HasSubstr("text.oni: "));
  EXPECT_THAT(error, testing::Not(HasSubstr("\n")));
}

TEST(OniFile, ATornRecordingIsReadAsFarAsItGoesOrRefused) {
  const Folder folder;
  record(folder / "a.oni");
  for (const double share : {0.3, 0.1, 0.01}) {
    fs::copy_file(folder / "a.oni", folder / "torn.oni", fs::copy_options::overwrite_existing);
    tear(folder / "torn.oni", share);
    std::vector<Frame> frames;
    std::vector<std::string> notes;
    const std::string error = refusal([&] {
      const auto source = open_oni(folder / "torn.oni");
      frames = read_all(*source);
      notes = source->notes();
    });
    if (error.empty()) {
      EXPECT_LT(frames.size(), 16u);
      EXPECT_THAT(notes, testing::Contains(HasSubstr("no frame within")));
      for (std::size_t i = 0; i < frames.size(); ++i) expect_frame(frames[i], static_cast<int>(i));
    } else {
      EXPECT_THAT(error, HasSubstr("torn.oni: "));
    }
    EXPECT_TRUE(error.empty() || frames.empty());
  }
}

}  // namespace
}  // namespace hyperex::capture
