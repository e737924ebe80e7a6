// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/notes_reference.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "hyperex/core/files.hpp"
#include "hyperex/core/note_kinds.hpp"
#include "hyperex/scene/keys.hpp"
#include "hyperex/session/remarks_json.hpp"

namespace hyperex::session {
namespace {

TEST(NotesReference, PageIsUpToDate) {
  const std::string page =
      read_file(std::filesystem::path(HYPEREX_SOURCE_DIR) / "docs" / "notes.md");
  EXPECT_TRUE(page == notes_reference_markdown())
      << "docs/notes.md is not that of the table of notes; make it again with\n"
         "  build/release/bin/hyperex notes-reference > docs/notes.md";
}

TEST(NotesReference, NamesKeysAndSectionsThatExist) {
  for (const NoteKind& kind : note_kinds()) {
    const std::string key = kind.key;
    EXPECT_TRUE(key.empty() || key == "variant" || scene::find_key(key) ||
                std::ranges::count(scene::sections(), key, &scene::Section::name) == 1)
        << kind.id << ": " << key;
  }
}

TEST(RemarksJson, HasAllOfANote) {
  EXPECT_EQ(
      remarks_json({make_warning("law.idle", "idle"), make_note("tissue.few_inverted", "few")})
          .dump(),
      R"([{"id":"law.idle","severity":"warning","text":"idle","key":"tissue.strain"},)"
      R"({"id":"tissue.few_inverted","severity":"note","text":"few","key":""}])");
}

}  // namespace
}  // namespace hyperex::session
