// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/buffered.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>

#include "recording.hpp"

namespace hyperex::capture {
namespace {
using namespace std::chrono_literals;
using test::read_all;

/// Frame i arrives i periods after the first call, as from a camera; all its colours are i.
class Clockwork : public FrameSource {
 public:
  Clockwork(std::size_t frames, std::chrono::milliseconds period,
            std::atomic<std::size_t>* read = nullptr)
      : frames_(frames), period_(period), read_(read) {}
  const Intrinsics& intrinsics() const override { return intrinsics_; }
  bool has_depth() const override { return true; }
  bool live() const override { return true; }
  std::optional<std::size_t> frame_count() const override { return frames_; }
  std::vector<std::string> notes() const override {
    return next_ == frames_ ? std::vector<std::string>{"ended"} : std::vector<std::string>{"begun"};
  }
  std::optional<Frame> next() override {
    if (next_ == 0) start_ = std::chrono::steady_clock::now();
    if (next_ == throws_at) throw std::runtime_error("unplugged");
    if (next_ == frames_) return std::nullopt;
    std::this_thread::sleep_until(start_ + next_ * period_);
    Frame frame;
    frame.index = next_++;
    frame.time_s = std::chrono::duration<double>(frame.index * period_).count();
    if (read_ != nullptr) ++*read_;
    return frame;
  }
  std::size_t throws_at = 1u << 30;

 private:
  std::size_t frames_, next_ = 0;
  std::chrono::milliseconds period_;
  std::chrono::steady_clock::time_point start_;
  std::atomic<std::size_t>* read_;
  Intrinsics intrinsics_{1, 2, 3, 4, 5, 6};
};

TEST(LatestFrame, ASlowConsumerSeesFreshFramesAndEveryDroppedOneIsCounted) {
  constexpr auto period = 10ms;
  constexpr std::size_t frames = 60;
  const auto start = std::chrono::steady_clock::now();
  LatestFrame live(std::make_unique<Clockwork>(frames, period));
  std::size_t seen = 0;
  std::ptrdiff_t last = -1;
  while (const auto frame = live.next()) {
    EXPECT_GT(static_cast<std::ptrdiff_t>(frame->index), last);
    last = static_cast<std::ptrdiff_t>(frame->index);
    const double age_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() -
        frame->time_s;
    // One period, and what a busy machine adds. Falling behind would come to 1.5 s at the end.
    EXPECT_LT(age_s, 0.15) << "frame " << frame->index;
    ++seen;
    std::this_thread::sleep_for(35ms);
  }
  EXPECT_EQ(last, static_cast<std::ptrdiff_t>(frames) - 1) << "the newest is never dropped";
  EXPECT_EQ(seen + live.dropped(), frames);
  EXPECT_GT(live.dropped(), frames / 2);
}

TEST(LatestFrame, AFastConsumerSeesEveryFrame) {
  LatestFrame live(std::make_unique<Clockwork>(15, 20ms));
  EXPECT_EQ(read_all(live).size() + live.dropped(), 15u);
  EXPECT_LE(live.dropped(), 1u);  // the machine may be busy for 20 ms
}

TEST(ReadAhead, LosesNothingAndReadsNoFurtherThanAsked) {
  std::atomic<std::size_t> read = 0;
  const auto source = read_ahead(std::make_unique<Clockwork>(50, 0ms, &read), 4);
  std::size_t index = 0;
  while (const auto frame = source->next()) {
    EXPECT_EQ(frame->index, index++);
    if (index == 5) {
      std::this_thread::sleep_for(50ms);
      EXPECT_EQ(read, 5u + 4u + 1u) << "four wait, and the worker holds one";
    }
  }
  EXPECT_EQ(index, 50u);
  EXPECT_EQ(source->dropped(), 0u);
}

TEST(ReadAhead, PassesOnWhatTheSourceSays) {
  const auto source = read_ahead(std::make_unique<Clockwork>(3, 0ms), 4);
  EXPECT_EQ(source->intrinsics().height_px, 6);
  EXPECT_TRUE(source->has_depth());
  EXPECT_TRUE(source->live());
  EXPECT_EQ(source->frame_count(), 3u);
  read_all(*source);
  EXPECT_EQ(source->notes(), std::vector<std::string>{"ended"});
  EXPECT_FALSE(source->next()) << "the end stays the end";
}

TEST(ReadAhead, AnErrorComesBehindTheFramesBeforeIt) {
  auto clockwork = std::make_unique<Clockwork>(9, 0ms);
  clockwork->throws_at = 6;
  const auto source = read_ahead(std::move(clockwork), 20);
  for (std::size_t i = 0; i < 6; ++i) ASSERT_TRUE(source->next());
  EXPECT_THROW(source->next(), std::runtime_error);
}

TEST(ReadAhead, MayBeLeftHalfRead) {
  const auto start = std::chrono::steady_clock::now();
  {
    const auto source = read_ahead(std::make_unique<Clockwork>(100000, 1ms), 2);
    source->next();
    LatestFrame live(std::make_unique<Clockwork>(100000, 1ms));
    live.next();
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, 2s);
}

}  // namespace
}  // namespace hyperex::capture
