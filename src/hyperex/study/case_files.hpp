// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Where the files of a case are in the study's folder, and the state of the case, which is read
// from these files alone. Any number of processes, on one machine or many, can therefore share a
// study.
#include <filesystem>
#include <string>

namespace hyperex::study {

/// The folder of a run appears complete or not at all, so that an existing one means that the run
/// has finished.
struct CaseFiles {
  std::filesystem::path folder;  ///< OUT/cases/NAME-HASH: the output of `hyperex run`
  std::filesystem::path log;     ///< OUT/logs/NAME-HASH.log: the command, its output, how it ended
};

/// NAME-HASH is the case's name with all characters but letters, digits, '.' and '-' replaced by
/// '_', cut to 60 characters, and the first ten digits of the hash.
CaseFiles files_of_case(const std::filesystem::path& out, const std::string& name,
                        const std::string& hash);

enum class State { not_run, running, failed, finished };
const char* to_string(State state);

State state_of(const CaseFiles& files);

/// The error messages of a failed case's program, on one line.
std::string failure_of(const std::filesystem::path& log);

/// The beginnings of the first and of the last line of a log; the last one where the case failed.
constexpr const char* kLogBegins = "$ ";
constexpr const char* kLogFailed = "hyperex sweep: failed, ";

}  // namespace hyperex::study
