// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/study/case_files.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>

#include "hyperex/core/files.hpp"
#include "hyperex/core/printable.hpp"
#include "hyperex/io/number.hpp"

namespace hyperex::study {
namespace fs = std::filesystem;
namespace {

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
         c == '.';
}

/// Whether a process holds the log, which is locked as long as its run lives. The test takes a
/// shared lock, so that two simultaneous tests do not mistake each other for a run.
bool is_locked(const fs::path& log) {
  const int file = ::open(log.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return false;
  const bool locked = ::flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(file);
  return locked;
}

std::string text_of(const fs::path& log) {
  std::error_code error;
  return fs::is_regular_file(fs::symlink_status(log, error)) ? read_file(log) : "";
}

}  // namespace

CaseFiles files_of_case(const fs::path& out, const std::string& name, const std::string& hash) {
  constexpr std::size_t longest = 60, digits = 10;
  std::string plain = name.substr(0, longest);
  for (char& c : plain)
    if (!is_plain(c)) c = '_';
  // A leading '.' would hide the file; a leading '-' would look like an option.
  if (!plain.empty() && (plain[0] == '.' || plain[0] == '-')) plain[0] = '_';
  plain += "-" + hash.substr(0, digits);
  return {out / "cases" / plain, out / "logs" / (plain + ".log")};
}

const char* to_string(State state) {
  switch (state) {
    case State::not_run:
      return "not run";
    case State::running:
      return "running";
    case State::failed:
      return "failed";
    case State::finished:
      break;
  }
  return "finished";
}

State state_of(const CaseFiles& files) {
  std::error_code error;
  if (fs::is_regular_file(files.folder / "summary.json", error)) return State::finished;
  if (is_locked(files.log)) return State::running;
  return text_of(files.log).find(std::string("\n") + kLogFailed) == std::string::npos
             ? State::not_run
             : State::failed;
}

std::string failure_of(const fs::path& log) {
  const std::string text = text_of(log);
  const std::string_view said = "hyperex: ";
  std::string message, end;
  io::Lines lines(text);
  std::string_view line;
  while (lines.next(line)) {
    if (line.starts_with(said))
      message += (message.empty() ? "" : "; ") + std::string(line.substr(said.size()));
    if (line.starts_with(kLogFailed)) end = line.substr(std::string_view(kLogFailed).size());
  }
  return printable(message.empty() ? end : message);
}

}  // namespace hyperex::study
