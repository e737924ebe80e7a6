// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace hyperex {

/// A progress bar on standard error. On a terminal it redraws one line; elsewhere it prints a line
/// after 1 s, others after 2, 4, 8, 16 s and then every 10 s, and one at the end. The seconds go on
/// even where the work does not report. Short work shows nothing. One bar at a time: work within or
/// beside other work whose bar is shown has none until that is done.
class Progress {
 public:
  /// `total` steps of work; 0: unknown.
  Progress(std::string label, long total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// `done` steps are finished. Cheap: may be called on every step.
  void update(long done);
  double seconds() const;
  /// Where there is no terminal: the time from the line at `since_start` to the next.
  static std::chrono::seconds wait_after(std::chrono::seconds since_start);
  /// Shows no bars where `silent`, which is the default of every program.
  static void silence(bool silent);

 private:
  void draw(bool last);
  /// Runs in a thread of its own until the end.
  void redraw_periodically();
  std::string label_;
  long total_;
  bool active_ = false, shown_ = false, lasted_ = false;
  std::chrono::steady_clock::time_point start_, last_draw_;
  long done_ = 0;
  bool over_ = false;
  std::mutex mutex_;  // of all that changes
  std::condition_variable ended_;
  std::thread redrawer_;
};

}  // namespace hyperex
