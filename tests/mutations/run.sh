#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Perturbs one formula or assignment at a time and shows that the test that guards it fails.
#   tests/mutations/run.sh           all of mutations.txt, in a copy of the last commit
#   tests/mutations/run.sh beta      those whose name holds "beta"
# Ends with 1 where a mutation survives or cannot be applied. Takes about a minute each.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
work=$root/build/mutations
wanted=${1:-}

rm -rf "$work/source"
mkdir -p "$work"
git -C "$root" archive --prefix=source/ HEAD | tar -x -C "$work"
ln -s "$root/web/node_modules" "$work/source/web/node_modules"
cmake -S "$work/source" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release > "$work/configure.log"

survived=0
# A line each: name | file | text | its replacement | build target | test (a ctest pattern)
while IFS='|' read -r name file from to target test; do
  [[ -z "$name" || "$name" == \#* || "$name" != *"$wanted"* ]] && continue
  read -r name <<< "$name"; read -r file <<< "$file"; read -r target <<< "$target"; read -r test <<< "$test"
  from=${from# }; from=${from% }; to=${to# }; to=${to% }
  path=$work/source/$file
  cp "$path" "$work/original"
  if ! python3 - "$path" "$from" "$to" <<'PYTHON'
import sys
path, old, new = sys.argv[1:]
text = open(path).read()
if text.count(old) != 1:
    sys.exit(f"{path}: {text.count(old)} places hold {old!r}, one was expected")
open(path, "w").write(text.replace(old, new))
PYTHON
  then echo "NOT APPLIED  $name"; survived=1; continue; fi
  if ! cmake --build "$work/build" --target $target > "$work/build.log" 2>&1; then
    echo "NOT BUILT    $name (see $work/build.log)"; survived=1
  elif ctest --test-dir "$work/build" -R "$test" --no-tests=error > "$work/test.log" 2>&1; then
    echo "SURVIVED     $name: $test passes"; survived=1
  elif grep -q "No tests were found" "$work/test.log"; then
    echo "NOT TESTED   $name: no test $test"; survived=1
  else
    echo "caught       $name: $(sed -n 's/.*- \([^ ]*\) (Failed).*/\1/p' "$work/test.log" | head -3 | tr '\n' ' ')"
  fi
  cp "$work/original" "$path"
done < "$here/mutations.txt"
exit $survived
