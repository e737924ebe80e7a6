#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The documentation as a site: docs/site/build.sh OUT FOLDER_OF_THE_PYTHON_MODULE
# writes OUT/html/index.html, which needs no network. What it takes: scripts/setup.sh --docs.
# The pages are those of the repository. They are seen through links in OUT/source, at the same paths, so that links
# between them lead to the same places here and there.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
repository=$PWD
out=$(realpath -m "$1")
module=$(realpath "$2")
export HYPEREX_VERSION
HYPEREX_VERSION=$(sed -n 's/^project(hyperex VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
[[ -n "$HYPEREX_VERSION" ]] || { echo "docs: CMakeLists.txt states no version" >&2; exit 1; }
mathjax=/usr/share/javascript/mathjax
[[ -d "$mathjax" ]] || { echo "docs: $mathjax is missing: scripts/setup.sh --docs" >&2; exit 1; }

source=$out/source
rm -rf "$source" "$out/html"
mkdir -p "$source/reference"
for page in *.md LICENSE docs src examples; do ln -s "$repository/$page" "$source/$page"; done
ln -s "$repository/docs/site/index.md" "$source/index.md"

# The pages of the APIs.
{
  cat docs/site/Doxyfile
  echo "PROJECT_NUMBER = $HYPEREX_VERSION"
  echo "OUTPUT_DIRECTORY = $out/doxygen"
  echo "INPUT = $(/usr/bin/python3 docs/site/api_pages.py headers)"
} > "$out/Doxyfile"
rm -rf "$out/doxygen"
mkdir "$out/doxygen"
doxygen "$out/Doxyfile"
# Sphinx cannot read values that name members, {.unit = ...}.
sed -i '/<initializer>{\.[a-z]/d' "$out"/doxygen/xml/*.xml
/usr/bin/python3 docs/site/api_pages.py pages "$source/reference" "$out/doxygen/xml" "$module/hyperex/__init__.pyi" "$module"

# Formulas are drawn by MathJax from the same folder. Only what draws SVG is taken: 8 of 54 MB.
mkdir -p "$out/static/mathjax"
for part in MathJax.js config/TeX-AMS_SVG.js extensions jax/element jax/input/TeX jax/output/SVG; do
  mkdir -p "$out/static/mathjax/$(dirname "$part")"
  cp -rLu "$mathjax/$part" "$out/static/mathjax/$(dirname "$part")/"
done

HYPEREX_DOCS_OUT=$out /usr/bin/python3 -m sphinx -b html -c docs/site -d "$out/doctrees" -W --keep-going -q \
  "$source" "$out/html"
# Debian's build of the theme asks a web server for a style sheet, and its script imports another one, which no browser
# does in a plain script.
static=$out/html/_static
cp /usr/share/javascript/normalize.css/normalize.css "$static/"
sed -i 's|@import url(/javascript/normalize.css/normalize.css)|@import url(../normalize.css)|' "$static/styles/furo.css"
if grep -q '^import Gumshoe' "$static/scripts/furo.js"; then
  { cat "$static/scripts/gumshoe-patched.js"; sed '/^import Gumshoe/d' "$static/scripts/furo.js"; } > "$out/furo.js"
  mv "$out/furo.js" "$static/scripts/furo.js"
fi
# What a page loads must stand beside it; links that a reader follows may lead out.
if grep -rlE '(src|srcset)="https?:|<link[^>]+(stylesheet|icon)[^>]+https?:|@import[^;]*https?:' "$out/html" \
  --include='*.html' --include='*.css' | grep -v /mathjax/; then
  echo "docs: the pages above load something from the network" >&2
  exit 1
fi
echo "docs: $(find "$out/html" -name '*.html' | wc -l) pages, $(du -sh "$out/html" | cut -f1): $out/html/index.html"
