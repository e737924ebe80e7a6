// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// For each warning a small scene that causes it. The same table is used with every interface that
// shows warnings: the program, the studio, Python and C++.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hyperex::test {

struct NotedScene {
  std::string id;    ///< the warning
  bool when_read;    ///< found by reading the inputs (`hyperex check`); otherwise it needs a run
  std::string keys;  ///< replace keys of the valid scene: "motion.gain=5", one per line
  void (*spoil)(const std::filesystem::path& folder);  ///< changes the valid inputs; null: nothing
};

const std::vector<NotedScene>& noted_scenes();

/// Warnings that no small scene causes, and the test that checks them instead.
const std::map<std::string, std::string>& warnings_without_scene();

/// Writes the valid inputs, applies `spoil`, and writes the scene; returns the scene's file.
std::filesystem::path write_noted_scene(const NotedScene& scene,
                                        const std::filesystem::path& folder);

}  // namespace hyperex::test
