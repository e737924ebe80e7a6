// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/notes_reference.hpp"

#include <iostream>

#include "commands.hpp"

namespace hyperex::cli {

void add_notes_reference(CLI::App& program) {
  program.add_subcommand("notes-reference", "Print the reference page of notes and warnings")
      ->group("")  // not in --help: it is for developers who change the notes
      ->footer("Example: hyperex notes-reference > docs/notes.md")
      ->callback([] { std::cout << session::notes_reference_markdown(); });
}

}  // namespace hyperex::cli
