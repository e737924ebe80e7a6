// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/drive_choice.hpp"

#include <fmt/format.h>

#include "hyperex/scene/keys.hpp"

namespace hyperex::session {
using simulate::DriveBy;

Note DriveChoice::note() const {
  return make_note("drive.chosen", why);
}

DriveChoice drive_choice(const scene::Scene& scene) {
  const auto chosen = [](DriveBy by, const std::string& why) {
    return DriveChoice{by, fmt::format("driven by {}: {}", word_of(by), why)};
  };
  if (scene.origins.contains("drive.by")) return chosen(scene.drive.by, "the scene says so");
  for (const auto& [key, origin] : scene.origins)
    if (scene::decides_the_drive(key))
      return chosen(scene.drive.by, key + " is given, which applies to displacement");
  if (!scene.variants.empty())
    return chosen(scene.drive.by, scene.drive.by == DriveBy::muscles
                                      ? "its variants respond to the same forces"
                                      : "a variant says so");
  return chosen(DriveBy::muscles, "nothing in the scene says otherwise");
}

}  // namespace hyperex::session
