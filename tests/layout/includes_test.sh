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
# The room scene has parts, each of which includes only those before it.
mapfile -t parts < <(sed -n 's|^add_subdirectory(\([a-z]*\))$|\1|p' src/hyperex/scene/CMakeLists.txt)
((${#parts[@]} > 3)) || { echo "the parts of scene are not found in its CMakeLists.txt"; exit 1; }
for folder in src/hyperex/scene/*/; do
  folder=$(basename "$folder")
  [[ " ${parts[*]} " == *" $folder "* ]] || { echo "$folder is no part of src/hyperex/scene/CMakeLists.txt"; exit 1; }
done
for ((i = 0; i + 1 < ${#parts[@]}; ++i)); do
  below=$(IFS='|'; echo "${parts[*]:i+1}")
  if grep -rnE "#include [<\"]hyperex/scene/($below)/" "src/hyperex/scene/${parts[i]}"; then
    echo "scene/${parts[i]} may include only: ${parts[*]:0:i+1}"
    status=1
  fi
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
