// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/log_note.hpp"

#include <spdlog/spdlog.h>

namespace hyperex::session {

void log_note(const Note& note) {
  spdlog::log(note.severity == Severity::warning ? spdlog::level::warn : spdlog::level::info, "{}",
              note.text);
}

}  // namespace hyperex::session
