// SPDX-License-Identifier: GPL-3.0-or-later
// experiments_study: writes a page with pictures that compares the three experiments with the
// results of the thesis (make experiments).
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "experiments/page.hpp"
#include "hyperex/core/files.hpp"

namespace hyperex::bench {
namespace {

struct Options {
  Setting setting;
  std::filesystem::path page;
  PageHead head;
};

void run(const Options& options) {
  check_outputs({options.page});
  std::filesystem::create_directories(options.setting.pictures);
  spdlog::set_level(spdlog::level::err);  // the notes of a scene are in its own report
  Experiments all;
  fmt::print(stderr, "experiment 3 by muscles: the same forces in three tissues\n");
  all.same_forces = hyper_expression_by_muscles(options.setting);
  fmt::print(stderr, "{}", same_forces_section(all.same_forces));
  fmt::print(stderr, "experiment 1: measured deformation\n");
  all.measured = measured_deformation(options.setting);
  fmt::print(stderr, "experiment 2: mouth opening by physics\n");
  all.physics = mouth_opening_by_physics(options.setting);
  fmt::print(stderr, "experiment 3: three tissues\n");
  all.models = hyper_expression(options.setting);
  PageHead head = options.head;
  head.pictures = std::filesystem::relative(options.setting.pictures, options.page.parent_path())
                      .generic_string();
  const std::string page = experiments_page(all, head);
  write_file_atomically(options.page, [&](std::ostream& out) { out << page; });
}

}  // namespace
}  // namespace hyperex::bench

int main(int argc, char** argv) {
  hyperex::bench::Options options;
  CLI::App program("The thesis' three experiments, as a page");
  program.add_option("--source", options.setting.source, "Folder of examples/ and bench/scenes/")
      ->required();
  program.add_option("--data", options.setting.data,
                     "Folder with ict/ and rgbd/; without it subject A is left out");
  program.add_option("--pictures", options.setting.pictures, "Folder for pictures")->required();
  program.add_option("--out", options.page, "The page (.md)")->required();
  program.add_option("--commit", options.head.commit)->required();
  program.add_option("--machine", options.head.machine)->required();
  CLI11_PARSE(program, argc, argv);
  try {
    hyperex::bench::run(options);
  } catch (const std::exception& error) {
    std::cerr << "experiments: " << error.what() << '\n';
    return 1;
  }
}
