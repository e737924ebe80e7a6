#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Scores tracking on recordings with truth and writes a page: bench/tracking/run.sh BUILD PAGE
# The folder HYPEREX_DATA (../shared/data) holds rgbd/, ict/, real/ and candide/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
commit=$(git rev-parse --short HEAD 2> /dev/null || echo unknown)
[[ -z "$(git status --porcelain -- src bench 2> /dev/null)" ]] ||
  commit+=" and changes not committed"
processor=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)
exec "$1/bin/tracking_scores_study" --data "${HYPEREX_DATA:-../shared/data}" --out "$2" \
  --commit "$commit" --machine "On $(date +%F), $processor, $(nproc) cores" "${@:3}"
