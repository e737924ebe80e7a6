// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/core/note.hpp"
#include "hyperex/scene/scene.hpp"

namespace hyperex::session {

struct DriveChoice {
  simulate::DriveBy by;
  std::string why;  ///< a sentence: "driven by muscles: the scene says so"

  Note note() const;  ///< `drive.chosen`
};

/// What drives a scene: what it says (drive.by); else displacement where keys of [support] or
/// [region] speak of it; else what the variants say; else muscles, whatever the motion.
DriveChoice drive_choice(const scene::Scene& scene);

}  // namespace hyperex::session
