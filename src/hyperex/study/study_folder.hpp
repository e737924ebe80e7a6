// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include "hyperex/study/study.hpp"

namespace hyperex::study {

std::filesystem::path table_of(const std::filesystem::path& out);  ///< OUT/study.csv

/// Throws InputError where the folder of a study is neither new, empty nor of an earlier sweep,
/// which is recognised by its table, or by cases/ and logs/ alone; or is a file. Changes nothing.
void check_study_folder(const std::filesystem::path& out);

/// The same, then makes the folder, cases/ and logs/. Throws InputError where they or the table
/// cannot be written.
void make_study_folder(const std::filesystem::path& out);

}  // namespace hyperex::study
