// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/note.hpp"

#include <utility>

#include "hyperex/core/assert.hpp"
#include "hyperex/core/note_kinds.hpp"

namespace hyperex {
namespace {

Note made(std::string id, Severity severity, std::string text, std::string key) {
  const NoteKind* kind = find_note_kind(id);
  HX_ASSERT(kind && kind->severity == severity);
  if (key.empty()) key = kind->key;
  return {std::move(id), severity, std::move(text), std::move(key)};
}

}  // namespace

Note make_note(std::string id, std::string text, std::string key) {
  return made(std::move(id), Severity::note, std::move(text), std::move(key));
}

Note make_warning(std::string id, std::string text, std::string key) {
  return made(std::move(id), Severity::warning, std::move(text), std::move(key));
}

std::vector<Note> notes_of(const std::vector<Note>& notes, Severity severity) {
  std::vector<Note> some;
  for (const Note& note : notes)
    if (note.severity == severity) some.push_back(note);
  return some;
}

std::vector<std::string> texts_of(const std::vector<Note>& notes) {
  std::vector<std::string> texts;
  for (const Note& note : notes) texts.push_back(note.text);
  return texts;
}

std::vector<std::string> texts_of(const std::vector<Note>& notes, Severity severity) {
  return texts_of(notes_of(notes, severity));
}

void append(std::vector<Note>& notes, const std::vector<Note>& more) {
  notes.insert(notes.end(), more.begin(), more.end());
}

void add(std::vector<Note>& notes, std::optional<Note> note) {
  if (note) notes.push_back(*std::move(note));
}

}  // namespace hyperex
