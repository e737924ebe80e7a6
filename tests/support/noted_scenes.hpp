// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// For each warning a small scene that causes it. The same table is run through every caller that
// shows warnings: the program, the studio, Python and C++.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hyperex::test {

struct NotedScene {
  std::string id;    ///< the warning
  bool when_read;    ///< found by reading the inputs (`hyperex check`); else it takes a run
  std::string keys;  ///< replace those of the sound scene: "motion.gain=5", a line each, as --set
  void (*spoil)(const std::filesystem::path& folder);  ///< changes the sound inputs; null: nothing
};

const std::vector<NotedScene>& noted_scenes();

/// Warnings that no small scene causes, and the test that has them instead.
const std::map<std::string, std::string>& warnings_without_scene();

/// Writes sound inputs, spoilt, and the scene; returns the scene's file.
std::filesystem::path write_noted_scene(const NotedScene& scene,
                                        const std::filesystem::path& folder);

}  // namespace hyperex::test
