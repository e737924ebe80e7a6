#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Each installed header compiles alone, with Eigen and the standard library and nothing else.
#   headers_test.sh PREFIX COMPILER EIGEN_FOLDER [HEADER ...]   compiles those named, or all
set -euo pipefail
compiler=$2 eigen=$3
cd "$1/include"
mapfile -t headers < <(find hyperex -name '*.hpp' | sort)
((${#headers[@]} > 20)) || { echo "no headers are installed"; exit 1; }

status=0
while IFS=: read -r file line; do
  name=$(sed -E 's/.*#include *[<"]([^>"]*)[>"].*/\1/' <<< "$line")
  case $name in
    hyperex/*) [[ -e $name ]] || { echo "$file includes $name, which is not installed"; status=1; } ;;
    Eigen/*) ;;
    # Headers of the standard library have neither a folder nor an extension.
    */* | *.*) echo "$file includes $name: installed headers need Eigen alone"; status=1 ;;
  esac
done < <(grep -E '^ *# *include' "${headers[@]}")
((status == 0)) || exit 1

# Where ccache is there, a header is compiled again only when it has changed.
cache=$(command -v ccache || true)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
ln -s "$PWD" "$work/include"
cd "$work"  # names that are the same each time, for the cache
(($# == 3)) || headers=("${@:4}")
for header in "${headers[@]}"; do
  echo "#include \"$header\"" > "${header//\//_}.cpp"
done
export cache compiler eigen
find . -name '*.cpp' -print0 | xargs -0 -n 1 -P "$(nproc)" bash -c '
  $cache "$compiler" -std=c++20 -O0 -Wall -Wextra -Werror -I include -isystem "$eigen" -c "$1" -o "$1.o" ||
    { echo "does not compile alone: $1"; exit 255; }' _
