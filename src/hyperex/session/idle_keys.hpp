// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "hyperex/core/note.hpp"
#include "hyperex/scene/scene.hpp"

namespace hyperex::session {

// Keys that the scene or a variant gives and that have no effect, as neither has what they apply
// to.

/// `law.idle`: keys of a law, without tissue.strain = "finite".
std::optional<Note> idle_law_warning(const scene::Scene& scene);

/// `region.idle`: keys of [region], without region.measured.
std::optional<Note> idle_region_warning(const scene::Scene& scene);

/// `support.idle`: stiffnesses and jaw points of [support], where muscles drive the scene and all
/// of its variants.
std::optional<Note> idle_support_warning(const scene::Scene& scene);

}  // namespace hyperex::session
