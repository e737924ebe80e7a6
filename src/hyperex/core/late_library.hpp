// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Parts of the program in shared libraries of their own, loaded at first use: the libraries that
// they link to would take time at the start of every command.
#include <filesystem>
#include <string>

namespace hyperex {

/// Where lib/hyperex/NAME is: beside this code or above it if it is part of a shared library
/// itself, otherwise relative to the program, both in the build tree and in an installation.
std::filesystem::path late_library_file(const std::string& name);

/// Loads the library, which stays loaded, and returns its function `symbol`. Throws InputError,
/// naming the file and ending in `remedy`, where it is missing or cannot be loaded.
void* load_late_library(const std::string& name, const char* symbol, const std::string& remedy);

}  // namespace hyperex
