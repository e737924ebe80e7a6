#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# sizes_test.py on a small tree in which a function and a file are too long: it must say which.
#   long_test.sh SOURCE_FOLDER
set -euo pipefail
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree/src" "$tree/web"
lines() { for ((i = 0; i < $1; ++i)); do printf '  step(%d);\n' "$i"; done; }
check() { status=0; said=$(python3 "$1/tests/layout/sizes_test.py" "$tree" 2>&1) || status=$?; }
fail() { printf 'FAILED: %s\n%s\n' "$*" "$said" >&2; exit 1; }
expect() { grep -qxF -- "$1" <<< "$said" || fail "expected: $1"; }

# Sixty lines are allowed, wherever the head of the function begins.
{
  printf 'namespace a {\nnamespace {\n\nclass B {\n  int c_ = 0;\n};\n\nint D::most(int one,\n            int two) const {\n'
  lines 57
  printf '}\n\n}  // namespace\n}  // namespace a\n'
} > "$tree/src/short.cpp"
{ printf "describe('many', () => {\n"; for k in 1 2; do printf "  test('one', async () => {\n"; lines 50; printf '  });\n'; done; printf '});\n'; } > "$tree/web/short.test.mjs"
check "$1"
[[ $status == 0 && -z "$said" ]] || fail "what is short enough is refused"

{ printf 'int D::most(int one,\n            int two) const {\n'; lines 58; printf '}\n'; } > "$tree/src/long.cpp"
{ printf 'export function draw(one: number): void {\n'; lines 59; printf '}\n'; } > "$tree/web/long.ts"
{ for ((k = 0; k < 26; ++k)); do printf 'void f%d() {\n' "$k"; lines 18; printf '}\n'; done; } > "$tree/src/file.cpp"
check "$1"
[[ $status == 1 ]] || fail "expected status 1, found $status"
expect "src/long.cpp:1: D::most has 61 lines; a function has at most 60"
expect "web/long.ts:1: draw has 61 lines; a function has at most 60"
expect "src/file.cpp: 520 lines; a file has at most 500"
