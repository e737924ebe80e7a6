// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Matches notes by their ids. Sentences are for human readers; a test checks only figures and names
// in them.
#include <gmock/gmock.h>

#include <ostream>
#include <string>

#include "hyperex/core/note.hpp"

namespace hyperex {

inline void PrintTo(const Note& note, std::ostream* out) {
  *out << (note.severity == Severity::warning ? "warning " : "note ") << note.id << " (" << note.key
       << "): " << note.text;
}

namespace test {

inline auto has_id(const std::string& id) {
  return testing::Field("id", &Note::id, id);
}
inline auto is_note(const std::string& id) {
  return testing::AllOf(has_id(id), testing::Field("severity", &Note::severity, Severity::note));
}
inline auto is_warning(const std::string& id) {
  return testing::AllOf(has_id(id), testing::Field("severity", &Note::severity, Severity::warning));
}
inline auto is_about(const std::string& key) {
  return testing::Field("key", &Note::key, key);
}
/// The sentence contains this figure or name.
inline auto says(const std::string& part) {
  return testing::Field("text", &Note::text, testing::HasSubstr(part));
}

}  // namespace test
}  // namespace hyperex
