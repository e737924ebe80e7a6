// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/scene/scene.hpp"

namespace hyperex::session {

/// Whether a key changes the inputs or the mesh, so that no simulator can take another value of it.
bool makes_the_face(const std::string& key);

/// Whether two scenes are read, meshed and aligned in the same way, so that a session of one can
/// become that of the other. `except`: a key that may differ; empty: none.
bool same_face(const scene::Scene& a, const scene::Scene& b, const std::string& except = "");

}  // namespace hyperex::session
