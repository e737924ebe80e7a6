#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Prints which share of each room's lines ran in build/coverage, and writes every line's count to
# build/coverage/report/index.html. `make coverage` builds and runs the tests before.
#   scripts/coverage.sh [BUILD_FOLDER]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=${1:-build/coverage}
command -v gcovr > /dev/null || { echo "coverage: gcovr is missing: scripts/setup.sh --lint" >&2; exit 2; }
mkdir -p "$build/report"
gcovr --root . --filter 'src/hyperex/' --filter 'apps/' --object-directory "$build" "$build" \
  --exclude-unreachable-branches --gcov-ignore-parse-errors -j "$(nproc)" \
  --csv "$build/report/lines.csv" --html-details "$build/report/index.html" > /dev/null
# filename,line_total,line_covered,...: summed by folder, src/hyperex/ROOM or apps/PROGRAM.
awk -F, 'NR > 1 {
    split($1, part, "/"); room = part[1] == "src" ? part[3] : part[1]
    total[room] += $2; covered[room] += $3; all += $2; seen += $3
  }
  END {
    if (!all) { print "coverage: no counts: make coverage" > "/dev/stderr"; exit 1 }
    for (room in total)
      printf "%-10s %6d lines %6.1f %%\n", room, total[room], 100 * covered[room] / total[room] | "sort"
    close("sort")
    printf "%-10s %6d lines %6.1f %%\n", "all", all, 100 * seen / all
  }' "$build/report/lines.csv"
echo "every line: $build/report/index.html"
