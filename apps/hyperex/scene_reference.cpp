// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>

#include "commands.hpp"
#include "hyperex/scene/scene.hpp"

namespace hyperex::cli {

void add_scene_reference(CLI::App& program) {
  program.add_subcommand("scene-reference", "Print the reference page of the scene file's keys")
      ->group("")  // not in --help: it is for developers who change the keys
      ->footer("Example: hyperex scene-reference > docs/scene.md")
      ->callback([] { std::cout << scene::reference_markdown(); });
}

}  // namespace hyperex::cli
