// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

namespace hyperex::session {

/// docs/notes.md: every warning and note (core/note_kinds.hpp).
std::string notes_reference_markdown();

}  // namespace hyperex::session
