// SPDX-License-Identifier: GPL-3.0-or-later
// `hyperex track --device`, tested with recordings that are played at their own rate.
#include <fcntl.h>
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

#include "apps/program.hpp"

namespace hyperex {
namespace {
using testing::HasSubstr;
namespace fs = std::filesystem;
const fs::path talk_recording = fs::path(HYPEREX_SHARED_DIR) / "data/rgbd/subject_A_talk";

std::vector<std::vector<std::string>> table(const fs::path& file) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream text(read_file(file));
  for (std::string line; std::getline(text, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

class TrackLive : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    if (!fs::exists(talk_recording)) GTEST_SKIP() << "no " << talk_recording;
  }
};

TEST_F(TrackLive, EndsAfterSomeSecondsAndSaysWhatWasDropped) {
  const Outcome outcome =
      call("track --device play:" + talk_recording.string() + " --seconds 2 --out m.csv");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("live: "), HasSubstr(" dropped")));
  const auto pose = table(in("m.pose.csv"));
  ASSERT_GT(pose.size(), 3u);
  EXPECT_EQ(*(pose[0].end() - 2), "frame");
  EXPECT_EQ(pose[0].back(), "fault");  // empty in the rows, so that it must come last
  EXPECT_EQ(table(in("m.csv")).size(), pose.size());
  double last = -1;
  for (std::size_t i = 1; i < pose.size(); ++i) {
    const double frame = std::stod(pose[i].back()), time_s = std::stod(pose[i][0]);
    EXPECT_GT(frame, last);
    EXPECT_NEAR(time_s, frame / 30, 1e-3) << "a frame keeps its time whatever was dropped";
    EXPECT_LT(time_s, 3) << "ends with the frame that is awaited at 2 s, late on a busy machine";
    last = frame;
  }
}

TEST_F(TrackLive, WhenInterruptedWhatWasTrackedIsWritten) {
  const std::string device = "play:" + talk_recording.string(), out = in("m.csv"),
                    err = in("err.txt");
  const pid_t program = ::fork();
  if (program == 0) {
    const int to = ::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(to, 1);
    ::dup2(to, 2);
    ::execl(HYPEREX_PROGRAM, HYPEREX_PROGRAM, "track", "--device", device.c_str(), "--out",
            out.c_str(), nullptr);
    ::_exit(127);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(2000));
  ::kill(program, SIGINT);
  int status = 0;
  ::waitpid(program, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0) << read_file(err);
  const auto rows = table(out);
  ASSERT_GT(rows.size(), 3u);
  EXPECT_LT(std::stod(rows.back()[0]), 3.0) << "the recording has 4 s";
  EXPECT_TRUE(fs::exists(in("m.pose.csv")));
}

TEST_F(TrackLive, RefusesWhatDoesNotGoTogether) {
  const std::string folder = talk_recording.string();
  for (const auto& [arguments, words] :
       {std::pair{"track " + folder + " --device kinect --out m.csv", "excludes"},
        {"track " + folder + " --seconds 2 --out m.csv", "--seconds is for a camera"},
        {"track --device " + folder + " --out m.csv", "no such device"},
        {"track --device play:gone --out m.csv", "gone"}}) {
    const Outcome outcome = call(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr(words));
    EXPECT_EQ(outcome.out, "");
  }
}

}  // namespace
}  // namespace hyperex
