#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Rooms include only rooms above them: their order is that of CMakeLists.txt. Linking alone does not
# hold them to it, as all headers stand under one include folder.
#   includes_test.sh SOURCE_FOLDER
set -euo pipefail
cd "$1"
mapfile -t rooms < <(sed -n 's|^add_subdirectory(src/hyperex/\([a-z]*\))$|\1|p' CMakeLists.txt)
((${#rooms[@]} > 10)) || { echo "the rooms are not found in CMakeLists.txt"; exit 1; }
for folder in src/hyperex/*/; do
  folder=${folder#src/hyperex/}
  [[ " ${rooms[*]} " == *" ${folder%/} "* ]] || { echo "${folder%/} is no room of CMakeLists.txt"; exit 1; }
done
status=0
for ((i = 0; i < ${#rooms[@]}; ++i)); do
  below=$(IFS='|'; echo "${rooms[*]:i+1}")
  [[ -n "$below" ]] || continue
  if grep -rnE "#include [<\"]hyperex/($below)/" "src/hyperex/${rooms[i]}"; then
    echo "${rooms[i]} may include only: ${rooms[*]:0:i+1}"
    status=1
  fi
done
# A room's parts (PARTS in its CMakeLists.txt) include only parts before them, and the files of the
# room that are in none.
for room in "${rooms[@]}"; do
  folder=src/hyperex/$room
  read -ra parts < <(sed -n 's/^  PARTS \(.*\)$/\1/p' "$folder/CMakeLists.txt") || parts=()
  for part in "$folder"/*/; do
    part=$(basename "$part")
    [[ "$part" == data || "$part" == '*' || " ${parts[*]} " == *" $part "* ]] ||
      { echo "$part is not among the PARTS of $folder/CMakeLists.txt"; status=1; }
  done
  for ((i = 0; i + 1 < ${#parts[@]}; ++i)); do
    below=$(IFS='|'; echo "${parts[*]:i+1}")
    if grep -rnE "#include [<\"]hyperex/$room/($below)/" "$folder/${parts[i]}"; then
      echo "$room/${parts[i]} may include only: ${parts[*]:0:i+1}"
      status=1
    fi
  done
done
# Those that include everything are for other programs.
if grep -rnE '#include [<"]hyperex/[a-z_]+\.hpp' src/hyperex/*/ apps/hyperex; then
  echo "rooms include what they need, not hyperex/hyperex.hpp or hyperex/fem.hpp"
  status=1
fi
# The names of the 68 iBUG points have one home; defaults and sentences may spell one out.
if grep -rnE '"ibug68_[^0-9]*"|"ibug68_[^"]*\{' src/hyperex apps/hyperex --include='*.[ch]pp' |
  grep -v '^src/hyperex/face/ibug.cpp'; then
  echo "expected face::ibug(k) (face/ibug.hpp)"
  status=1
fi
# NDEBUG takes assert() out of the builds that users run; HX_ASSERT (core/assert.hpp) stays.
if grep -rnE '(^|[^_a-zA-Z])assert\(|<cassert>' src/hyperex apps/hyperex --include='*.[ch]pp' |
  grep -vE '^src/hyperex/core/(assert|error).hpp'; then
  echo "expected HX_ASSERT"
  status=1
fi
exit $status
