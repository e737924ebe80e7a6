#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# scripts/setup.sh on a machine that has nothing: an empty package database, and only the commands
# put into one folder on the path. apt-get, sudo, id, node and npm are stand-ins that write down how
# they were called.
#   setup_test.sh SOURCE_FOLDER CASE
set -euo pipefail
source_folder=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/bin" "$work/dpkg" "$work/tree/web" "$work/home"
cp -r "$source_folder/scripts" "$work/tree/"
cp "$source_folder/web/package-lock.json" "$work/tree/web/"
: > "$work/dpkg/status"
: > "$work/log"
export DPKG_ADMINDIR=$work/dpkg LOG=$work/log

fail() {
  printf 'FAILED: %s\n--- printed:\n' "$*" >&2
  cat "$work/printed" "$work/log" >&2
  exit 1
}
for tool in bash env sed tr cp cmp dirname mkdir rm cat chmod dpkg-query; do
  ln -s "$(command -v "$tool")" "$work/bin/$tool"
done
stand_in() {
  { printf '#!%s\n' "$(command -v bash)"; cat; } > "$work/bin/$1"
  chmod +x "$work/bin/$1"
}
# Prints what apt prints; both what setup.sh prints and the calls stand in one file, in their order.
stand_in apt-get << 'END'
echo "CALL apt-get $*" >> "$LOG"
[[ " $* " == *" --assume-no "* ]] || exit 0
echo "0 upgraded, 264 newly installed, 0 to remove and 0 not upgraded."
echo "Need to get 232 MB of archives."
echo "After this operation, 1173 MB of additional disk space will be used."
exit 1
END
stand_in sudo <<< 'echo "CALL sudo $*" >> "$LOG"; "$@"'
stand_in node <<< 'echo 18'
stand_in npm <<< 'echo "CALL npm $* with cache ${NPM_CONFIG_CACHE:-of HOME}" >> "$LOG"; mkdir -p node_modules'
stand_in id <<< 'echo 0'
as_ordinary_user() { stand_in id <<< 'echo 1000'; }

run_setup() {
  status=0
  (cd "$work/tree" && env -i PATH="$work/bin" HOME="${home-$work/home}" LOG="$LOG" \
    DPKG_ADMINDIR="$DPKG_ADMINDIR" bash scripts/setup.sh "$@") >> "$work/log" 2>&1 || status=$?
  : > "$work/printed"
}
expect() { grep -qF -- "$1" "$work/log" || fail "expected: $1"; }
expect_not() { ! grep -qF -- "$1" "$work/log" || fail "not expected: $1"; }
# In this order.
expect_before() {
  local first second
  first=$(grep -nF -- "$1" "$work/log" | head -1 | cut -d: -f1)
  second=$(grep -nF -- "$2" "$work/log" | head -1 | cut -d: -f1)
  [[ -n "$first" && -n "$second" && "$first" -lt "$second" ]] || fail "expected $1 before $2"
}
# Every package that the script names reaches the one call that installs.
expect_all_packages() {
  local call named package
  call=$(grep -E '^CALL apt-get install' "$work/log") || fail "nothing is installed"
  named=$(sed -n '/^packages=(/,/^)/p' "$work/tree/scripts/setup.sh" | sed '1d;$d;s/#.*//')
  [[ $(wc -w <<< "$named") -gt 30 ]] || fail "the list of packages is not found"
  for package in $named "$@"; do
    [[ " $call " == *" $package "* ]] || fail "$package is not installed"
  done
}

case "$2" in
  root)
    run_setup
    [[ $status == 0 ]] || fail "status $status"
    expect_all_packages
    expect_not "CALL sudo"
    expect_not "libopencv-videoio-dev"
    expect_not "pybind11-dev"
    expect_before "264 Debian packages with all that they need: 232 MB to download, 1173 MB of disk" \
      "CALL apt-get install"
    expect_before "CALL apt-get update" "CALL apt-get --assume-no"
    expect "CALL npm ci"
    expect "with cache of HOME"
    ;;
  tests)
    run_setup --tests
    [[ $status == 0 ]] || fail "status $status"
    expect_all_packages libopencv-videoio-dev libopencv-imgcodecs-dev libgtest-dev chromium \
      pybind11-dev python3-numpy python3-matplotlib
    ;;
  video)
    run_setup --video
    [[ $status == 0 ]] || fail "status $status"
    expect_all_packages libopencv-videoio-dev
    expect_not libgtest-dev
    ;;
  python)
    run_setup --python
    [[ $status == 0 ]] || fail "status $status"
    expect_all_packages pybind11-dev python3-dev python3-numpy
    expect_not libgtest-dev
    ;;
  deb)
    run_setup --deb
    [[ $status == 0 ]] || fail "status $status"
    expect_all_packages pybind11-dev file dpkg-dev
    expect_not libgtest-dev
    ;;
  docs)
    run_setup --docs
    [[ $status == 0 ]] || fail "status $status"
    expect_all_packages pybind11-dev python3-sphinx python3-myst-parser furo libjs-mathjax doxygen
    expect_not libgtest-dev
    ;;
  several)  # options: all of them count
    run_setup --video --fuzz
    [[ $status == 0 ]] || fail "status $status"
    expect_all_packages libopencv-videoio-dev clang
    expect_not libgtest-dev
    run_setup --fuzz --nonsense
    [[ $status == 1 ]] || fail "status $status"
    expect "unknown option --nonsense"
    ;;
  sudo)
    as_ordinary_user
    run_setup
    [[ $status == 0 ]] || fail "status $status"
    expect_all_packages
    expect "CALL sudo env DEBIAN_FRONTEND=noninteractive apt-get install"
    expect_not "CALL sudo npm"
    ;;
  neither)
    as_ordinary_user
    rm "$work/bin/sudo"
    run_setup
    [[ $status == 1 ]] || fail "status $status"
    expect "You are not root and there is no sudo: ask an administrator to run apt-get install"
    expect_not "CALL"
    ;;
  silent_apt)  # which says no sizes
    stand_in apt-get <<< 'echo "CALL apt-get $*" >> "$LOG"'
    run_setup
    [[ $status == 0 ]] || fail "status $status"
    expect_before "to download" "CALL apt-get install"
    ;;
  failing_apt)
    stand_in apt-get <<< '[[ " $* " != *" install "* ]]'
    run_setup
    [[ $status == 1 ]] || fail "status $status"
    expect "apt-get could not install them"
    expect_not "CALL npm"
    ;;
  no_home)
    home=/nowhere
    run_setup
    [[ $status == 0 ]] || fail "status $status"
    expect "with cache $work/tree/build/npm-cache"
    ;;
  no_npm)  # it is installed where there is none, and only there
    rm "$work/bin/npm"
    run_setup
    [[ $status == 1 ]] || fail "status $status"  # the stand-in installs nothing
    expect_all_packages nodejs npm
    expect "Node 18 or later and npm are needed"
    ;;
  nothing_missing)  # the second time it installs nothing
    {
      for package in $(sed -n '/^packages=(/,/^)/p' "$work/tree/scripts/setup.sh" | sed '1d;$d;s/#.*//'); do
        printf 'Package: %s\nStatus: install ok installed\nArchitecture: amd64\nMaintainer: x\nVersion: 1\nDescription: x\n\n' "$package"
      done
    } > "$work/dpkg/status"
    run_setup
    [[ $status == 0 ]] || fail "status $status"
    expect_not "CALL apt-get"
    ;;
  *) echo "unknown case $2" >&2; exit 2 ;;
esac
echo "ok: $2"
