// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/study/study_folder.hpp"

#include <fmt/format.h>

#include "hyperex/core/files.hpp"
#include "hyperex/core/output_file.hpp"
#include "hyperex/study/study_table.hpp"

namespace hyperex::study {
namespace fs = std::filesystem;
namespace {

/// A name in `out` that no sweep writes; empty where there is none.
std::string foreign_in(const fs::path& out) {
  std::error_code error;
  for (fs::directory_iterator at(out, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (name != "cases" && name != "logs" && !name.starts_with(".")) return name;
  }
  return "";
}

}  // namespace

fs::path table_of(const fs::path& out) {
  return out / "study.csv";
}

void check_study_folder(const fs::path& out) {
  std::error_code error;
  if (fs::exists(out, error) && !fs::is_directory(out, error))
    throw InputError(out, "is a file; expected the name of a folder for the study");
  if (fs::exists(table_of(out), error))
    check_output_kinds({{table_of(out), {".csv"}, kTableBegins}});
  else if (const std::string foreign = foreign_in(out); !foreign.empty())
    throw InputError(out, fmt::format("holds {}, which no sweep wrote; expected a new or empty "
                                      "folder, or one of an earlier sweep",
                                      foreign));
}

void make_study_folder(const fs::path& out) {
  check_study_folder(out);
  std::error_code error;
  for (const fs::path& folder : {out, out / "cases", out / "logs"}) {
    fs::create_directories(folder, error);
    if (error) throw InputError(folder, "cannot be created (" + error.message() + ")");
  }
  check_outputs({table_of(out)});
}

}  // namespace hyperex::study
