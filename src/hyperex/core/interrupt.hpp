// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// An interrupted run leaves no unfinished files: they are kept in one list, and a thread that waits
// for the signal removes them and ends the program. Long calls into libraries need not poll a flag.
#include <filesystem>
#include <mutex>

namespace hyperex {

/// A file or folder under a temporary name, removed when the program is interrupted; the destructor
/// only removes it from the list.
class TemporaryPath {
 public:
  explicit TemporaryPath(std::filesystem::path path);
  ~TemporaryPath();
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// While this is held an interruption waits: for renames that belong together.
std::unique_lock<std::mutex> hold_off_interruption();

/// From now on SIGINT, SIGTERM, SIGHUP, SIGQUIT and SIGXCPU (each unless it is ignored, as under
/// nohup) remove the files on the list, report that in one line on standard error and end the
/// program with the status 128 + signal. Files on the list when a library calls exit() are removed
/// as well. Call once, from main().
void end_cleanly_when_interrupted();

/// From now on an allocation that fails where nothing can catch it (in a destructor, before main()
/// catches) removes the files on the list, reports that in one line on standard error and ends the
/// program with the status 1. Call once, from main().
void end_cleanly_without_memory();

/// While an object of this class lives, the first of these signals only requests an end: the
/// program goes on and writes what it has. The second signal ends it as above. One object at a
/// time.
class StopOnRequest {
 public:
  StopOnRequest();
  ~StopOnRequest();
  StopOnRequest(const StopOnRequest&) = delete;
  StopOnRequest& operator=(const StopOnRequest&) = delete;
  bool requested() const;
  int signal() const;  ///< the signal received, if any
};

/// Does not return while an interruption is under way: a failure caused by the removal of files is
/// not to be reported.
void wait_if_interrupted();

}  // namespace hyperex
