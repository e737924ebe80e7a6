// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// There is one file per subcommand; it parses the options, calls the library and prints. Each
// function below adds its subcommand to the program. The work of a subcommand is done by its
// callback, which runs once all options are parsed. On wrong input, throw InputError (exit status
// 2). If a computation fails, throw any other exception (exit status 1).
#include <CLI/CLI.hpp>
#include <string>

namespace hyperex::cli {

void add_check(CLI::App& program);
void add_compare(CLI::App& program);
void add_ct(CLI::App& program);
void add_estimate(CLI::App& program);
void add_landmarks(CLI::App& program);
void add_mesh(CLI::App& program);
void add_new(CLI::App& program);
void add_presets(CLI::App& program);
void add_rig(CLI::App& program);
void add_run(CLI::App& program);
void add_sample(CLI::App& program);
void add_scene_reference(CLI::App& program);
void add_notes_reference(CLI::App& program);
void add_studio(CLI::App& program);
void add_sweep(CLI::App& program);
void add_symmetry(CLI::App& program);
void add_track(CLI::App& program);
void add_visits(CLI::App& program);

/// The lines of `hyperex --version`.
std::string version_text();

}  // namespace hyperex::cli
