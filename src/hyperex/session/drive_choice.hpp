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

/// What drives a scene: drive.by where it is given; else displacement where keys of [support] or
/// [region] are given that belong to it; else, with variants, what these have; else muscles.
DriveChoice drive_choice(const scene::Scene& scene);

}  // namespace hyperex::session
