// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace hyperex::cli {

/// What was given to `program` and belongs to nothing, after parsing has thrown CLI::ExtrasError. A
/// line for each, in the order given: an option that the command lacks, with the nearest of its own
/// or what to do instead, or arguments that it does not expect.
std::string unexpected(const CLI::App& program);

}  // namespace hyperex::cli
