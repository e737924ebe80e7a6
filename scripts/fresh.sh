#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Tries a stranger's first minutes: an empty Debian 12 (only its essential packages, apt, git, make,
# sudo and certificates), a clean clone of this commit in it, then `make demo` and `make test` as
# root and again as an ordinary user with sudo. Says what each step took, and how much is
# downloaded. Needs root.
#   scripts/fresh.sh             with this machine's caches: packages, compiled objects
#   scripts/fresh.sh --cold      as on a stranger's machine: no caches
#   scripts/fresh.sh --demo      without `make test`
#   scripts/fresh.sh --run CMD   CMD in place of each of them, to try this script
#   scripts/fresh.sh --packages  instead: `make deb`, then the packages used in another empty Debian 12
# The root stands in a folder of its own in $TMPDIR (or build/fresh), is deleted at the end, and has
# this machine's Debian sources, npm configuration and certificates. ../shared is seen read-only.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
repository=$PWD
die() { printf 'fresh: %s\n' "$*" >&2; exit 2; }

cold=0
packages=0
shared_data=1
demo="make demo"
test="make test"
for ((i = 1; i <= $#; ++i)); do
  case "${!i}" in
    --cold) cold=1 ;;
    --demo) test=true ;;
    --packages) packages=1 ;;
    --run) i=$((i + 1)); demo=${!i:?--run needs a command}; test=$demo ;;
    -h | --help) sed -n '3,13s/^# \{0,1\}//p' "$0"; exit 0 ;;
    *) die "unknown option ${!i} (there are --cold, --demo, --run and --packages)" ;;
  esac
done
[[ "$(id -u)" == 0 ]] || die "mounting and chroot need root: sudo scripts/fresh.sh"

# The work is done in a mount and process namespace of its own. Its mounts do not exist out here, so
# that deleting the root can never reach through one, and they end with it, however it ends.
if [[ -z "${FRESH_WORK:-}" ]]; then
  [[ -z "$(git status --porcelain)" ]] || echo "fresh: what is not committed is not tried" >&2
  if ! command -v mmdebstrap > /dev/null; then
    { apt-get update && DEBIAN_FRONTEND=noninteractive \
      apt-get install --yes --no-install-recommends mmdebstrap; } > /dev/null ||
      die "mmdebstrap could not be installed"
  fi
  mkdir -p build/fresh
  FRESH_WORK=$(mktemp -d "${TMPDIR:-$repository/build/fresh}/hyperex-fresh.XXXXXX")
  export FRESH_WORK
  trap 'rm -rf --one-file-system "$FRESH_WORK"' EXIT
  unshare --mount --propagation private --pid --fork --kill-child "$repository/scripts/fresh.sh" "$@" &
  inside=$!
  trap 'kill -TERM "$inside" 2> /dev/null; wait "$inside"; exit 130' INT TERM HUP
  wait "$inside"
  exit
fi

work=$FRESH_WORK
root=$work/root
log=$work/log
kept=$repository/build/fresh/cache
objects=$(ccache --get-config cache_dir 2> /dev/null || echo "$kept/objects")
mkdir -p "$root" "$kept/packages/partial" "$objects"

mounted=()
table=()
disk_mb() { du -sm "${mounted[@]/#/--exclude=}" "$root" 2> /dev/null | cut -f1; }
step() {
  local name=$1 began=$SECONDS disk
  disk=$(disk_mb)
  shift
  echo "== $name"
  "$@" 2>&1 | tee -a "$log" || { echo "== $name: failed after $((SECONDS - began)) s"; exit 1; }
  table+=("$(printf '%-30s %6d s, disk %+6d MB' "$name" $((SECONDS - began)) $(($(disk_mb) - disk)))")
}

# Not older than a day where caches may be used.
make_root() {
  local file sources=()
  for file in /etc/apt/sources.list /etc/apt/sources.list.d/debian*.{sources,list}; do
    [[ ! -s "$file" ]] || sources+=("$file")
  done
  if [[ "$cold" == 1 || -z "$(find "$kept/root.tar" -mmin -1440 2> /dev/null)" ]]; then
    mmdebstrap --quiet --variant=apt --include=ca-certificates,git,make,sudo \
      bookworm "$work/root.tar" "${sources[@]}"
    mv "$work/root.tar" "$kept/root.tar"
  fi
  tar -C "$root" --exclude=./dev/'*' -xf "$kept/root.tar"
}

