#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what building Hyperex takes on Debian 12: Debian packages, then the npm packages of web/.
#   scripts/setup.sh           to build and run
#   scripts/setup.sh --tests   also a browser for the browser tests and CalculiX to compare with
#   scripts/setup.sh --bench   also what measuring takes: Google Benchmark, matplotlib, CalculiX
# Says first what it will install, installs only what is missing, and is quick when nothing is.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

packages=(
  g++ cmake ninja-build ccache make pkg-config git ca-certificates
  libeigen3-dev            # small dense and sparse matrices
  libsuitesparse-dev       # CHOLMOD: the sparse factorisation
  libopenblas-dev libmetis-dev
  libcgal-dev              # remeshing, subdivision, filling of holes
  libembree-dev libtbb-dev # rays and closest points; threads
  libtinygltf-dev libtinyobjloader-dev libstb-dev zlib1g-dev
  libtomlplusplus-dev libcli11-dev libspdlog-dev libfmt-dev nlohmann-json3-dev
  libopencv-dnn-dev libflatbuffers-dev flatbuffers-compiler  # the landmark networks
  libcairo2-dev fonts-dejavu-core  # pictures with words on them
  libopencv-core-dev libopencv-imgproc-dev libturbojpeg0-dev libpng-dev  # pictures of recordings
  libopencv-videoio-dev libopencv-imgcodecs-dev  # video files and webcams; pictures of tests
  libfreenect-dev libopenni2-dev   # depth cameras
  libgtest-dev libgmock-dev
)

say() { printf 'setup: %s\n' "$*"; }
die() { printf 'setup: %s\n' "$*" >&2; exit 1; }

case "${1:-}" in
  '') ;;
  --tests)
    packages+=(calculix-ccx)
    [[ -n "${CHROMIUM:-}" && -x "${CHROMIUM:-}" ]] || packages+=(chromium)
    ;;
  --bench) packages+=(libbenchmark-dev python3-matplotlib calculix-ccx) ;;
  -h | --help) sed -n '3,8s/^# \{0,1\}//p' "$0"; exit 0 ;;
  *) die "unknown option $1 (there are --tests and --bench)" ;;
esac

node_is_enough() {
  command -v node > /dev/null && command -v npm > /dev/null &&
    [[ "$(node -p 'process.versions.node.split(".")[0]' 2> /dev/null || echo 0)" -ge 18 ]]
}
node_is_enough || packages+=(nodejs npm)

command -v dpkg-query > /dev/null && command -v apt-get > /dev/null ||
  die "this needs Debian's apt-get; elsewhere install by hand: ${packages[*]}; then run npm ci in web/"

# One call for all packages; those that are not installed have no "installed" behind their name.
# dpkg-query ends with 1 as soon as it does not know one of them: on a fresh machine that is the rule.
installed=" $({ dpkg-query -W -f '${binary:Package} ${db:Status-Status}\n' "${packages[@]}" 2> /dev/null || true; } |
  sed -n 's/^\([^ :]*\)[^ ]* installed$/\1/p' | tr '\n' ' ') "
missing=()
for package in "${packages[@]}"; do
  [[ "$installed" == *" $package "* ]] || missing+=("$package")
done

if ((${#missing[@]})); then
  as_root=()
  if ((EUID != 0)); then
    command -v sudo > /dev/null ||
      die "these Debian packages are missing: ${missing[*]}. You are not root and there is no sudo: ask an administrator to run apt-get install --no-install-recommends ${missing[*]}"
    as_root=(sudo)
  fi
  say "will install these Debian packages${as_root[*]:+ with sudo}: ${missing[*]}"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install --yes --no-install-recommends "${missing[@]}" ||
    die "apt-get could not install them (its message is above)"
fi
node_is_enough || die "Node 18 or later and npm are needed; found $(node --version 2> /dev/null || echo none)"

# npm ci begins by deleting node_modules: only when the wanted versions have changed.
lock=web/package-lock.json
stamp=web/node_modules/.installed-package-lock.json
if ! cmp -s "$lock" "$stamp"; then
  say "will install the npm packages of web/ into web/node_modules"
  (cd web && npm ci --no-audit --no-fund)
  cp "$lock" "$stamp"
fi
say "everything is installed"
