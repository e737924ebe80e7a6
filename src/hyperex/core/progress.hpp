// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace hyperex {

/// A progress bar on standard error. On a terminal it redraws one line, whose seconds go on where
/// the work cannot report; elsewhere it prints a line when it starts lasting (1 s), others after 2,
/// 4, 8 ... seconds, at least one a minute, also where the work cannot report, and one at the end.
/// Nothing at all for short work. One bar at a time: work within or beside other work that has its
/// bar standing shows none until that is done.
class Progress {
 public:
  /// `total` steps of work; 0 where the length is not known beforehand.
  Progress(std::string label, long total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// `done` steps are finished. Cheap: may be called on every step.
  void update(long done);
  double seconds() const;
  /// No bars at all, which is how every program begins: one that wants them says false.
  static void silence(bool silent);

 private:
  void draw(bool last);
  /// In a thread of its own until the end.
  void tell_now_and_then();
  std::string label_;
  long total_;
  bool standing_ = false, shown_ = false, lasted_ = false;
  std::chrono::steady_clock::time_point start_, last_draw_;
  long done_ = 0;
  bool over_ = false;
  std::mutex mutex_;  // of all that changes
  std::condition_variable ended_;
  std::thread teller_;
};

}  // namespace hyperex
