#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# headers_test.sh on copies of the installed headers with a mistake each: it must say which.
#   foreign_header_test.sh PREFIX COMPILER EIGEN_FOLDER
set -euo pipefail
test=$(dirname "$0")/headers_test.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
refused() {  # LINE OF CODE, WHAT IS SAID
  rm -rf "$work/include"
  cp -r "$1/include" "$work/"
  sed -i "s|#pragma once|&\n$2|" "$work/include/hyperex/fem/form/system.hpp"
  said=$("$test" "$work" "$3" "$4" hyperex/fem/form/system.hpp 2>&1) && { echo "not seen: $2"; exit 1; }
  grep -q "$5" <<< "$said" || { echo "for $2: $said"; exit 1; }
}
refused "$1" '#include <opencv2/core.hpp>' "$2" "$3" 'system.hpp includes opencv2/core.hpp'
refused "$1" '#include "hyperex/scene/scene.hpp"' "$2" "$3" 'hyperex/scene/scene.hpp, which is not installed'
refused "$1" 'inline Lists forgotten;' "$2" "$3" 'does not compile alone: .*fem_form_system.hpp'
