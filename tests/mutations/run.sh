#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Perturbs one formula or assignment at a time and shows that the test that guards it fails, having
# passed before.
#   tests/mutations/run.sh           all of mutations.txt, in a copy of the last commit
#   tests/mutations/run.sh beta      those whose name holds "beta"
# Ends with 1 where a mutation survives or cannot be applied. Takes about a minute each, after a
# build of the tests named. As root the copy is mounted in the place of the repository, in a mount
# namespace of its own, so that the compiler's cache knows what `make test` has compiled.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=${MUTATIONS_WORK:-$root/build/mutations}
wanted=${1:-}
jobs=${JOBS:-$(nproc)}

if [[ -z "${MUTATIONS_WORK:-}" ]]; then
  mkdir -p "$work/source"
  find "$work/source" -mindepth 1 -maxdepth 1 ! -name build -exec rm -rf {} +
  git -C "$root" archive HEAD | tar -xm -C "$work/source"  # newer than any object of an earlier mutant
  if [[ "$(id -u)" == 0 ]] && unshare --mount true 2> /dev/null; then
    mkdir -p "$work/source/web/node_modules" "$work/source/build/work"
    export MUTATIONS_WORK=$root/build/work
    exec unshare --mount --propagation private bash -euo pipefail -c '
      mount --bind "$1/web/node_modules" "$2/web/node_modules"
      mount --rbind "$2" "$1"
      cd "$1"
      exec "$1/tests/mutations/run.sh" "$3"' bash "$root" "$work/source" "$wanted"
  fi
  ln -s "$root/web/node_modules" "$work/source/web/node_modules"
  source=$work/source
else
  source=$root  # the copy
fi
build=$source/build/release
cmake -S "$source" --preset release -DHYPEREX_TESTS=ON > "$work/configure.log"

# A line each: name | file | text | its replacement | build target | test (a ctest pattern)
names=() files=() originals=() mutants=() targets=() tests=()
while IFS='|' read -r name file from to target test; do
  [[ -z "$name" || "$name" == \#* || "$name" != *"$wanted"* ]] && continue
  read -r name <<< "$name"; read -r file <<< "$file"; read -r target <<< "$target"; read -r test <<< "$test"
  from=${from# }; from=${from% }; to=${to# }; to=${to% }
  names+=("$name") files+=("$file") originals+=("$from") mutants+=("$to") targets+=("$target") tests+=("$test")
done < "$source/tests/mutations/mutations.txt"
((${#names[@]})) || { echo "mutations: no name in mutations.txt holds \"$wanted\"" >&2; exit 2; }

passes() { # ctest pattern
  ctest --test-dir "$build" -R "$1" --no-tests=error --parallel "$jobs" > "$work/test.log" 2>&1
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
cmake --build "$build" --parallel "$jobs" --target "${all_targets[@]}" > "$work/build.log" 2>&1 ||
  { echo "mutations: the last commit does not build (see $work/build.log)" >&2; exit 2; }
while read -r test; do
  passes "$test" || { echo "mutations: without a mutation $test does not pass (see $work/test.log)" >&2; exit 2; }
done < <(printf '%s\n' "${tests[@]}" | sort -u)

survived=0
for i in "${!names[@]}"; do
  name=${names[i]} path=$source/${files[i]} test=${tests[i]}
  cp "$path" "$work/original"
  if ! apply "$path" "${originals[i]}" "${mutants[i]}"; then
    echo "NOT APPLIED  $name"; survived=1; continue
  fi
  if ! cmake --build "$build" --parallel "$jobs" --target "${targets[i]}" > "$work/build.log" 2>&1; then
    echo "NOT BUILT    $name (see $work/build.log)"; survived=1
  elif passes "$test"; then
    echo "SURVIVED     $name: $test passes"; survived=1
  else
    echo "caught       $name: $(sed -nE 's/^\s+[0-9]+ - (\S+) \((Failed|Timeout|SEGFAULT|Subprocess aborted)\).*/\1/p' "$work/test.log" | head -3 | tr '\n' ' ')"
  fi
  cp "$work/original" "$path"
done
exit $survived
