#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A run is put together by session::FaceSession alone: program, studio, Python, studies and
# benchmarks call it. A further recording of an estimate is read, not run.
#   assembly_test.sh SOURCE_FOLDER
set -euo pipefail
cd "$1"
callers=(apps python bench src/hyperex/{estimate,uncertainty,rig,run,visits,study})
status=0
if grep -rnE '(^|[^_a-z])(read_inputs|prepare_face|simulation_options|obstacles_of|teeth_of|simulate_twin|prepare_variants|drive_choice|prepare_with_kept_order)\(|TissueFields' \
  "${callers[@]}" --include='*.[ch]pp' | grep -vE '^(apps/studio/session_edits.cpp:.*drive_choice|src/hyperex/estimate/further_recordings.cpp:.*read_inputs)\('; then
  echo "expected a FaceSession (session/face_session.hpp)"
  status=1
fi
# Meshes and simulators of faces that no scene describes.
allowed='^(apps/hyperex/mesh.cpp|python/tissue.cpp|python/simulator.cpp|bench/(finite|memory)_bench.cpp|bench/twins/twins.cpp|bench/muscle_bench.cpp|bench/support/face_case.[ch]pp):'
if grep -rnE '(tissue::|[^_a-z])build_tissue_mesh\(|simulate::Simulator( [a-z_]+)?\(' "${callers[@]}" \
  --include='*.[ch]pp' | grep -vE "$allowed"; then
  echo "expected FaceSession::mesh() and simulator()"
  status=1
fi
exit $status
