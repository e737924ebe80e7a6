// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <chrono>
#include <string>

namespace hyperex {

/// A progress bar on standard error. On a terminal it redraws one line; elsewhere it prints one
/// line when it starts lasting (1 s) and one at the end. Nothing at all for short work. One bar at
/// a time: work within or beside other work that has its bar standing shows none until that is
/// done.
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
  void draw(long done, bool last);
  std::string label_;
  long total_;
  bool standing_ = false, shown_ = false, lasted_ = false;
  std::chrono::steady_clock::time_point start_, last_draw_;
};

}  // namespace hyperex
