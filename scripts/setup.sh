#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what building Hyperex takes on Debian 12: Debian packages, then the npm packages of web/.
#   scripts/setup.sh           to build and run
#   scripts/setup.sh --video   also to read video files and webcams and to write --preview videos
#   scripts/setup.sh --python  also to build and use the Python module
#   scripts/setup.sh --deb     also to make Debian packages (with --python)
#   scripts/setup.sh --docs    also to make the documentation's site (with --python)
#   scripts/setup.sh --tests   also what the tests take (--video, --python, a browser, CalculiX)
#   scripts/setup.sh --fuzz    also clang and libFuzzer
#   scripts/setup.sh --bench   also what measuring takes: Google Benchmark, matplotlib, CalculiX
#   scripts/setup.sh --interop  also the programs that make interop tries: ParaView, Blender, Snakemake, Slurm
#   scripts/setup.sh --lint    also clang-format, clang-tidy, gcovr and codespell (with --tests)
# Several options count together. Says first what it will install and how large it is, installs only
# what is missing, and is quick when nothing is.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

packages=(
  g++ cmake ninja-build ccache make pkg-config git ca-certificates
  libeigen3-dev            # small dense and sparse matrices
  libsuitesparse-dev       # CHOLMOD: the sparse factorisation
  libopenblas-dev libmetis-dev
  libcgal-dev              # remeshing, subdivision, filling of holes
  libboost-dev             # Beast: the server of the studio
  libembree-dev libtbb-dev # rays and closest points; threads
  libtinygltf-dev libtinyobjloader-dev libstb-dev zlib1g-dev
  libarchive-dev           # recordings that come as a zip
  libtomlplusplus-dev libcli11-dev libspdlog-dev libfmt-dev nlohmann-json3-dev
  nettle-dev               # SHA-256: what was computed before
  libopencv-dnn-dev libflatbuffers-dev flatbuffers-compiler  # the landmark networks
  libcairo2-dev fonts-dejavu-core  # pictures with words on them
  libopencv-core-dev libopencv-imgproc-dev libturbojpeg0-dev libpng-dev  # pictures of recordings
  libfreenect-dev libopenni2-dev   # depth cameras
  libinsighttoolkit5-dev   # ITK and GDCM: CTs (129 MB of disk)
)
video=(libopencv-videoio-dev)  # FFmpeg, GStreamer and GDAL: 150 packages
python=(pybind11-dev python3-dev python3-numpy)
deb=(file dpkg-dev  # what cpack asks which libraries the packages need
     help2man)      # manual pages of the help texts
docs=(python3-sphinx python3-myst-parser furo  # the site from the Markdown pages
      libjs-mathjax node-normalize.css        # its formulas and styles, without a network
      doxygen)                                # the pages of the C++ library
tests=(python3-matplotlib libgtest-dev libgmock-dev libopencv-imgcodecs-dev calculix-ccx)

say() { printf 'setup: %s\n' "$*"; }
die() { printf 'setup: %s\n' "$*" >&2; exit 1; }

for option in "$@"; do
  case "$option" in
    --video) packages+=("${video[@]}") ;;
    --python) packages+=("${python[@]}") ;;
    --deb) packages+=("${python[@]}" "${deb[@]}") ;;
    --docs) packages+=("${python[@]}" "${docs[@]}") ;;
    --tests | --lint)
      packages+=("${video[@]}" "${python[@]}" "${tests[@]}")
      [[ -n "${CHROMIUM:-}" && -x "${CHROMIUM:-}" ]] || packages+=(chromium)
      packages+=(firefox-esr xvfb)
      [[ "$option" == --tests ]] || packages+=(clang-format clang-tidy gcovr codespell)
      ;;
    --fuzz) packages+=(clang libclang-rt-14-dev) ;;
    --bench) packages+=(libbenchmark-dev python3-matplotlib calculix-ccx) ;;
    --interop)
      packages+=("${python[@]}" paraview python3-paraview blender python3-matplotlib xvfb snakemake slurm-wlm)
      ;;
    -h | --help) sed -n '3,15s/^# \{0,1\}//p' "$0"; exit 0 ;;
    *) die "unknown option $option (there are --video, --python, --deb, --docs, --tests, --fuzz, --bench, --interop and --lint)" ;;
  esac
