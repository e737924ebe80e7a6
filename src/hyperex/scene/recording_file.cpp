// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/recording_file.hpp"

#include <utility>

namespace hyperex::scene {

const std::filesystem::path& recording_file(const MotionOptions& motion) {
  for (const auto* file : {&motion.recording, &motion.openface, &motion.arkit})
    if (!file->empty()) return *file;
  return motion.source.file;
}

std::filesystem::path& recording_file(MotionOptions& motion) {
  return const_cast<std::filesystem::path&>(recording_file(std::as_const(motion)));
}

bool of_weights(const Scene& scene) {
  return !scene.motion.arkit.empty() || !scene.motion.openface.empty() || scene.given.of_weights;
}

}  // namespace hyperex::scene
