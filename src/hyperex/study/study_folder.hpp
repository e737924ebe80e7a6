// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include "hyperex/study/study.hpp"

namespace hyperex::study {

std::filesystem::path table_of(const std::filesystem::path& out);  ///< OUT/study.csv

/// Throws InputError where `out` is a file, or a folder that is neither new, nor empty, nor from an
/// earlier sweep. A sweep's folder is recognised by its table, or by containing only cases/ and
/// logs/. Changes nothing.
void check_study_folder(const std::filesystem::path& out);

/// Checks the same, then creates the folder, cases/ and logs/. Throws InputError where they or the
/// table cannot be written.
void make_study_folder(const std::filesystem::path& out);

}  // namespace hyperex::study
