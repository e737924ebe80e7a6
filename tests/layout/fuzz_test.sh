#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The fuzzers' readers (tests/fuzz/CMakeLists.txt) are built without most rooms. What the grammar of
# a scene includes must be among their sources, or they no longer link, which only `make fuzz` shows.
set -euo pipefail
cd "$1"
# Of these the grammar takes types and constants alone.
types_alone="face/complexion motion/exaggerate simulate/drive/alignment tissue/mesh/tissue_mesh"
missing=0
for header in $(grep -ohE '^#include "hyperex/[^"]+\.hpp"' src/hyperex/scene/*.[ch]pp |
                sed -E 's|.*"hyperex/(.*)\.hpp"|\1|' | sort -u); do
  case "$header" in core/*|io/*|scene/*) continue ;; esac
  [[ -f src/hyperex/$header.cpp && " $types_alone " != *" $header "* ]] || continue
  grep -qF "/$header.cpp" tests/fuzz/CMakeLists.txt && continue
  echo "src/hyperex/scene includes $header.hpp, but tests/fuzz/CMakeLists.txt lacks $header.cpp"
  missing=1
done
exit "$missing"
