#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# scripts/words.py finds what is wrong in a small tree of pages, and nothing where nothing is.
#   words_test.sh SOURCE_FOLDER
set -euo pipefail
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir "$tree/scripts" "$tree/docs"
cp "$1/scripts/words.py" "$tree/scripts/"
thirty_four=$(printf 'word %.0s' {1..34})
fail() { printf 'FAILED: %s\n%s\n' "$*" "$(cat "$tree/said")" >&2; exit 1; }
check() { status=0; python3 "$tree/scripts/words.py" > "$tree/said" 2>&1 || status=$?; }
expect() { grep -qF -- "$1" "$tree/said" || fail "expected: $1"; }

# 35 words, some of them inside code, a link or a formula; code blocks and references may be longer.
: > "$tree/scripts/words_allowed.txt"
cat > "$tree/README.md" << END
# A page
$thirty_four \`code of many words\`. Short. See ${thirty_four/word word word/} [there](docs/a.md#two-words-1).

\`\`\`
$thirty_four $thirty_four [no link](nowhere.md)
\`\`\`
## References
* $thirty_four $thirty_four
END
printf '## Two words\n## Two words\n\n    %s %s\n' "$thirty_four" "$thirty_four" > "$tree/docs/a.md"
check
[[ $status == 0 ]] || fail "sound pages are refused"

printf '# B\n\n%s and more. \n| a | %s and more |\n\n[x](a.md#three) [y](c.md)\n' "$thirty_four" "$thirty_four" > "$tree/docs/b.md"
check
[[ $status == 1 ]] || fail "expected status 1, found $status"
expect "docs/b.md:3: 36 words: word word"
expect "docs/b.md:4: 36 words: word word"
expect "docs/b.md:6: link to a.md#three: a.md has no heading with that anchor"
expect "docs/b.md:6: link to c.md: there is no such file"

printf '# B\n\n%s and more.\n' "$thirty_four" > "$tree/docs/b.md"
echo 'docs/b.md: word word  # on purpose' > "$tree/scripts/words_allowed.txt"
check
[[ $status == 0 ]] || fail "an exception does not count"
echo 'docs/a.md: gone  # a sentence that was rewritten' >> "$tree/scripts/words_allowed.txt"
check
expect "excuses nothing any more: docs/a.md: gone"
