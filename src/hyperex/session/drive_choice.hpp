// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/session/inputs.hpp"

namespace hyperex::session {

struct DriveChoice {
  simulate::DriveBy by;
  std::string why;  ///< a sentence: "driven by muscles: the mouth opens by 9 mm, ..."

  Note note() const;  ///< `drive.chosen`
};

/// What drives a scene: what it says (drive.by); else muscles where it has variants; else, without
/// keys of [support] or [region] that speak of displacement, by its motion: displacement where the
/// jaw drops wide and alone (simulate::jaw_drops_alone), muscles for all else.
DriveChoice drive_choice(const scene::Scene& scene, const Inputs& inputs);

}  // namespace hyperex::session
