#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Perturbs one formula or assignment at a time and shows that the test that guards it fails, having
# passed before.
#   tests/mutations/run.sh           all of mutations.txt, in a copy of the last commit
#   tests/mutations/run.sh beta      those whose name holds "beta"
# Ends with 1 where a mutation survives or cannot be applied. Takes about a minute each, after a
# build of the tests named (minutes; with the compiler cache the next time less).
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
work=$root/build/mutations
wanted=${1:-}
jobs=${JOBS:-$(nproc)}

rm -rf "$work/source"
mkdir -p "$work"
git -C "$root" archive --prefix=source/ HEAD | tar -x -C "$work"
ln -s "$root/web/node_modules" "$work/source/web/node_modules"
cmake -S "$work/source" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DHYPEREX_TESTS=ON \
  > "$work/configure.log"

# A line each: name | file | text | its replacement | build target | test (a ctest pattern)
names=() files=() originals=() mutants=() targets=() tests=()
while IFS='|' read -r name file from to target test; do
  [[ -z "$name" || "$name" == \#* || "$name" != *"$wanted"* ]] && continue
  read -r name <<< "$name"; read -r file <<< "$file"; read -r target <<< "$target"; read -r test <<< "$test"
  from=${from# }; from=${from% }; to=${to# }; to=${to% }
  names+=("$name") files+=("$file") originals+=("$from") mutants+=("$to") targets+=("$target") tests+=("$test")
done < "$here/mutations.txt"
((${#names[@]})) || { echo "mutations: no name in mutations.txt holds \"$wanted\"" >&2; exit 2; }

passes() { # ctest pattern
  ctest --test-dir "$work/build" -R "$1" --no-tests=error --parallel "$jobs" > "$work/test.log" 2>&1
}
apply() { # file, text, its replacement
  python3 - "$@" <<'PYTHON'
import sys
path, old, new = sys.argv[1:]
text = open(path).read()
if text.count(old) != 1:
    sys.exit(f"{path}: {text.count(old)} places hold {old!r}, one was expected")
open(path, "w").write(text.replace(old, new))
PYTHON
}

# Only a test that passes on the code as it is can show anything.
mapfile -t all_targets < <(printf '%s\n' "${targets[@]}" | sort -u)
cmake --build "$work/build" --parallel "$jobs" --target "${all_targets[@]}" > "$work/build.log" 2>&1 || { echo "mutations: the last commit does not build (see $work/build.log)" >&2; exit 2; }
while read -r test; do
  passes "$test" || { echo "mutations: without a mutation $test does not pass (see $work/test.log)" >&2; exit 2; }
done < <(printf '%s\n' "${tests[@]}" | sort -u)

survived=0
for i in "${!names[@]}"; do
  name=${names[i]} path=$work/source/${files[i]} test=${tests[i]}
  cp "$path" "$work/original"
  if ! apply "$path" "${originals[i]}" "${mutants[i]}"; then
    echo "NOT APPLIED  $name"; survived=1; continue
  fi
  if ! cmake --build "$work/build" --parallel "$jobs" --target "${targets[i]}" > "$work/build.log" 2>&1; then
    echo "NOT BUILT    $name (see $work/build.log)"; survived=1
  elif passes "$test"; then
    echo "SURVIVED     $name: $test passes"; survived=1
  else
    echo "caught       $name: $(sed -nE 's/^\s+[0-9]+ - (\S+) \((Failed|Timeout|SEGFAULT|Subprocess aborted)\).*/\1/p' "$work/test.log" | head -3 | tr '\n' ' ')"
  fi
  cp "$work/original" "$path"
done
exit $survived
