#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What the examples write, opened by the programs it is for: Debian's ParaView, VTK's readers and
# Blender, Khronos' validator, and the rules of 3D Slicer's markups.
#   tests/interop/run.sh PROGRAM [EXAMPLE...]     default: a run with variants and all examples
set -euo pipefail
program=$(realpath "$1")
shift
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source=$(cd "$here/../.." && pwd)
for tool in pvpython blender python3 node; do
  command -v "$tool" > /dev/null ||
    { echo "interop: there is no $tool; scripts/setup.sh --interop installs it" >&2; exit 1; }
done
[[ -d "$source/web/node_modules/gltf-validator" ]] ||
  { echo "interop: there is no glTF validator; npm ci in web/ installs it" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export QT_QPA_PLATFORM=offscreen
SECONDS=0

quiet() {  # what a command says, only where it fails
  "$@" > "$work/log" 2>&1 || { tail -30 "$work/log" >&2; echo "interop: FAILED: $*" >&2; exit 1; }
}

echo "interop: $("$program" --version | head -n 1)"
echo "interop: glTF validator $(node -p "require('$source/web/node_modules/gltf-validator/package.json').version")"

# Every model of a run: the base and its variants.
models() { find "$1" -name performance.glb -print0; }

look_at() {  # RUN
  local run=$1
  if [[ -e "$run/frames.pvd" ]]; then
    pvpython "$here/paraview_frames.py" "$run"
  else
    echo "paraview: the scene writes no frames"
  fi
  pvpython "$here/vtk_readers.py" "$run"
  quiet blender -b --factory-startup --python "$here/blender_glb.py" -- "$run"
  grep '^blender:' "$work/log"
  while IFS= read -r -d '' glb; do
    (cd "$source/web" && GLB=$glb quiet node --test tests/glb.test.mjs)
    echo "validator: no errors and no warnings in ${glb#"$work/"}"
  done < <(models "$run")
  # Landmarks go to 3D Slicer and come back.
  quiet "$program" landmarks "$run/skin_peak.ply" --unit mm --out "$work/found.mrk.json"
  python3 "$here/slicer_markups.py" "$work/found.mrk.json"
  printf 'scan = { file = "%s", landmarks = "%s" }\nmotion.file = "embedded"\n' \
    "$run/skin_peak.ply" "$work/found.mrk.json" > "$work/back.toml"
  quiet "$program" check "$work/back.toml"
}

if (($# == 0)); then
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
  quiet "$program" run "$work/scene.toml" --out "$work/run"
  mv "$work/run" "$work/moved and renamed"  # as people do
  look_at "$work/moved and renamed"
  for file in "$source"/examples/*.toml; do
    name=$(basename "$file" .toml)
    [[ "$name" == study ]] || set -- "$@" "$name"  # its cases write tables
  done
fi

quiet python3 "$source/tests/examples/run_example.py" "$program" "$source/examples" "$work/examples" --prepare
for name in "$@"; do
  echo "interop: $name"
  quiet python3 "$source/tests/examples/run_example.py" "$program" "$source/examples" "$work/examples" "$name" --full
  look_at "$work/examples/out/$name"
  rm -rf "$work/examples/out/$name"
done
echo "interop: all open in $SECONDS s"
