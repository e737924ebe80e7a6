#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The programs of examples/cpp, from an empty folder and with the installed package alone.
#   examples_test.sh SOURCE_FOLDER PREFIX RUN_OF_THE_DEMO
set -euo pipefail
source=$1 prefix=$2 demo=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp -r "$source/examples/cpp" "$work/programs"
cd "$work"
said() { echo "$*"; exit 1; }
for program in programs/*.cpp; do
  (($(wc -l < "$program") <= 40)) || said "$program has more than 40 lines"
done
build() {  # FOLDER FLAGS
  cmake -G Ninja -S programs -B "$1" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror $2" \
    > "$1.log" 2>&1 && cmake --build "$1" "${@:3}" >> "$1.log" 2>&1 || { cat "$1.log"; exit 1; }
}
build build ""
for program in programs/*.cpp; do  # those that are run below
  [[ " first_run finite_strain own_mesh stiffness_sweep what_if " == *" $(basename "$program" .cpp) "* ]] || said "$program is not run here"
done
build/first_run > first.txt 2> /dev/null
build/stiffness_sweep > sweep.csv
build/own_mesh > own.txt
build/finite_strain > finite.txt
build/what_if "$source/examples/mouth_open.toml" tissue.young_kpa 300 after.glb > what_if.txt
build/what_if "$source/examples/stiff_cheek.toml" "tissue.region[0].young_factor" 1 cheek.glb > cheek.txt
"$prefix/bin/hyperex" sample sample > sample.txt
build/what_if sample/second_face.ply "$demo/motion.csv" tissue.young_kpa 300 second.glb > second.txt
cat first.txt sweep.csv cheek.txt second.txt

# The same numbers as those of `hyperex run examples/mouth_open.toml`.
read -r left right < <(awk -F, '$1 == "cheilion" { printf "%.2f %.2f\n", $2, $3 }' "$demo/excursions.csv")
grep -qx "excursion of the corners: left $left mm, right $right mm" first.txt ||
  said "the program's corners travel $left and $right mm"
grep -qx "base: corners of the mouth left $left mm, right $right mm" what_if.txt ||
  { cat what_if.txt; said "the session's corners do not travel $left and $right mm"; }
[[ $(wc -l < what_if.txt) == 2 && -s after.glb ]] || said "the session gave no second face"
for pair in cheek second; do
  [[ $(sed 's/.*: //' $pair.txt | sort -u | wc -l) == 2 && -s $pair.glb ]] ||
    said "the session's change of the $pair's face changes nothing"
done
# Five rows; stiffer tissue does not give the same.
[[ $(wc -l < sweep.csv) == 6 ]] || said "the sweep is not whole"
[[ $(tail -n +2 sweep.csv | cut -d, -f2 | sort -u | wc -l) == 5 ]] || said "stiffness changes nothing"
# The bar's middle is symmetric: its mean is half of what its end is moved by.
awk '$2 ~ /^(8|9|10|11):$/ { x += $3; y += $4 } END { exit !(x / 4 > 0.999 && x / 4 < 1.001 && y * y < 1e-8) }' own.txt ||
  { cat own.txt; said "the middle of the bar is moved by another length"; }
# A bar of E = 15 kPa and 1 cm^2, half as long again by yeoh's law (c20 0.47): free sideways it takes
# 0.82 N, and more with its ends held. Let go, it swings back to where it was.
awk 'NR == 1 { f = $3 } END { exit !(f > 0.82 && f < 1.2 && NR == 6 && $3 * $3 < 0.1) }' finite.txt ||
  { cat finite.txt; said "the bar is not pulled as its law has it, or does not come back"; }

# Instructions of this very processor, as many programs are built: Eigen then aligns otherwise.
build native "-march=native" --target own_mesh
native/own_mesh > native.txt || said "a program that is built with -march=native ends badly"
cmp own.txt native.txt
