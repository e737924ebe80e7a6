#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs a build part by part and looks at what lies where.
#   package_test.sh BUILD_FOLDER PREFIX
set -euo pipefail
build=$1 prefix=$2
rm -rf "$prefix"
said() { echo "$*"; exit 1; }
for component in program library dev; do
  cmake --install "$build" --prefix "$prefix" --component "$component" > "$build/install_$component.log" ||
    { cat "$build/install_$component.log"; said "component $component cannot be installed"; }
  case $component in
    program)
      "$prefix/bin/hyperex" --version > /dev/null
      [[ ! -e "$prefix/include" ]] || said "headers with the program"
      # A user's copy, with the data that the examples' comments say to make.
      copy=$(mktemp -d)
      trap 'rm -rf "$copy"' EXIT
      cp -r "$prefix/share/doc/hyperex/examples" "$copy/"
      (cd "$copy" && "$prefix/bin/hyperex" sample out/sample > "$build/install_check.log" 2>&1) ||
        { cat "$build/install_check.log"; said "no sample data"; }
      for scene in "$copy"/examples/*.toml; do
        "$prefix/bin/hyperex" check "$scene" > "$build/install_check.log" 2>&1 ||
          { cat "$build/install_check.log"; said "$scene names what is not installed"; }
      done ;;
    library) [[ -z "$(find "$prefix" -name '*.hpp' -o -name 'libhyperex*.so')" ]] || said "parts of dev with the library" ;;
  esac
done
library=$(dirname "$(find "$prefix" -name libhyperex.so)")
[[ -e "$library/libhyperex_fem.so" && -e "$library/cmake/hyperex/hyperexConfig.cmake" ]] || said "dev is not whole"

[[ -s "$prefix/share/doc/hyperex/examples/cpp/first_run.cpp" && -s "$prefix/share/doc/hyperex/copyright" ]] ||
  said "examples or licence are missing"

# One copy of everything: an error thrown in one library is caught as the same type in the other.
exported() { nm -D --defined-only "$library/$1" | awk '$2 ~ /[TBD]/ { print $3 }' | sort; }
both=$(comm -12 <(exported libhyperex.so) <(exported libhyperex_fem.so))
[[ -z "$both" ]] || said "in both libraries: $both"
# Nothing leaks that another program might hold in another version.
foreign=$(exported libhyperex.so | grep -v '^_ZN\?K\?[A-Z]*N\?K\?7hyperex' || true)
[[ -z "$foreign" ]] || said "exported besides hyperex:: $foreign"
# The solver stands alone.
! readelf -d "$library/libhyperex_fem.so" | grep -E 'NEEDED.*(opencv|embree|cairo|png|libhyperex\.so)' ||
  said "libhyperex_fem needs more than the solver does"
