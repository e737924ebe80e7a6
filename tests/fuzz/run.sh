#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs every target of libFuzzer for SECONDS_EACH seconds (600 where not given), as many at once as
# there are cores. What was found on the way stays in build/fuzz/corpus and serves the next time;
# what fails is kept in build/fuzz/found, and named at the end.
#   tests/fuzz/run.sh [SECONDS_EACH] [TARGET...]
#   RUNS_EACH=20000 tests/fuzz/run.sh     that many inputs each from a fixed seed: the same every time
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
each_s=${1:-600}
shift || true
bin=build/fuzz/bin
targets=("$@")
((${#targets[@]})) || mapfile -t targets < <(cd "$bin" && ls -1 fuzz_* | sed 's/^fuzz_//' | grep -vx reader)
mkdir -p build/fuzz/{corpus,found,log}
"$bin/write_seeds" build/fuzz/seeds

one() {
  local corpus="build/fuzz/corpus/$1" limit=(-max_total_time="$2") as=()
  if [[ -n "${RUNS_EACH:-}" ]]; then
    # The same inputs every time. The corpus begins empty and is not read again, which libFuzzer
    # would do after certain times. Addresses are not random, since it takes words for its inputs
    # from values that the program compares.
    corpus="build/fuzz/fixed/$1"
    limit=(-runs="$RUNS_EACH" -seed=1 -reload=0)
    ! setarch -R true 2> /dev/null || as=(setarch -R)
    rm -rf "$corpus"
  fi
  mkdir -p "$corpus"
  if "${as[@]}" build/fuzz/bin/"fuzz_$1" "${limit[@]}" -timeout=30 -rss_limit_mb=2048 -max_len=8192 \
    -dict=tests/fuzz/words.dict -print_final_stats=1 -artifact_prefix="build/fuzz/found/$1-" \
    "$corpus" "build/fuzz/seeds/$1" > "build/fuzz/log/$1" 2>&1; then
    printf '%-10s %s inputs, sound\n' "$1" \
      "$(sed -n 's/^stat::number_of_executed_units: //p' "build/fuzz/log/$1")"
  else
    printf '%-10s FAILED: build/fuzz/log/%s, input in build/fuzz/found\n' "$1" "$1"
    grep -E 'runtime error|ERROR|SUMMARY|what\(\)|^Base64' "build/fuzz/log/$1" || true
    return 1
  fi
}
export -f one
# A failing target does not end the others; xargs ends with 123 then.
printf '%s\n' "${targets[@]}" | xargs -P "${JOBS:-$(nproc)}" -I{} bash -c "one {} $each_s"
