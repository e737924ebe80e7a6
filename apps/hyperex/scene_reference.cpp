// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_reference.hpp"

#include <CLI/CLI.hpp>
#include <iostream>

#include "hyperex/scene/scene.hpp"

void add_scene_reference(CLI::App& app) {
  app.add_subcommand("scene-reference", "Print the reference page of the scene file's keys")
      ->group("")  // for those who change the keys: not in --help
      ->footer("Example: hyperex scene-reference > docs/scene.md")
      ->callback([] { std::cout << hyperex::scene::reference_markdown(); });
}
