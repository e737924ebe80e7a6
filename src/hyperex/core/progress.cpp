// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <system_error>

namespace hyperex {
namespace {
std::atomic<bool> silenced{true};  // a library in other programs
std::atomic<bool> taken{false};    // a bar is shown
using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point t) {
  return std::chrono::duration<double>(Clock::now() - t).count();
}
}  // namespace

void Progress::silence(bool silent) {
  silenced = silent;
}

Progress::Progress(std::string label, long total)
    : label_(std::move(label)), total_(total), start_(Clock::now()), last_draw_(start_) {
  if (silenced) return;
  // On a terminal the label is shown at once: some work is one long call that cannot report.
  if (::isatty(2)) draw(false);
  try {
    redrawer_ = std::thread([this] { redraw_periodically(); });
  } catch (const std::system_error&) {  // little memory: drawn where the work reports
  }
}

Progress::~Progress() {
  if (redrawer_.joinable()) {
    {
      const std::lock_guard lock(mutex_);
      over_ = true;
    }
    ended_.notify_one();
    redrawer_.join();
  }
  // Also of one long call that cannot report.
  if (shown_ || lasted_ || (!silenced && seconds() >= 1)) draw(true);
  if (active_) taken = false;
}

std::chrono::seconds Progress::wait_after(std::chrono::seconds since_start) {
  using std::chrono::seconds;
  return std::clamp(since_start, seconds(2), seconds(10));
}

void Progress::redraw_periodically() {
  using std::chrono::seconds;
  constexpr seconds lately{1};
  std::unique_lock lock(mutex_);
  if (::isatty(2)) {
    while (!ended_.wait_for(lock, lately, [this] { return over_; }))
      if (Clock::now() - last_draw_ >= lately) draw(false);
    return;
  }
  for (seconds at = wait_after({}); !ended_.wait_until(lock, start_ + at, [this] { return over_; });
       at += wait_after(at))
    if (!shown_ || Clock::now() - last_draw_ >= lately) draw(false);
}

double Progress::seconds() const {
  return seconds_since(start_);
}

void Progress::update(long done) {
  if (silenced) return;
  const std::lock_guard lock(mutex_);
  done_ = done;
  const bool terminal = ::isatty(2);
  if (seconds_since(last_draw_) < (terminal ? 0.1 : 1.0)) return;
  if (!terminal && shown_) return;
  lasted_ = true;
  if (!terminal && total_ > 0 && done >= total_) return;  // the line at the end says it
  draw(false);
}

void Progress::draw(bool last) {
  if (silenced) return;
  if (!active_ && taken.exchange(true)) return;
  active_ = shown_ = true;
  last_draw_ = Clock::now();
  constexpr int width = 30;
  const double share = last         ? 1.0
                       : total_ > 0 ? std::clamp(double(done_) / double(total_), 0., 1.)
                                    : 0.;
  const int filled = int(share * width);
  const std::string bar = std::string(filled, '#') + std::string(width - filled, '.');
  if (::isatty(2)) {
    std::fputs(fmt::format("\r{:<28} [{}] {:3.0f} % {:6.1f} s{}", label_, bar, 100 * share,
                           seconds(), last ? "\n" : "")
                   .c_str(),
               stderr);
  } else {
    const std::string part = last || total_ > 0 ? fmt::format("{:3.0f} %", 100 * share) : "  ...";
    std::fputs(fmt::format("{:<28} {} {:6.1f} s\n", label_, part, seconds()).c_str(), stderr);
  }
  std::fflush(stderr);
}

}  // namespace hyperex
