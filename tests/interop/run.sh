#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What a run writes, opened by the programs it is for: Debian's ParaView and Blender, and by the
# rules of 3D Slicer's markups. tests/interop/run.sh PROGRAM
set -euo pipefail
program=$(realpath "$1")
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
for tool in pvpython blender python3; do
  command -v "$tool" > /dev/null ||
    { echo "interop: there is no $tool; scripts/setup.sh --interop installs it" >&2; exit 1; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export QT_QPA_PLATFORM=offscreen

cat > "$work/scene.toml" << 'SCENE'
title = "Interoperation"
scan.file = "embedded"
motion.file = "embedded"
mesh.element_size_mm = 5
output.report = false
[[variant]]
name = "stiff right cheek"
tissue = { region = [{ name = "cheek_R", young_factor = 5 }] }
SCENE
"$program" run "$work/scene.toml" --out "$work/run" > "$work/log" 2>&1 ||
  { cat "$work/log" >&2; exit 1; }
mv "$work/run" "$work/moved and renamed"  # as people do

run="$work/moved and renamed"
pvpython "$here/paraview_frames.py" "$run"
blender -b --factory-startup --python "$here/blender_glb.py" -- "$run" > "$work/log" 2>&1 ||
  { tail -20 "$work/log" >&2; exit 1; }
grep '^blender:' "$work/log"

# Landmarks go to 3D Slicer and come back.
"$program" landmarks "$run/skin_peak.ply" --out "$work/found.mrk.json" > "$work/log" 2>&1 ||
  { cat "$work/log" >&2; exit 1; }
python3 "$here/slicer_markups.py" "$work/found.mrk.json"
printf 'scan = { file = "%s", landmarks = "%s" }\nmotion.file = "embedded"\n' \
  "$run/skin_peak.ply" "$work/found.mrk.json" > "$work/back.toml"
"$program" check "$work/back.toml" > "$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
echo "interop: all open"
