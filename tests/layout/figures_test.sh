#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# scripts/figures.py finds every figure of docs/how_good.md, and sees one that was changed, a command that nobody has, and
# a page that states another figure than tests/golden keeps of a run.
#   figures_test.sh SOURCE_FOLDER
set -euo pipefail
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
cp -r "$1/scripts" "$1/docs" "$1/Makefile" "$1/README.md" "$tree/"
mkdir -p "$tree/tests"
cp -r "$1/tests/golden" "$tree/tests/"
python3 "$tree/scripts/figures.py"
sed -i 's|4\.26 / 12\.68 |4.26 / 12.69 |' "$tree/docs/how_good.md"
! python3 "$tree/scripts/figures.py" > "$tree/said" 2>&1 || { echo "a changed figure is not seen"; exit 1; }
grep -q "how_good.md:[0-9]*: 12.69 does not stand in fidelity.md" "$tree/said" || { cat "$tree/said"; exit 1; }
sed -i 's|4\.26 / 12\.69 |4.26 / 12.68 |; s|0\.62 / 0\.44|0.61 / 0.44|' "$tree/docs/how_good.md"
! python3 "$tree/scripts/figures.py" > "$tree/said" 2>&1 || { echo "a changed figure that stands elsewhere is not seen"; exit 1; }
grep -q "how_good.md:[0-9]*: 0.61 / 0.44 does not stand together in muscles.md" "$tree/said" || { cat "$tree/said"; exit 1; }
sed -i 's|0\.61 / 0\.44|0.62 / 0.44|; s|`make muscles`|`muscle_bench`|' "$tree/docs/how_good.md"
! python3 "$tree/scripts/figures.py" > "$tree/said" 2>&1 || { echo "a command that nobody has is not seen"; exit 1; }
grep -q "how_good.md:[0-9]*: nobody can type muscle_bench" "$tree/said" || { cat "$tree/said"; exit 1; }
sed -i 's|`muscle_bench`|`make muscles`|' "$tree/docs/how_good.md"
python3 "$tree/scripts/figures.py"
sed -i 's|has 0\.55 times|has 0.58 times|' "$tree/README.md"
! python3 "$tree/scripts/figures.py" > "$tree/said" 2>&1 || { echo "a changed figure of README is not seen"; exit 1; }
grep -q "README.md: 0.58 is 0.55 in how_good.md" "$tree/said" || { cat "$tree/said"; exit 1; }
sed -i 's|0\.58 times|0.55 times|; s|bulges by 1\.7 mm|bulges by 1.74 mm|' "$tree/README.md"
! python3 "$tree/scripts/figures.py" > "$tree/said" 2>&1 || { echo "a figure that README alone has is not seen"; exit 1; }
grep -q "README.md:[0-9]*: 1.74 does not stand in how_good.md" "$tree/said" || { cat "$tree/said"; exit 1; }
cp "$1/README.md" "$tree/"
sed -i '/"variants: stiff right cheek: added_xi_floor"/,/"value"/s|"value": [0-9.]*|"value": 0.0008|' "$tree/tests/golden/demo_summary.json"
! python3 "$tree/scripts/figures.py" > "$tree/said" 2>&1 || { echo "a page that went stale is not seen"; exit 1; }
grep -q "symmetry.md: 3.3 (default), stiff right cheek: .* keeps [0-9.]*, 0.0008" "$tree/said" || { cat "$tree/said"; exit 1; }
cp "$1/tests/golden/demo_summary.json" "$tree/tests/golden/"
sed -i 's/^| 3\.3 (default) |/| 3.4 |/' "$tree/docs/symmetry.md"
! python3 "$tree/scripts/figures.py" > "$tree/said" 2>&1 || { echo "a row that is gone is not seen"; exit 1; }
grep -q "symmetry.md: no row 3.3 (default)" "$tree/said" || { cat "$tree/said"; exit 1; }
