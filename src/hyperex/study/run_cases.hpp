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
  State state = State::not_run;  ///< not_run: interrupted; running: another process runs it
  double seconds = 0;
  std::string message = {};  ///< of a failed one
};

struct RunOptions {
  std::filesystem::path program;                           ///< hyperex
  int jobs = 1;                                            ///< processes at once
  std::function<void(std::size_t, const Outcome&)> ended;  ///< a case, as soon as it has ended
  std::function<void(std::size_t)> waiting;                ///< often, with how many have ended
  std::function<bool()> stop;                              ///< whether to end all now
};

/// The processors available to this process, at most one per GiB of free memory.
/// A run on one processor takes little longer than on several.
int default_jobs();

/// `hyperex run` with a case's scene, as the sweep calls it and a user may.
Command command_of(const Study& study, const Case& one, const CaseFiles& files,
                   const std::filesystem::path& program);

/// Runs these cases, each in a process of its own with its share of the processors; one that fails
/// stops no other. Where `stop` says so, the processes are ended and waited for. Throws InputError
/// where a log cannot be written, after the processes that run then were ended.
void run_cases(const Study& study, const std::vector<PlannedCase>& planned,
               const std::vector<std::size_t>& cases, const RunOptions& options);

}  // namespace hyperex::study
