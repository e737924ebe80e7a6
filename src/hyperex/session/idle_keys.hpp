// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/scene/scene.hpp"

namespace hyperex::session {

// Keys that the scene or a variant gives and that have no effect, as what they apply to is not
// there. A key of the scene holds in its variants too: it is not idle where one of them uses it.

/// `law.idle`: keys of a law, without tissue.strain = "finite".
std::optional<Note> idle_law_warning(const scene::Scene& scene);

/// `region.idle`: keys of [region], without region.measured.
std::optional<Note> idle_region_warning(const scene::Scene& scene);

/// `support.idle`: stiffnesses and jaw points of [support], where muscles drive.
std::optional<Note> idle_support_warning(const scene::Scene& scene);

/// Keys that another key leaves without effect.
struct IdleRule {
  std::vector<std::string> keys;
  std::string by;   ///< the key that leaves them so
  std::string why;  ///< "support.skull is not \"sliding\""
  /// Whether they act in a scene that `drive` moves, if they are given.
  bool (*act)(const scene::Scene& scene, simulate::DriveBy drive);
};
const std::vector<IdleRule>& idle_rules();

/// `keys.idle`: one for each of idle_rules() that applies, in their order.
std::vector<Note> idle_keys_warnings(const scene::Scene& scene);

}  // namespace hyperex::session
