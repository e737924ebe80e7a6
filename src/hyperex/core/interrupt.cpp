// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/interrupt.hpp"

#include <cxxabi.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <typeinfo>
#include <vector>

namespace hyperex {
namespace fs = std::filesystem;
namespace {

// Never destroyed: the waiting thread outlives main().
std::mutex& mutex() {
  static auto* m = new std::mutex;
  return *m;
}
std::vector<fs::path>& list() {
  static auto* paths = new std::vector<fs::path>;
  return *paths;
}

int wake[2] = {-1, -1};  // a pipe: a handler may write to it, and hardly anything else
std::atomic<bool> interrupted{false};

constexpr std::size_t kReserve = 1 << 20;
constexpr unsigned char kNoMemory = 0;  // in the place of a signal's number
std::terminate_handler usual_end = nullptr;
std::atomic<bool> ending{false};

enum class Request { not_awaited, awaited, made };
std::atomic<Request> request{Request::not_awaited};
std::atomic<int> request_signal{0};
static_assert(std::atomic<Request>::is_always_lock_free);  // a handler uses it

extern "C" void on_signal(int signal) {
  Request awaited = Request::awaited;
  if (request == awaited) request_signal = signal;
  if (request.compare_exchange_strong(awaited, Request::made)) return;
  const int kept = errno;
  interrupted = true;
  const auto byte = static_cast<unsigned char>(signal);
  [[maybe_unused]] const auto written = ::write(wake[1], &byte, 1);
  errno = kept;
}

void remove_all_on_list() {
  for (const fs::path& path : list()) {
    // Under another name first: nothing can be put into it any more while it is emptied.
    std::error_code error;
    fs::path going = path;
    going += ".going";
    fs::rename(path, going, error);
    if (error) fs::remove_all(path, error);
    fs::remove_all(going, error);  // also where an earlier try renamed it and went no further
  }
}

/// Where memory is short, again after a while: what other threads give up comes back.
void remove_with_patience() {
  constexpr int kTries = 50;
  constexpr unsigned kPause_us = 20000;
  for (int i = 0; i < kTries; ++i) {
    try {
      return remove_all_on_list();
    } catch (const std::bad_alloc&) {
      ::usleep(kPause_us);
    }
  }
}

/// A library that gives up by exit() leaves nothing behind either.
void remove_at_exit() {
  const std::unique_lock lock(mutex(), std::try_to_lock);
  if (lock) remove_all_on_list();
}

void wait_for_signal() {
  // Removing unfinished files takes some memory: reserved here, in case it has run out.
  auto reserve = std::make_unique<std::array<char, kReserve>>();
  reserve->fill(1);  // by pages that this thread has
  unsigned char signal = 0;
  ssize_t got = 0;
  do got = ::read(wake[0], &signal, 1);
  while (got < 0 && errno == EINTR);
  if (got != 1) return;
  reserve.reset();
  const auto lock = hold_off_interruption();
  const bool unfinished = !list().empty();
  remove_with_patience();
  if (signal == kNoMemory) ::_exit(1);
  // The line may contain a progress bar.
  const std::string line = std::string(::isatty(2) ? "\n" : "") + "hyperex: interrupted" +
                           (unfinished ? "; what was half written is removed\n" : "\n");
  [[maybe_unused]] const auto written = ::write(2, line.data(), line.size());
  ::_exit(128 + signal);
}

bool memory_ran_out() {
  const std::type_info* const thrown = abi::__cxa_current_exception_type();
  return thrown &&
         (*thrown == typeid(std::bad_alloc) || *thrown == typeid(std::bad_array_new_length));
}

/// An exception that nothing can catch, as one that leaves a destructor. Takes no memory itself:
/// the waiting thread has some.
[[noreturn]] void on_terminate() {
  if (!memory_ran_out() && usual_end) usual_end();
  constexpr unsigned kLongest_s = 5;  // that thread may wait for a lock which this one holds
  if (!ending.exchange(true)) {
    constexpr std::string_view line = "hyperex: there is not enough memory for this\n";
    [[maybe_unused]] const auto written = ::write(2, line.data(), line.size());
    interrupted = true;
    if (wake[1] < 0 || ::write(wake[1], &kNoMemory, 1) != 1) ::_exit(1);
  }
  ::sleep(kLongest_s);
  ::_exit(1);
}

}  // namespace

TemporaryPath::TemporaryPath(fs::path path) : path_(fs::absolute(path)) {
  const auto lock = hold_off_interruption();
  list().push_back(path_);
}

TemporaryPath::~TemporaryPath() {
  const auto lock = hold_off_interruption();
  const auto found = std::find(list().begin(), list().end(), path_);
  if (found != list().end()) list().erase(found);
}

std::unique_lock<std::mutex> hold_off_interruption() {
  return std::unique_lock(mutex());
}

void end_cleanly_when_interrupted() {
  std::atexit(remove_at_exit);
  if (::pipe(wake) != 0) return;  // signals then end the program as usual
  std::thread(wait_for_signal).detach();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU}) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    ::sigaction(signal, &action, nullptr);
  }
}

void end_cleanly_without_memory() {
  usual_end = std::set_terminate(on_terminate);
}

StopOnRequest::StopOnRequest() {
  request = Request::awaited;
}
StopOnRequest::~StopOnRequest() {
  request = Request::not_awaited;
}
bool StopOnRequest::requested() const {
  return request == Request::made;
}

int StopOnRequest::signal() const {
  return request_signal;
}

void wait_if_interrupted() {
  while (interrupted) ::pause();
}

}  // namespace hyperex
