// SPDX-License-Identifier: GPL-3.0-or-later
// The library that reads videos is loaded only when a video is opened.
#include <gmock/gmock.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "apps/program.hpp"
#include "support/video.hpp"

namespace hyperex {
namespace {
using testing::HasSubstr;
namespace fs = std::filesystem;

class VideoLibrary : public ProgramTest {
 protected:
  /// What a shell command prints on both its outputs.
  std::string printed(const std::string& command) const {
    const std::string file = in("printed.txt");
    [[maybe_unused]] const int status = std::system((command + " >" + file + " 2>&1").c_str());
    return read_file(file);
  }
};

TEST_F(VideoLibrary, TheProgramStartsWithoutIt) {
  const std::string libraries = printed("ldd " HYPEREX_PROGRAM);
  EXPECT_THAT(libraries, HasSubstr("libopencv_core"));
  for (const char* heavy : {"libopencv_videoio", "libopencv_imgcodecs", "libavcodec", "libgdal"})
    EXPECT_THAT(libraries, testing::Not(HasSubstr(heavy)));
  EXPECT_LT(std::count(libraries.begin(), libraries.end(), '\n'), 80);
}

TEST_F(VideoLibrary, IsSoughtBesideTheProgramAndMissedInWords) {
  SKIP_WITHOUT_VIDEO();
  std::ofstream(in("film.avi")) << "no film";
  const Outcome outcome = call("track film.avi --out m.csv");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("film.avi: no video that can be read"));
  fs::create_directories(in("elsewhere/bin"));
  fs::create_directories(in("elsewhere/lib/hyperex"));
  const std::string program = in("elsewhere/bin/hyperex");
  const fs::path library = in("elsewhere/lib/hyperex/hx_video.so");
  fs::copy_file(HYPEREX_PROGRAM, program);
  const std::string command = program + " track " + in("film.avi").string() + " --out m.csv";
  const std::string missing = printed(command);
  EXPECT_THAT(missing, HasSubstr("elsewhere/lib/hyperex/hx_video.so: missing"));
  EXPECT_THAT(missing, HasSubstr("install libopencv-videoio-dev"));
  // The error comes before the recording is tracked.
  cv::imwrite(in("grey.png").string(), cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(90)));
  EXPECT_THAT(printed(program + " track " + in("grey.png").string() + " --preview p.mp4"),
              HasSubstr("install libopencv-videoio-dev"));
  std::ofstream(library) << "not a library";
  EXPECT_THAT(printed(command), HasSubstr("hx_video.so: cannot be loaded"));
  fs::remove(library);
  fs::copy_file(fs::path(HYPEREX_PROGRAM).parent_path() / "../lib/hyperex/hx_video.so", library);
  EXPECT_THAT(printed(command), HasSubstr("film.avi: no video that can be read"));
}

}  // namespace
}  // namespace hyperex