carry_in() {
  local file
  cp -L /etc/resolv.conf /etc/hosts "$root/etc/"
  cp -L /etc/ssl/certs/ca-certificates.crt "$root/etc/ssl/certs/"
  for file in /etc/npmrc /usr/etc/npmrc; do
    [[ ! -f "$file" ]] || install -D -m 644 "$file" "$root$file"
  done
  [[ ! -f "$HOME/.npmrc" ]] || install -m 600 "$HOME/.npmrc" "$root/root/.npmrc"
  {
    apt-config dump | grep -E '^Acquire::(Check-|http|https|ForceIPv)' || true
    echo 'APT::Keep-Downloaded-Packages "true";'
  } > "$root/etc/apt/apt.conf.d/99fresh"
}

bind() {
  mkdir -p "$root$2"
  mount --bind "$1" "$root$2"
  mounted+=("$root$2")
}
mount_in() {
  mount -t proc proc "$root/proc"
  mount --rbind /dev "$root/dev"
  mount --bind /sys "$root/sys"
  mounted+=("$root/proc" "$root/dev" "$root/sys")
  if [[ "$cold" == 0 ]]; then
    bind "$kept/packages" /var/cache/apt/archives
    bind "$objects" /var/cache/objects
  fi
  if [[ "$shared_data" == 1 && -d "$repository/../shared" ]]; then
    local shared
    shared=$(realpath "$repository/..")/shared
    bind "$shared" "$shared"
    mount -o remount,bind,ro "$root$shared"
  fi
}

# Nothing of this machine's environment but what says where packages come from.
environment=(PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8)
for name in NODE_EXTRA_CA_CERTS SSL_CERT_FILE http_proxy https_proxy HTTP_PROXY HTTPS_PROXY no_proxy \
  NO_PROXY npm_config_registry NPM_CONFIG_REGISTRY; do
  [[ -z "${!name:-}" ]] || environment+=("$name=${!name}")
done
[[ "$cold" == 1 ]] || environment+=(CCACHE_DIR=/var/cache/objects CCACHE_MAXSIZE="$(
  ccache --get-config max_size 2> /dev/null || echo 5G)")

# At the same path as out here, so that compiled objects are found again.
clone() {
  rm -rf "${root:?}$repository"
  mkdir -p "$(dirname "$root$repository")"
  git clone --quiet --no-local "$repository" "$root$repository"
}
as_root() { chroot "$root" env -i "${environment[@]}" HOME=/root bash -c "cd $repository && $1"; }
as_user() {
  chroot --userspec=visitor "$root" env -i "${environment[@]}" HOME=/home/visitor USER=visitor \
    CCACHE_READONLY=1 CCACHE_TEMPDIR=/tmp/objects bash -c "cd $repository && $1"
}
demo_is_there() {
  [[ "$demo" != "make demo" || -s "$root$repository/out/demo/report.html" ]] ||
    die "make demo left no report"
}

finish() {
  echo
  echo "== An empty Debian 12: all passed ($([[ $cold == 1 ]] && echo 'no caches' || echo "with this machine's caches"))"
  printf '  %s\n' "${table[@]}"
  grep -E '^(packages: |setup: (now|will install the npm))' "$log" | sed 's/^setup: /  setup.sh: /; s/^packages/  packages/' || true
  echo "  the whole root: $(disk_mb) MB"
}

step "an empty Debian 12" make_root
carry_in
mount_in
clone
if [[ "$packages" == 1 ]]; then
  source "$repository/scripts/fresh_packages.sh"
  try_packages
  finish
  exit
fi
step "make demo as root" as_root "$demo"
demo_is_there
[[ "$test" == true ]] || step "make test as root" as_root "$test"
# Files that the tests leave in /tmp are root's: another machine would not have them.
find "$root/tmp" -mindepth 1 -delete

chroot "$root" useradd --create-home --groups sudo --shell /bin/bash visitor
echo 'visitor ALL=(ALL) NOPASSWD: ALL' > "$root/etc/sudoers.d/visitor"
[[ ! -f "$root/root/.npmrc" ]] || install -m 644 "$root/root/.npmrc" "$root/home/visitor/.npmrc"
chmod 755 "$root/root"  # the clone may stand in there
clone
chroot "$root" chown -R visitor:visitor "$repository"
# So that sudo has something to do.
chroot "$root" env -i "${environment[@]}" apt-get remove --yes libcli11-dev > /dev/null 2>&1 || true
step "make demo as user with sudo" as_user "$demo"
demo_is_there
[[ "$test" == true ]] || step "make test as user with sudo" as_user "$test"

finish
