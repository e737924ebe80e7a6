#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The thesis' three experiments, and twin experiments with muscles: bench/experiments/run.sh BUILD
# Runs the scenes, each into its folder of out/experiments, then measures what docs/experiments.md
# says and writes that page. Without subject A's data the page goes to out/experiments instead, as it
# would lose what was measured on it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
build=$1
out=out/experiments
data=../shared/data  # as the scenes name it
SECONDS=0
say() { printf 'experiments: %4d s  %s\n' "$SECONDS" "$*"; }

faces=(embedded)
page=docs/experiments.md pictures=docs/images/experiments
options=()
if [[ -d "$data/ict" && -d "$data/rgbd/subject_A_mouth_open" ]]; then
  faces+=(subject_a)
  options+=(--data "$data")
else
  page=$out/experiments.md pictures=$out/images/experiments
  say "SKIPPED: subject A, there is no $data; docs/experiments.md stays as it is"
fi
mkdir -p "$out"
commit=$(git rev-parse --short HEAD 2> /dev/null || echo unknown)
[[ -z "$(git status --porcelain -- src bench examples 2> /dev/null)" ]] ||
  commit+=" and changes not committed"
machine="On $(date +%F), $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(nproc) cores"

for face in "${faces[@]}"; do
  for experiment in 1 2 3; do
    name=experiment_${experiment}_$face
    folder=examples
    [[ $face == embedded ]] || folder=bench/scenes
    say "hyperex run $folder/$name.toml"
    "$build/bin/hyperex" run "$folder/$name.toml" --out "$out/$name" > "$out/$name.log" 2>&1 || {
      cat "$out/$name.log" >&2
      exit 1
    }
  done
done
say "measuring what the page says"
"$build/bin/experiments_study" --source . "${options[@]}" --pictures "$pictures" \
  --out "$page" --commit "$commit" \
  --machine "$machine"

say "twin experiments with muscles"
"$build/bin/twins_study" --out docs/twins.md --commit "$commit" --machine "$machine"

say "done. Open"
echo "  $PWD/docs/twins.md    the page: activations and changed tissue found again"
echo "  $PWD/$page    the page: what the thesis says, what we measured"
for face in "${faces[@]}"; do
  for experiment in 1 2 3; do
    echo "  $PWD/$out/experiment_${experiment}_$face/report.html"
  done
done
[[ ${#faces[@]} -gt 1 ]] || say "SKIPPED: subject A (no $data)"
