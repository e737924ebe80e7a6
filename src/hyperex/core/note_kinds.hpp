// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <string_view>

#include "hyperex/core/note.hpp"

namespace hyperex {

/// What a note of one id means. A new note needs a row in note_kinds.cpp; docs/notes.md is made of
/// the rows.
struct NoteKind {
  const char* id;  ///< subject.what
  Severity severity;
  const char* key;   ///< the scene's key or section that it is about; "": none
  const char* when;  ///< a sentence: when it is given
};

/// Warnings first; each id once.
std::span<const NoteKind> note_kinds();

/// Null where there is none.
const NoteKind* find_note_kind(std::string_view id);

}  // namespace hyperex
