// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Where a case lies in the study's folder, and how far it has come, read off what lies there: any
// number of processes, on one machine or many, exchange information by that alone.
#include <filesystem>
#include <string>

namespace hyperex::study {

/// A run's folder appears whole or not at all, so one that stands there is finished.
struct CaseFiles {
  std::filesystem::path folder;  ///< OUT/cases/NAME-HASH: of `hyperex run`
  std::filesystem::path log;     ///< OUT/logs/NAME-HASH.log: its command, what it said, its end
};

/// NAME with '_' for all but letters, digits, '.' and '-', at most 60 characters, and the first ten
/// digits of the hash.
CaseFiles files_of_case(const std::filesystem::path& out, const std::string& name,
                        const std::string& hash);

enum class State { not_run, running, failed, finished };
const char* to_string(State state);

State state_of(const CaseFiles& files);

/// What a failed case's program said last, on one line.
std::string failure_of(const std::filesystem::path& log);

/// The first and the last line of a log.
constexpr const char* kLogBegins = "$ ";
constexpr const char* kLogFailed = "hyperex sweep: failed, ";

}  // namespace hyperex::study
