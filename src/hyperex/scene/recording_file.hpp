// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include "hyperex/scene/scene.hpp"

namespace hyperex::scene {

/// The file of the recording that moves the face, whatever its kind; empty for the embedded one.
/// Another file that is assigned to it is of the same kind.
std::filesystem::path& recording_file(MotionOptions& motion);
const std::filesystem::path& recording_file(const MotionOptions& motion);

/// Whether the recording is one of expressions' weights (motion.arkit, motion.openface, or a given
/// motion made of them), which are 0 at rest.
bool of_weights(const Scene& scene);

}  // namespace hyperex::scene
