// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "hyperex/study/child.hpp"
#include "hyperex/study/plan_cases.hpp"

namespace hyperex::study {

/// How a case ended.
struct Outcome {
  State state = State::not_run;  ///< not_run: interrupted; running: another process is running it
  double seconds = 0;
  std::string message = {};  ///< of a failed one
};

struct RunOptions {
  std::filesystem::path program;                           ///< hyperex
  int jobs = 1;                                            ///< processes at once
  std::function<void(std::size_t, const Outcome&)> ended;  ///< called when a case has ended
  std::function<void(std::size_t)> waiting;                ///< often, with how many have ended
  std::function<bool()> stop;                              ///< returns whether to end all cases now
};

/// The number of processors available to this process, but at most one per GiB of free memory. Each
/// run gets one processor, since a run on several is only a little faster.
int default_jobs();

/// The command `hyperex run` with a case's scene, as the sweep runs it; a user may run it too.
Command command_of(const Study& study, const Case& one, const CaseFiles& files,
                   const std::filesystem::path& program);

/// Runs these cases, each in its own process with its share of the processors. If a case fails, the
/// others go on. Where `stop` returns true, the processes are ended and waited for. Throws
/// InputError where a log cannot be written; the processes still running are ended first.
void run_cases(const Study& study, const std::vector<PlannedCase>& planned,
               const std::vector<std::size_t>& cases, const RunOptions& options);

}  // namespace hyperex::study
