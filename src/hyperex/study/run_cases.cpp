// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/study/run_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <thread>

#include "hyperex/core/stopwatch.hpp"

namespace hyperex::study {
namespace fs = std::filesystem;
namespace {

struct Running {
  std::size_t index;
  Child child;
  Stopwatch since = {};
};

/// The processors of one process; empty (all processors) where there are more jobs than processors.
std::vector<int> share_of(std::size_t slot, int jobs) {
  const std::vector<int> all = own_processors();
  const std::size_t each = all.size() / std::size_t(jobs);
  if (each == 0) return {};
  const auto begin = all.begin() + std::ptrdiff_t(slot * each);
  return {begin, begin + std::ptrdiff_t(each)};
}

std::string words_of(int status) {
  if (status > 128 && status < 128 + 65)
    return fmt::format("ended by signal {} ({})", status - 128, ::strsignal(status - 128));
  return status == 127 ? "the program could not be started" : fmt::format("exit status {}", status);
}

/// The running cases, at most one per slot.
class Pool {
 public:
  Pool(const Study& study, const std::vector<PlannedCase>& planned, const RunOptions& options)
      : study_(study), planned_(planned), options_(options), slots_(std::size_t(options.jobs)) {}

  bool start(std::size_t index) {
    for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
      if (slots_[slot]) continue;
      const CaseFiles& files = planned_[index].files;
      Command command = command_of(study_, study_.cases[index], files, options_.program);
      command.processors = share_of(slot, options_.jobs);
      auto child = Child::start(command, files.log);
      if (child)
        slots_[slot].emplace(Running{index, std::move(*child)});
      else
        report(index, {State::running});
      return true;
    }
    return false;
  }

  void gather() {
    for (auto& slot : slots_) {
      if (!slot) continue;
      const auto status = slot->child.ended();
      if (!status) continue;
      const Outcome outcome = outcome_of(*slot, *status);
      const std::size_t index = slot->index;
      slot.reset();  // releases the lock of its log
      report(index, outcome);
    }
  }

  void end_all() {
    for (auto& slot : slots_)
      if (slot) slot->child.end();
  }
  bool empty() const {
    return std::none_of(slots_.begin(), slots_.end(),
                        [](const auto& slot) { return slot.has_value(); });
  }
  std::size_t done() const { return done_; }

 private:
  Outcome outcome_of(Running& running, int status) const {
    const CaseFiles& files = planned_[running.index].files;
    const double seconds = running.since.lap();
    std::error_code error;
    if (fs::is_regular_file(files.folder / "summary.json", error)) {
      running.child.say(fmt::format("hyperex sweep: finished in {:.1f} s", seconds));
      return {State::finished, seconds};
    }
    // Ctrl-C ends the child directly, since the terminal sends it to all of its processes.
    if (status != 0 && options_.stop && options_.stop()) {
      running.child.say("hyperex sweep: interrupted");
      return {State::not_run, seconds};
    }
    running.child.say(kLogFailed + words_of(status));
    return {State::failed, seconds, failure_of(files.log)};
  }

  void report(std::size_t index, const Outcome& outcome) {
    ++done_;
    if (options_.ended) options_.ended(index, outcome);
  }

  const Study& study_;
  const std::vector<PlannedCase>& planned_;
  const RunOptions& options_;
  std::vector<std::optional<Running>> slots_;
  std::size_t done_ = 0;
};

double free_memory_gib() {
  std::ifstream stream("/proc/meminfo");
  std::string name, unit;
  double kib = 0;
  while (stream >> name >> kib >> unit)
    if (name == "MemAvailable:") return kib / (1 << 20);
  return 1;
}

}  // namespace

int default_jobs() {
  const auto processors = std::max<std::size_t>(1, own_processors().size());
  return std::max(1, std::min(int(processors), int(free_memory_gib())));
}

Command command_of(const Study& study, const Case& one, const CaseFiles& files,
                   const fs::path& program) {
  // Relative paths in overrides are relative to the working directory of the program.
  Command command{{program.string(), "run", fs::absolute(study.scene).lexically_normal().string(),
                   "--out", fs::absolute(files.folder).lexically_normal().string()},
                  fs::absolute(study.file).lexically_normal().parent_path()};
  for (const scene::Override& given : one.overrides) {
    command.words.push_back("--set");
    command.words.push_back(given.text);
  }
  return command;
}

void run_cases(const Study& study, const std::vector<PlannedCase>& planned,
               const std::vector<std::size_t>& cases, const RunOptions& options) {
  Pool pool(study, planned, options);
  std::size_t next = 0;
  bool stopped = false;
  while (next < cases.size() || !pool.empty()) {
    if (!stopped && options.stop && options.stop()) {
      stopped = true;
      next = cases.size();
      pool.end_all();
    }
    pool.gather();
    while (next < cases.size() && pool.start(cases[next])) ++next;
    if (options.waiting) options.waiting(pool.done());
    if (!pool.empty()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace hyperex::study
