// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/note.hpp"

#include <algorithm>
#include <cctype>
#include <set>

#include "hyperex/core/note_kinds.hpp"
#include "support/note_matchers.hpp"

namespace hyperex {
namespace {
using test::has_id;
using testing::ElementsAre;

TEST(Notes, HaveTheKeyOfTheirKindUnlessAnotherIsGiven) {
  EXPECT_EQ(make_warning("lips.pass_through", "by 2 mm"),
            (Note{"lips.pass_through", Severity::warning, "by 2 mm", "contact.lips"}));
  EXPECT_EQ(make_note("teeth.closed", "one border", "teeth.upper"),
            (Note{"teeth.closed", Severity::note, "one border", "teeth.upper"}));
}

TEST(NotesDeathTest, OfAnUnknownIdOrTheOtherSeverityAreBugs) {
  EXPECT_DEATH(make_note("lips.are_red", ""), "bug in hyperex");
  EXPECT_DEATH(make_note("lips.pass_through", ""), "bug in hyperex");
  EXPECT_DEATH(make_warning("drive.chosen", ""), "bug in hyperex");
}

TEST(Notes, ArePartedBySeverityInTheirOrder) {
  std::vector<Note> notes = {make_note("drive.chosen", "a"), make_warning("law.idle", "b")};
  append(notes, {make_note("lips.cut", "c")});
  EXPECT_THAT(notes_of(notes, Severity::note),
              ElementsAre(has_id("drive.chosen"), has_id("lips.cut")));
  EXPECT_THAT(texts_of(notes), ElementsAre("a", "b", "c"));
  EXPECT_THAT(texts_of(notes, Severity::warning), ElementsAre("b"));
}

TEST(NoteKinds, HaveEachIdOnceWarningsFirstAndASentence) {
  std::set<std::string> ids;
  for (const NoteKind& kind : note_kinds()) {
    const std::string id = kind.id, when = kind.when;
    EXPECT_TRUE(ids.insert(id).second) << id;
    EXPECT_EQ(std::count(id.begin(), id.end(), '.'), 1) << id;
    EXPECT_TRUE(std::all_of(id.begin(), id.end(), [](unsigned char c) {
      return std::islower(c) || c == '.' || c == '_';
    })) << id;
    EXPECT_TRUE(when.ends_with('.')) << id;
    EXPECT_EQ(find_note_kind(id), &kind);
  }
  EXPECT_TRUE(std::ranges::is_sorted(note_kinds(), std::ranges::greater(), &NoteKind::severity));
  EXPECT_EQ(find_note_kind("lips"), nullptr);
}

}  // namespace
}  // namespace hyperex
