// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/notes_reference.hpp"

#include <fmt/format.h>

#include "hyperex/core/note_kinds.hpp"

namespace hyperex::session {
namespace {

const char* const introduction = R"(# Notes and warnings

<!-- Made by `hyperex notes-reference > docs/notes.md`; edit src/hyperex/core/note_kinds.cpp instead. -->

A run lists every assumption, repair and doubt. `hyperex check` and `hyperex run` print the sentences, and
`summary.json` has them under `notes`, the warnings again under `warnings`. `remarks` there has the same with an id:

```json
{"id": "recording.starts_in_expression", "severity": "warning", "text": "...", "key": "motion.rest_s"}
```

* **`id`** stays the same from version to version; the sentence may change.
* **`key`** is the key or section of the [scene](scene.md) that it is about.
)";

std::string table(Severity severity) {
  std::string rows = "| id | key | given when |\n|---|---|---|\n";
  for (const NoteKind& kind : note_kinds())
    if (kind.severity == severity)
      rows += fmt::format("| `{}` | {} | {} |\n", kind.id,
                          *kind.key ? fmt::format("`{}`", kind.key) : "", kind.when);
  return rows;
}

}  // namespace

std::string notes_reference_markdown() {
  return fmt::format(
      "{}\n## Warnings\nProbably a mistake, or a result that misleads.\n\n{}"
      "\n## Notes\nWhat was assumed, repaired or measured.\n\n{}",
      introduction, table(Severity::warning), table(Severity::note));
}

}  // namespace hyperex::session
