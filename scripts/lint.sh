#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Formatting (.clang-format) and a small set of checks (.clang-tidy) over the C++ of this repository;
# words: the length of sentences and the links of the pages for people (scripts/words.py), gathered
# figures (scripts/figures.py), spelling (codespell).
#   scripts/lint.sh                    all, over everything (the checks take some 30 minutes of CPU)
#   scripts/lint.sh --format           formatting alone (seconds)
#   scripts/lint.sh --words            words alone (seconds)
#   scripts/lint.sh --tidy [FILE...]   the checks alone, over these .cpp files
# The checks read build/lint/compile_commands.json and the headers that a build generates: make lint makes both.
# clang's two need version 14, Debian 12's: others format and warn differently.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
die() { printf 'lint: %s\n' "$*" >&2; exit 2; }

is_fourteen() {
  command -v "$1" > /dev/null || die "$1 is missing: scripts/setup.sh --lint"
  "$1" --version | grep -q 'version 14\.' || die "expected $1 14; found $("$1" --version | grep version)"
}

format() {
  is_fourteen clang-format
  git ls-files '*.cpp' '*.hpp' | xargs clang-format --dry-run --Werror ||
    die "not formatted: clang-format -i on the files above"
  echo "lint: $(git ls-files '*.cpp' '*.hpp' | wc -l) files are formatted"
}

# Misspelt on purpose: the inputs of tests. Not ours: the list of packages of npm.
words() {
  scripts/figures.py || die "figures of docs/how_good.md that stand nowhere else (above)"
  scripts/words.py || die "sentences or links to mend (above); exceptions: scripts/words_allowed.txt"
  if ! command -v codespell > /dev/null; then
    echo "lint: SKIPPED spelling: codespell is missing (scripts/setup.sh --lint)"
    return
  fi
  git ls-files -z -- ':!tests/' ':!web/package-lock.json' ':!scripts/spelling_allowed.txt' |
    xargs -0 grep -lIZ '' |
    xargs -0 codespell --quiet-level 2 --ignore-words scripts/spelling_allowed.txt ||
    die "words misspelt (above); what is right all the same: scripts/spelling_allowed.txt"
  echo "lint: codespell finds nothing"
}

tidy() {
  is_fourteen clang-tidy
  local database=build/lint/compile_commands.json file files=()
  [[ -f "$database" ]] || die "$database is missing: make lint (or cmake --preset lint, and build hx_generated)"
  (($#)) || set -- $(git ls-files '*.cpp')
  for file; do  # what is not built here (for another sanitizer, say) has no command
    grep -qF "/$file\"" "$database" && files+=("$file")
  done
  ((${#files[@]})) || { echo "lint: no file to check"; return; }
  printf '%s\n' "${files[@]}" |
    xargs -P "$(nproc)" -n 1 clang-tidy --quiet -p build/lint 2> >(grep -v 'warnings generated' >&2 || true) ||
    die "clang-tidy complains (above)"
  echo "lint: ${#files[@]} files pass clang-tidy"
}

case "${1:-}" in
  --format) format ;;
  --tidy) shift; tidy "$@" ;;
  --words) words ;;
  '') format; words; tidy ;;
  -h | --help) sed -n '3,12s/^# \{0,1\}//p' "$0" ;;
  *) die "unknown option $1 (there are --format, --words and --tidy)" ;;
esac
