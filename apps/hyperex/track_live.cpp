// SPDX-License-Identifier: GPL-3.0-or-later
#include "track_live.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "hyperex/core/interrupt.hpp"
#include "hyperex/core/quantile.hpp"

namespace hyperex::cli {
namespace {

/// One line that is overwritten again and again; shown on a terminal only.
class StatusLine {
 public:
  StatusLine() : terminal_(::isatty(2) != 0) {}
  ~StatusLine() {
    if (shown_) std::fputs("\n", stderr);
  }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  void show(const tracking::LiveStatus& s, int neutral_frames) {
    constexpr auto pause = std::chrono::milliseconds(200);
    const auto now = std::chrono::steady_clock::now();
    if (!terminal_ || (shown_ && now < last_ + pause)) return;
    shown_ = true;
    last_ = now;
    const std::string text =
        s.held_back > 0
            ? fmt::format("learning the face, please hold it at rest: {} of {} frames", s.held_back,
                          neutral_frames)
            : fmt::format("{:5.1f} frames/s, delay {:3.0f} ms, {} dropped, {} of {} valid",
                          s.frames_a_second, 1e3 * s.delay_s, s.dropped, s.valid, s.frames);
    std::fputs(fmt::format("\r{:<70} (Ctrl-C ends)", text).c_str(), stderr);
    std::fflush(stderr);
  }

 private:
  bool terminal_, shown_ = false;
  std::chrono::steady_clock::time_point last_;
};

void tell_outcome(const tracking::LiveTracking& live) {
  const auto& s = live.status;
  const std::size_t seen = s.frames + s.dropped;
  spdlog::info(
      "live: {} frames tracked in {:.1f} s, {} dropped ({:.0f} %; {} of them while the person's "
      "shape was learnt)",
      s.frames, s.seconds, s.dropped,
      100.0 * double(s.dropped) / double(std::max<std::size_t>(seen, 1)), s.dropped_while_learning);
  if (live.delays_s.empty()) return;
  std::vector<double> delays_s = live.delays_s;
  std::ranges::sort(delays_s);
  spdlog::info(
      "delay from the camera's frame in hand to its result: {:.0f} ms in the median, 95 % within "
      "{:.0f} ms, at most {:.0f} ms; up to {:.0f} ms at first, where frames were held back",
      1e3 * quantile_of_sorted(delays_s, 0.5), 1e3 * quantile_of_sorted(delays_s, 0.95),
      1e3 * delays_s.back(), 1e3 * s.learning_delay_s);
}

}  // namespace

tracking::Tracking track_live(capture::FrameSource& source, const expression::FaceModel& model,
                              const tracking::TrackerOptions& options,
                              std::optional<double> seconds, const tracking::FrameVisitor& visit) {
  const StopOnRequest request;
  tracking::LiveTracking live;
  {
    StatusLine line;
    tracking::LiveOptions how;
    if (seconds) how.seconds = *seconds;
    how.stop = [&] { return request.requested(); };
    how.status = [&](const auto& status) { line.show(status, options.neutral_frames); };
    live = tracking::track_live(source, model, options, how, visit);
  }
  tell_outcome(live);
  return std::move(live.tracking);
}

}  // namespace hyperex::cli
