#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Measures and writes docs/performance.md with its figures: bench/run.sh BUILD [--quick|--tracking|--runs]
# One program after the other, so that none disturbs another. --quick leaves out the large meshes
# and the fine tolerances, and writes its page into BUILD/bench instead. --tracking measures tracking
# alone again and keeps what an earlier run found of the rest, --runs likewise whole runs of the command.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=$1
quick=${2:-}
results=$build/bench/results
[[ "$quick" == --tracking || "$quick" == --runs ]] || rm -rf "$results"
mkdir -p "$results"
SECONDS=0
say() { printf 'bench: %4d s  %s\n' "$SECONDS" "$*"; }
# When and of what a part was measured.
stamp() {
  local commit
  commit=$(git rev-parse --short HEAD 2> /dev/null || echo unknown)
  [[ -z "$(git status --porcelain -- src bench 2> /dev/null)" ]] || commit+=" and changes not committed"
  echo "on $(date +%F) at commit $commit" > "$results/$1.txt"
}
measure_tracking() {
  # Recordings are not part of the project: without them the page says that this was not measured.
  local data=${HYPEREX_DATA:-../shared/data}
  [[ -d "$data/rgbd" ]] || return 0
  say "tracking"
  stamp tracking
  "$build/bin/tracking_bench" "$results/tracking.json" "$data"/rgbd/*/ \
    --scan "$data/ict/subject_A_neutral_scan.ply" --landmarks "$data/ict/subject_A_landmarks.json" \
    2> "$results/tracking.log"
}

measure_runs() {
  say "whole runs"
  stamp whole_run
  /usr/bin/python3 bench/whole_run.py "$build/bin/hyperex" "$results/whole_run.json" "$@"
}

if [[ "$quick" == --tracking || "$quick" == --runs ]]; then
  if [[ "$quick" == --runs ]]; then measure_runs; else measure_tracking; fi
  /usr/bin/python3 bench/report.py "$results" docs
  say "written: docs/performance.md"
  exit
fi
stamp all

say "assembly"
"$build/bin/assembly_bench" --benchmark_out="$results/assembly.json" --benchmark_out_format=json \
  --benchmark_repetitions=3 --benchmark_min_time=0.3 > /dev/null 2> "$results/assembly.log"
say "the full model, number types, CalculiX"
"$build/bin/solver_bench" "$results/solver.json" $quick
say "the reduced model"
"$build/bin/reduced_bench" "$results/reduced.json" $quick

measure_runs $quick
measure_tracking
say "memory over 1,000 runs"
"$build/bin/memory_bench" "$results/memory.json" || say "... it has grown"

# Size of elements at the mouth and layers for about 6, 25, 100 and 250 thousand nodes.
sizes=("0.0029 2" "0.00171 3" "0.00102 5" "0.00079 8")
[[ -z "$quick" ]] || sizes=("${sizes[@]:0:2}")
for at in "${!sizes[@]}"; do
  read -r size layers <<< "${sizes[$at]}"
  for element in tet4 tet4-star; do
    say "growth: $element, elements of $size m in $layers layers"
    # Where memory or time runs out, the page says at what stage.
    timeout 900 "$build/bin/growth_bench" --size "$size" --layers "$layers" --element "$element" \
      --out "$results/growth_${at}_$element.json" 2> "$results/growth_${at}_$element.log" ||
      say "... stopped before its end"
  done
done

if [[ -n "$quick" ]]; then
  /usr/bin/python3 bench/report.py "$results" "$build/bench" --quick
  say "written: $build/bench/performance.md"
else
  /usr/bin/python3 bench/report.py "$results" docs
  say "written: docs/performance.md"
fi
