#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Configures a project that takes this tree in with add_subdirectory.
#   subproject_test.sh SOURCE_FOLDER all|fem
set -euo pipefail
source=$1 components=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
hidden=()
if [[ $components == fem ]]; then
  for package in OpenCV CGAL embree nlohmann_json PkgConfig PNG TinyGLTF tinyobjloader CLI11 FlatBuffers GTest ITK; do
    hidden+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
  done
fi
cmake -G Ninja -S "$(dirname "$0")/parent" -B "$work/build" -DHYPEREX="$source" \
  -DHYPEREX_COMPONENTS="$components" "${hidden[@]}" > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
# The solver alone needs neither Node nor the libraries that read pictures.
if [[ $components == fem ]] && grep -E '^(NODE|FLATC|OpenCV_|CAIRO|TURBOJPEG)' "$work/build/CMakeCache.txt"; then
  echo "looked for, though only the solver is wanted"
  exit 1
fi
# `cmake --install` of that project installs that project alone.
! grep -rq 'hyperexConfig' "$work/build" --include=cmake_install.cmake ||
  { echo "the package would be installed with the other project"; exit 1; }