done

node_is_enough() {
  command -v node > /dev/null && command -v npm > /dev/null &&
    [[ "$(node -p 'process.versions.node.split(".")[0]' 2> /dev/null || echo 0)" -ge 18 ]]
}
node_is_enough || packages+=(nodejs npm)  # npm: 350 small packages, 15 MB to download

command -v dpkg-query > /dev/null && command -v apt-get > /dev/null ||
  die "this needs Debian's apt-get; elsewhere install by hand: ${packages[*]}; then run npm ci in web/"

as_root() {
  if [[ "$(id -u)" == 0 ]]; then "$@"; else sudo "$@"; fi
}

# What apt would load and take, in its own figures; what was measured on an empty Debian 12 where it
# does not say. Needs neither root nor a lock.
sizes_of() {
  local told
  told=$(LC_ALL=C apt-get --assume-no -o Debug::NoLocking=1 install --no-install-recommends "$@" \
    2> /dev/null || true)
  local count load disk
  count=$(sed -n 's/.* \([0-9]*\) newly installed.*/\1/p' <<< "$told")
  load=$(sed -n 's/^Need to get \(.*\) of archives.*/\1/p' <<< "$told")
  disk=$(sed -n 's/^After this operation, \(.*\) of additional disk space.*/\1/p' <<< "$told")
  if [[ -n "$count" && -n "$load" && -n "$disk" ]]; then
    echo "$count Debian packages with all that they need: $load to download, $disk of disk"
  else
    echo "about 620 Debian packages: 250 MB to download, 1.3 GB of disk (tests: 890, 560 MB, 2.4 GB)"
  fi
}

install_debian_packages() {
  if [[ "$(id -u)" != 0 ]] && ! command -v sudo > /dev/null; then
    die "these Debian packages are missing: $*. You are not root and there is no sudo: ask an administrator to run apt-get install --no-install-recommends $*"
  fi
  local how=""
  [[ "$(id -u)" == 0 ]] || how=" with sudo"
  say "will install these Debian packages$how: $*"
  say "first the current package lists (about 16 MB)"
  as_root env DEBIAN_FRONTEND=noninteractive apt-get update ||
    die "apt-get could not load the package lists (its message is above)"
  say "now $(sizes_of "$@")"
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install --yes --no-install-recommends "$@" ||
    die "apt-get could not install them (its message is above)"
}

# One call for all packages; those that are not installed have no "installed" behind their name.
# dpkg-query ends with 1 as soon as it does not know one of them: on a fresh machine that is the rule.
installed=" $({ dpkg-query -W -f '${binary:Package} ${db:Status-Status}\n' "${packages[@]}" 2> /dev/null || true; } |
  sed -n 's/^\([^ :]*\)[^ ]* installed$/\1/p' | tr '\n' ' ') "
missing=()
for package in "${packages[@]}"; do
  [[ "$installed" == *" $package "* ]] || missing+=("$package")
done
((${#missing[@]} == 0)) || install_debian_packages "${missing[@]}"
node_is_enough || die "Node 18 or later and npm are needed; found $(node --version 2> /dev/null || echo none)"

# npm writes its cache and its log into HOME, which a service or a container may not have.
if [[ ! -w "${HOME:-/nowhere}" && -z "${NPM_CONFIG_CACHE:-}${npm_config_cache:-}" ]]; then
  export NPM_CONFIG_CACHE=$PWD/build/npm-cache
fi

# npm ci begins by deleting node_modules: only when the wanted versions have changed.
lock=web/package-lock.json
stamp=web/node_modules/.installed-package-lock.json
if ! cmp -s "$lock" "$stamp"; then
  say "will install the npm packages of web/ into web/node_modules (about 65 MB to download, 110 MB of disk)"
  (cd web && npm ci --no-audit --no-fund)
  cp "$lock" "$stamp"
fi
say "everything is installed"
