// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "hyperex/core/note.hpp"
#include "hyperex/scene/scene.hpp"

namespace hyperex::session {

// Given keys that have no effect, as neither the scene nor a variant has what they apply to.

/// `law.idle`: keys of a law, without tissue.strain = "finite".
std::optional<Note> idle_law_warning(const scene::Scene& scene);

/// `region.idle`: keys of [region], without region.measured.
std::optional<Note> idle_region_warning(const scene::Scene& scene);

}  // namespace hyperex::session
