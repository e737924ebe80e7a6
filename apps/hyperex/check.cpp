// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "hyperex/core/kept_results.hpp"
#include "hyperex/core/memory.hpp"
#include "hyperex/core/printable.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/face_session.hpp"

namespace hyperex::cli {

void add_check(CLI::App& program) {
  struct CheckOptions {
    std::filesystem::path scene;
    std::vector<std::string> overrides;
    bool no_variants = false, no_cache = false;
  };
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command =
      program.add_subcommand("check",
                             "Check a scene and the files it names, and report every problem. "
                             "Landmarks are found where none are named, and the tissue is meshed; "
                             "nothing is tracked or simulated; what was not checked is listed");
  command->add_option("SCENE", options->scene, "Scene file (docs/scene.md)")->required();
  command->add_option("--set", options->overrides, "Override a key of the scene; can be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_flag("--no-variants", options->no_variants,
                    "Check the scene without its variants, as hyperex run --no-variants runs it");
  command->add_flag("--no-cache", options->no_cache,
                    "Find landmarks and make the mesh again. Without this option, those of the "
                    "same program on the same files are taken and kept, as hyperex run does");
  command->footer("Example: hyperex check examples/demo.toml");
  command->callback([options] {
    std::string cost;
    scene::Scene scene = scene::read_scene(options->scene, options->overrides);
    if (options->no_variants) scene::leave_out_variants(scene);
    if (!options->no_cache) scene.kept = KeptResults(user_cache_folder());
    take_library_memory();
    const std::vector<Note> found = session::check(scene, &cost);
    const std::vector<std::string> warnings = texts_of(found, Severity::warning);
    for (const auto& note : texts_of(found, Severity::note)) std::cout << printable(note) << '\n';
    for (const auto& warning : warnings) std::cout << "warning: " << printable(warning) << '\n';
    if (!cost.empty()) std::cout << cost << '\n';
    const auto count = warnings.size();
    std::cout << printable(options->scene.string()) << ": no problems found in what was checked"
              << (count == 0   ? ""
                  : count == 1 ? ", but one warning"
                               : ", but " + std::to_string(count) + " warnings")
              << '\n';
  });
}

}  // namespace hyperex::cli
