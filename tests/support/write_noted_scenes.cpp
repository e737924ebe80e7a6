// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a folder for each warning, named by its id, with a scene.toml that causes it. Used by
// tests in other languages.
//   write_noted_scenes FOLDER
#include <iostream>

#include "hyperex/core/error.hpp"
#include "support/noted_scenes.hpp"

int main(int count, char** arguments) {
  if (count != 2) return 2;
  for (const auto& scene : hyperex::test::noted_scenes()) try {
      write_noted_scene(scene, std::filesystem::path(arguments[1]) / scene.id);
    } catch (const hyperex::InputError& error) {  // built without videos
      std::cerr << scene.id << ": " << error.what() << '\n';
    }
}
