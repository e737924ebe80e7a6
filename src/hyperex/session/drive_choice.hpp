// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/scene/scene.hpp"

namespace hyperex::session {

struct DriveChoice {
  simulate::DriveBy by;
  std::string why;  ///< a sentence: "driven by muscles: the scene says so"

  Note note() const;  ///< `drive.chosen`
};

/// What drives a scene: drive.by where it is given; else displacement where a key is given that
/// muscles do not use (scene::needs_displacement()); else, with variants, what these have; else
/// muscles.
DriveChoice drive_choice(const scene::Scene& scene);

/// `drive.by_key`, where another key than drive.by makes displacement drive; `region.idle`,
/// `support.idle` and `keys.idle`, which name given keys without effect (idle_keys.hpp).
std::vector<Note> drive_warnings(const scene::Scene& scene);

}  // namespace hyperex::session
