// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/remarks_json.hpp"

namespace hyperex::session {

nlohmann::ordered_json remarks_json(const std::vector<Note>& notes) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Note& note : notes) {
    all.push_back({{"id", note.id},
                   {"severity", note.severity == Severity::warning ? "warning" : "note"},
                   {"text", note.text},
                   {"key", note.key}});
    if (!note.variant.empty()) all.back()["variant"] = note.variant;
  }
  return all;
}

}  // namespace hyperex::session
