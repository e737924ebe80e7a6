// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/drive_choice.hpp"

#include <fmt/format.h>

#include <cmath>

#include "hyperex/scene/keys.hpp"
#include "hyperex/simulate/drive/mouth_opening.hpp"

namespace hyperex::session {
namespace {
using simulate::DriveBy;

std::string word_for(DriveBy by) {
  return by == DriveBy::muscles     ? "muscles"
         : by == DriveBy::reactions ? "reactions"
                                    : "displacement";
}

}  // namespace

Note DriveChoice::note() const {
  return make_note("drive.chosen", why);
}

DriveChoice drive_choice(const scene::Scene& scene, const Inputs& inputs) {
  const auto chosen = [](DriveBy by, const std::string& why) {
    return DriveChoice{by, fmt::format("driven by {}: {}", word_for(by), why)};
  };
  if (scene.origins.contains("drive.by")) return chosen(scene.drive.by, "the scene says so");
  for (const auto& [key, origin] : scene.origins)
    if (scene::speaks_of_displacement(key))
      return chosen(scene.drive.by, key + " is given, which speaks of displacement");
  if (!scene.variants.empty())
    return chosen(scene.drive.by, scene.drive.by == DriveBy::muscles
                                      ? "variants are asked what the same forces do"
                                      : "a variant says so");
  const simulate::MouthOpening mouth =
      simulate::mouth_opening(inputs.motion, inputs.driven, inputs.landmarks, scene.drive.gain);
  const double opening_mm = 1e3 * mouth.opening_m, corners_mm = 1e3 * mouth.corners_m;
  const double wide_mm = 1e3 * simulate::kWideOpening * mouth.eyes_m;
  if (opening_mm <= wide_mm)
    return chosen(
        DriveBy::muscles,
        fmt::format("the mouth opens by {:.0f} mm, not more than {:.0f}", opening_mm, wide_mm));
  const std::string what = fmt::format(
      "the mouth opens by {:.0f} mm, more than {:.0f}, and its corners {} by {:.1f} mm", opening_mm,
      wide_mm, corners_mm < 0 ? "draw together" : "part", std::abs(corners_mm));
  return simulate::jaw_drops_alone(mouth)
             ? chosen(DriveBy::displacement, what + ", as by the jaw alone")
             : chosen(DriveBy::muscles, what + ", as by muscles");
}

}  // namespace hyperex::session
