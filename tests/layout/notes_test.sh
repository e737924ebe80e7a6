#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every id of core/note_kinds.cpp is used in a room that makes notes: a kind that nothing makes would
# stay on docs/notes.md. (That an id which is made has a kind, make_note() sees to.)
#   notes_test.sh SOURCE_FOLDER
set -euo pipefail
cd "$1"
mapfile -t ids < <(sed -nE 's/^  (note|warning)\("([a-z._]+)".*/\2/p' src/hyperex/core/note_kinds.cpp)
((${#ids[@]} > 40)) || { echo "the ids are not found in note_kinds.cpp"; exit 1; }
status=0
for id in "${ids[@]}"; do
  grep -rqF "\"$id\"" src/hyperex --include='*.cpp' --exclude=note_kinds.cpp ||
    { echo "$id: no note of this id is made"; status=1; }
done
exit $status
