// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include "hyperex/scene/scene.hpp"

namespace hyperex::scene {

/// The file of the recording that moves the face, whatever its kind; empty for the embedded one.
/// Another file that is assigned to it is of the same kind.
std::filesystem::path& recording_file(MotionOptions& motion);
const std::filesystem::path& recording_file(const MotionOptions& motion);

}  // namespace hyperex::scene
