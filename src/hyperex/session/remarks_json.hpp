// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>
#include <vector>

#include "hyperex/core/note.hpp"

namespace hyperex::session {

/// "remarks" of summary.json and of the studio's messages: [{"id": "lips.pass_through", "severity":
/// "warning", "text": "...", "key": "contact.lips"}]. "key" may be "".
nlohmann::ordered_json remarks_json(const std::vector<Note>& notes);

}  // namespace hyperex::session
