// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/core/note.hpp"

namespace hyperex::session {

/// Writes the sentence to the log, as information or as a warning. It can serve as
/// SessionOptions::note.
void log_note(const Note& note);

}  // namespace hyperex::session
