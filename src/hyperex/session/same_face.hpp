// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/scene/scene.hpp"

namespace hyperex::session {

/// Whether two scenes are read, meshed and aligned in the same way, so that a session of one can
/// become that of the other. `except`: a key that may differ; empty: none.
bool same_face(const scene::Scene& a, const scene::Scene& b, const std::string& except = "");

}  // namespace hyperex::session
