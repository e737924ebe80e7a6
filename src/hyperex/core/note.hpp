// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace hyperex {

enum class Severity {
  note,    ///< what was assumed, repaired or measured
  warning  ///< probably a mistake, or a result that misleads
};

/// One remark on a run. Callers show `text`; tests and translations refer to `id`.
struct Note {
  std::string id;  ///< stable: "lips.pass_through"; all are in note_kinds.cpp
  Severity severity = Severity::note;
  std::string text;          ///< one sentence
  std::string key;           ///< the scene's key that it is about, "muscles.gain"; empty: none
  std::string variant = "";  ///< the variant that it is about; empty: the scene itself
  bool operator==(const Note&) const = default;
};

/// A note or a warning of a known id and severity (note_kinds.hpp): others are bugs. An empty `key`
/// is that of its kind.
Note make_note(std::string id, std::string text, std::string key = "");
Note make_warning(std::string id, std::string text, std::string key = "");

/// The notes of one severity, in order.
std::vector<Note> notes_of(const std::vector<Note>& notes, Severity severity);

/// The sentences, in order: all, or those of one severity.
std::vector<std::string> texts_of(const std::vector<Note>& notes);
std::vector<std::string> texts_of(const std::vector<Note>& notes, Severity severity);

void append(std::vector<Note>& notes, const std::vector<Note>& more);
void add(std::vector<Note>& notes, std::optional<Note> note);

}  // namespace hyperex
