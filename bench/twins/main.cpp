// SPDX-License-Identifier: GPL-3.0-or-later
// twins_study: twin experiments with muscles, as a page (make experiments).
#include <CLI/CLI.hpp>
#include <iostream>

#include "hyperex/core/files.hpp"
#include "twins/twins.hpp"

int main(int argc, char** argv) {
  std::filesystem::path page;
  std::string commit, machine;
  int draws = 5;
  CLI::App program("Twin experiments with muscles, as a page");
  program.add_option("--out", page, "The page (.md)")->required();
  program.add_option("--commit", commit)->required();
  program.add_option("--machine", machine)->required();
  program.add_option("--draws", draws, "Draws of noise, lines and expressions")
      ->check(CLI::Range(1, 100));
  CLI11_PARSE(program, argc, argv);
  try {
    hyperex::check_outputs({page});
    const std::string text =
        hyperex::bench::twins_page(hyperex::bench::run_twins(draws), commit, machine);
    hyperex::write_file_atomically(page, [&](std::ostream& out) { out << text; });
  } catch (const std::exception& error) {
    std::cerr << "twins: " << error.what() << '\n';
    return 1;
  }
}
