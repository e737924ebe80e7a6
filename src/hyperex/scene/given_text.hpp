// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/scene/scene.hpp"

namespace hyperex::scene {

/// A scene file that gives what was given in a scene's file and by overrides, its variants too,
/// with absolute paths: read_scene_text() of it makes the same scene.
std::string given_text(const Scene& scene);

}  // namespace hyperex::scene
