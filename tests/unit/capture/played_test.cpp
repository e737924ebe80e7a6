// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/played.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "hyperex/capture/open_source.hpp"
#include "hyperex/core/files.hpp"
#include "recording.hpp"

namespace hyperex::capture {
namespace {
using namespace std::chrono_literals;
using namespace test;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class PlayedTest : public testing::Test {
 protected:
  void SetUp() override { write_recording(folder_.path(), 10); }  // at 10 Hz
  std::unique_ptr<FrameSource> played() { return open_device("play:" + folder_.path().string()); }
  Folder folder_;
};

TEST_F(PlayedTest, ComesAtItsOwnPace) {
  const auto source = played();
  EXPECT_TRUE(source->live());
  EXPECT_TRUE(source->has_depth());
  EXPECT_EQ(source->frame_count(), 10u);
  std::optional<Clock::time_point> start;
  std::size_t frames = 0;
  while (const auto frame = source->next()) {
    if (!start) start = frame->arrived;
    const double waited_s = std::chrono::duration<double>(frame->arrived - *start).count();
    // Never before its time; the 0.02 s are what the first one itself came late.
    EXPECT_GT(waited_s, frame->time_s - 0.02) << frame->index;
    EXPECT_NEAR(frame->time_s, 0.1 * double(frame->index), 1e-9);
    ++frames;
  }
  EXPECT_EQ(frames + source->dropped(), 10u);
  EXPECT_GT(seconds_since(*start), 0.88);
}

TEST_F(PlayedTest, ASlowConsumerLosesFramesAndNoTime) {
  const auto source = played();
  std::size_t frames = 0, gaps = 0, expected = 0;
  double first_age_s = 0;
  while (const auto frame = source->next()) {
    gaps += frame->index - expected;
    expected = frame->index + 1;
    const double age_s = seconds_since(frame->arrived);
    if (frames == 0) first_age_s = age_s;
    EXPECT_LT(age_s, first_age_s + 0.2) << frame->index;  // one period, and a busy machine's
    ++frames;
    std::this_thread::sleep_for(250ms);
  }
  EXPECT_EQ(expected, 10u) << "the newest is never dropped";
  EXPECT_EQ(gaps, source->dropped()) << "numbers show what is missing";
  EXPECT_EQ(frames + gaps, 10u);
  EXPECT_GE(gaps, 4u);
}

TEST_F(PlayedTest, AFaultyFrameHoldsNothingUp) {
  std::string pairs = read_file(folder_ / "associations.txt");
  pairs.replace(pairs.find("0.4 rgb"), 3, "7e9");
  write_text(folder_ / "associations.txt", pairs);
  const auto start = Clock::now();
  const auto source = played();
  const auto frames = read_all(*source);
  EXPECT_LT(seconds_since(start), 5);
  EXPECT_EQ(frames.size() + source->dropped(), 10u);
}

TEST(OpenDevice, RefusesWhatIsNone) {
  const Folder folder;
  write_recording(folder.path(), 2);
  EXPECT_THAT(refusal([&] { open_device(folder.path().string()); }),
              testing::HasSubstr("no such device; expected kinect, openni"));
  EXPECT_THAT(refusal([] { open_device("play:kinect"); }),
              testing::HasSubstr("expected a recording"));
  EXPECT_THAT(refusal([] { open_device("play:"); }), testing::HasSubstr("expected a recording"));
}

}  // namespace
}  // namespace hyperex::capture
