#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# includes_test.sh on a copy in which one room includes one below it: it must say which.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/src"
cp "$1/CMakeLists.txt" "$work/"
mkdir "$work/apps"
cp -r "$1/apps/hyperex" "$work/apps/"
cp -r "$1/src/hyperex" "$work/src/"
echo '#include "hyperex/scene/scene.hpp"' >> "$work/src/hyperex/io/scan.cpp"
echo '#include "hyperex/simulate/run/simulator.hpp"' >> "$work/src/hyperex/simulate/drive/drive.cpp"
echo '#include "hyperex/run/run_scene.hpp"' >> "$work/src/hyperex/session/inputs.cpp"
said=$("$1/tests/layout/includes_test.sh" "$work") && { echo "an upward include is not seen"; exit 1; }
echo '#include "hyperex/hyperex.hpp"' >> "$work/src/hyperex/io/ply.cpp"
said+=$("$1/tests/layout/includes_test.sh" "$work") && { echo "an include of everything is not seen"; exit 1; }
grep -q 'src/hyperex/io/ply.cpp.*hyperex.hpp' <<< "$said" || { echo "an include of everything is not reported"; exit 1; }
grep -q '^simulate/drive may include only: drive$' <<< "$said" || { echo "an upward include among parts is not reported"; exit 1; }
grep -q 'src/hyperex/session/inputs.cpp' <<< "$said" || { echo "an include of run by session is not reported"; exit 1; }
grep -q 'src/hyperex/io/scan.cpp' <<< "$said" && grep -q '^io may include only: core geometry io$' <<< "$said"
