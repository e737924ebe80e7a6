#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The Snakefile of `hyperex sweep --snakemake`, run by Snakemake: a failed case stops no other, and
# goes on alone when its input is mended.
#   snakemake_test.sh PROGRAM
set -euo pipefail
hyperex=$(realpath "$1")
command -v snakemake > /dev/null || { echo "snakemake is not installed"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export HOME=$work  # its cache
source "$(dirname "$0")/study.sh"
write_study "$broken"
"$hyperex" sweep "my study/study.toml" --snakemake > Snakefile
snakemake --cores 2 --keep-going > log 2>&1 && { cat log; said "a failed case is no failure"; }
expect_two_of_three
before=$(written)
write_study "$sound"
"$hyperex" sweep "my study/study.toml" --snakemake > Snakefile
snakemake --cores 2 --keep-going > log 2>&1 || { cat log; said "the rest does not run"; }
[[ "$(states)" == "$all_three" ]] || { cat log; said "the table: $(states)"; }
[[ "$before" == "$(written)" ]] || said "a finished case was run again"
snakemake --cores 2 > log 2>&1
grep -q 'Nothing to be done' log || { cat log; said "what is finished would be done again"; }
