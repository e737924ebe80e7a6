// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/study/child.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/file.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include "hyperex/core/error.hpp"
#include "hyperex/study/case_files.hpp"

namespace hyperex::study {
namespace fs = std::filesystem;
namespace {

/// Locks the log. Tries several times, since a query of the case's state holds the lock for a
/// moment. True also where the file system has no locks (some network folders).
bool lock(int file) {
  for (int tries = 0; tries < 10; ++tries) {
    if (::flock(file, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

bool is_own_log(int file) {
  struct stat status {};
  if (::fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) return false;
  if (status.st_size == 0) return true;
  char begin[2] = {};
  return ::pread(file, begin, 2, 0) == 2 && std::memcmp(begin, kLogBegins, 2) == 0;
}

void write_all(int file, const std::string& text) {
  std::size_t sent = 0;
  while (sent < text.size()) {
    const ssize_t some = ::write(file, text.data() + sent, text.size() - sent);
    if (some < 0 && errno == EINTR) continue;
    if (some <= 0) return;  // the case goes on even if its log cannot be written
    sent += std::size_t(some);
  }
}

/// Runs in the new process, where only system calls are safe. All signals stay blocked until this
/// program's signal handlers have been removed; they would swallow a signal that arrived earlier.
[[noreturn]] void become(const Command& command, char* const* words, const cpu_set_t* processors,
                         int log, pid_t parent, const sigset_t* unblocked) {
  for (int signal = 1; signal < NSIG; ++signal) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = SIG_DFL;
    ::sigaction(signal, &action, nullptr);
  }
  ::sigprocmask(SIG_SETMASK, unblocked, nullptr);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(128 + SIGTERM);
  if (processors) ::sched_setaffinity(0, sizeof *processors, processors);
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, 0);
  ::dup2(log, 1);
  ::dup2(log, 2);
  if (::chdir(command.folder.c_str()) == 0) ::execv(words[0], words);
  ::_exit(127);
}

}  // namespace

std::string quoted_for_shell(const std::string& word) {
  const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./=:,+";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

std::string shell_line(const Command& command) {
  std::string line = "cd " + quoted_for_shell(command.folder.string()) + " &&";
  for (const std::string& word : command.words) line += " " + quoted_for_shell(word);
  return line;
}

std::vector<int> own_processors() {
  std::vector<int> all;
  cpu_set_t set;
  if (::sched_getaffinity(0, sizeof set, &set) == 0)
    for (int processor = 0; processor < CPU_SETSIZE; ++processor)
      if (CPU_ISSET(processor, &set)) all.push_back(processor);
  return all;
}

std::optional<Child> Child::start(const Command& command, const fs::path& log) {
  const auto fail = [&](const std::string& why) { return InputError(log, why); };
  const int file =
      ::open(log.c_str(), O_RDWR | O_CREAT | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
  if (file < 0) throw fail("cannot be written (" + std::string(std::strerror(errno)) + ")");
  Child child(-1, file);
  if (!is_own_log(file)) throw fail("is no log of a case; expected another folder for the study");
  if (!lock(file)) return std::nullopt;
  if (::ftruncate(file, 0) != 0)
    throw fail("cannot be written (" + std::string(std::strerror(errno)) + ")");
  write_all(file, kLogBegins + shell_line(command) + "\n");
  std::vector<char*> words;
  for (const std::string& word : command.words) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  cpu_set_t processors;
  CPU_ZERO(&processors);
  for (const int processor : command.processors) CPU_SET(processor, &processors);
  const pid_t parent = ::getpid();
  sigset_t all, before;
  sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  child.process_ = ::fork();
  if (child.process_ == 0)
    become(command, words.data(), command.processors.empty() ? nullptr : &processors, file, parent,
           &before);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (child.process_ < 0)
    throw fail("its process cannot be made (" + std::string(std::strerror(errno)) + ")");
  return child;
}

Child::Child(Child&& other) noexcept
    : process_(other.process_), log_(other.log_), status_(other.status_) {
  other.process_ = other.log_ = -1;
}

Child& Child::operator=(Child&& other) noexcept {
  std::swap(process_, other.process_);
  std::swap(log_, other.log_);
  std::swap(status_, other.status_);
  return *this;
}

Child::~Child() {
  if (process_ > 0) {
    end();
    ::waitpid(process_, nullptr, 0);
  }
  if (log_ >= 0) ::close(log_);
}

std::optional<int> Child::ended() {
  if (process_ < 0) return status_;
  int status = 0;
  const pid_t got = ::waitpid(process_, &status, WNOHANG);
  if (got == 0 || (got < 0 && errno == EINTR)) return std::nullopt;
  status_ = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  process_ = -1;
  return status_;
}

void Child::end() {
  if (process_ > 0) ::kill(process_, SIGTERM);
}

void Child::say(const std::string& line) const {
  write_all(log_, line + "\n");
}

}  // namespace hyperex::study
