// SPDX-License-Identifier: GPL-3.0-or-later
// The outputs of `hyperex track`, and its question about left and right.
#include <gmock/gmock.h>

#include <fstream>

#include "apps/program.hpp"
#include "hyperex/capture/video_writer.hpp"
#include "support/video.hpp"

namespace hyperex {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;
const fs::path recording = fs::path(HYPEREX_SHARED_DIR) / "data/rgbd/subject_A_still";

class TrackOutputs : public ProgramTest {
 protected:
  void expect_refused(const std::string& arguments, const std::string& words) const {
    const Outcome outcome = call(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr(words)) << arguments;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_TRUE(fs::is_empty(in(""))) << arguments;
  }
};

TEST_F(TrackOutputs, AWebcamsMirrorMustBeSaid) {
  expect_refused("track webcam:3 --out m.csv", "Say --mirrored yes or --mirrored no");
  expect_refused("track --device webcam:3 --out m.csv", "Say --mirrored yes or --mirrored no");
  // If it is stated, the camera is opened.
  expect_refused("track webcam:251 --mirrored yes --out m.csv", "there is no /dev/video251");
}

TEST_F(TrackOutputs, AVideosMirrorIsTakenAsNone) {
  SKIP_WITHOUT_VIDEO();
  capture::VideoWriter video(in("v.mp4"), 64, 48, 25);  // without a face
  for (int frame = 0; frame < 3; ++frame) video.add(cv::Mat(48, 64, CV_8UC3, cv::Scalar(90)));
  video.finish();
  const Outcome unsaid = call("track v.mp4 --out m.csv");
  EXPECT_THAT(unsaid.err, HasSubstr("v.mp4: assumed not mirrored"));
  std::ofstream(in("torn.mp4")) << "no video";
  EXPECT_THAT(call("track torn.mp4 --out m.csv").err, Not(HasSubstr("mirrored")));
  for (const char* said : {"yes", "no"})
    EXPECT_THAT(call(std::string("track v.mp4 --out m.csv --mirrored ") + said).err,
                Not(HasSubstr("mirrored")));
  EXPECT_EQ(call("track v.mp4 --out m.csv --mirrored perhaps").status, 2);
}

TEST_F(TrackOutputs, APreviewsNameIsLookedAtFirst) {
  SKIP_WITHOUT_VIDEO();
  if (!fs::exists(recording)) GTEST_SKIP() << "no " << recording;
  expect_refused("track '" + recording.string() + "' --preview p.avi",
                 "p.avi: expected the name of a video that ends in .mp4");
}

TEST_F(TrackOutputs, WritesEveryFileThatIsAskedFor) {
  SKIP_WITHOUT_VIDEO();
  if (!fs::exists(recording)) GTEST_SKIP() << "no " << recording;
  const Outcome outcome = call("track '" + recording.string() +
                               "' --out m.csv --trc m.trc --preview p.mp4 --glb f.glb");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* file : {"m.csv", "m.trc", "p.mp4", "f.glb"}) {
    EXPECT_THAT(outcome.out, HasSubstr(std::string("written: ") + file));
    EXPECT_GT(fs::file_size(in(file)), 1000u) << file;
  }
  EXPECT_THAT(read_file(in("m.pose.csv")),
              AllOf(HasSubstr("time_s,valid,T00"), HasSubstr(",metric,frame,fault\n")));
  EXPECT_THAT(read_file(in("m.units.csv")), HasSubstr("time_s,valid,jawOpen [AU26+AU27]"));
  EXPECT_EQ(std::distance(fs::directory_iterator(in("")), fs::directory_iterator()), 7)
      << "and nothing else is left";
}

}  // namespace
}  // namespace hyperex
