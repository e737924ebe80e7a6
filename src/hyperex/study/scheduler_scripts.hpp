// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Scripts that run a study on a cluster with an existing scheduler. Each case is run by `hyperex
// sweep STUDY --case N`, and the table is written by `hyperex sweep STUDY --collect`.
#include <string>
#include <vector>

#include "hyperex/study/plan_cases.hpp"

namespace hyperex::study {

/// Absolute paths of the program, the study and its output, for use from any folder.
struct Called {
  std::filesystem::path program, study, out;
};

/// A shell script that submits the cases to Slurm as job arrays of at most 1,000 tasks, followed by
/// a job that writes the table even if cases fail.
std::string slurm_script(const Called& called, std::size_t cases);

/// A Snakefile: one job per case, whose output is the case's folder, and one job for the table.
std::string snakefile(const Called& called, const std::vector<PlannedCase>& planned);

}  // namespace hyperex::study
