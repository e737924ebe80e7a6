# SPDX-License-Identifier: GPL-3.0-or-later
# Part of fresh.sh (--packages), which sources it: makes the Debian packages in one empty Debian 12 and
# uses them in another, which never sees the source tree: the program, then a C++ program, then Python,
# each with what its own package brings, as an ordinary user in an empty folder. step() runs these
# functions where `set -e` does not hold.

examples=/usr/share/doc/hyperex/examples

# What apt would take in, in its own words, then takes it in.
install_packages() {
  in_root "cd /packages && LC_ALL=C apt-get install --assume-no $* 2> /dev/null" |
    grep -E 'newly installed|^Need to get|^After this operation' | sed "s|^|packages: $1: |" || true
  in_root "cd /packages && DEBIAN_FRONTEND=noninteractive apt-get install --yes --quiet=2 $*"
}
in_root() { chroot "$root" env -i "${environment[@]}" HOME=/root bash -euo pipefail -c "$1"; }
# In an empty folder of the user's own, without this machine's caches.
visitor_does() {
  local folder=/home/visitor/$1
  chroot --userspec=visitor "$root" env -i "${environment[0]}" LANG=C.UTF-8 HOME=/home/visitor USER=visitor \
    bash -euo pipefail -c "mkdir $folder && cd $folder && $2"
}

use_program() {
  install_packages "./hyperex_*.deb" && visitor_does program "hyperex run $examples/mouth_open.toml --out mouth_open && test -s mouth_open/report.html &&
    hyperex run $examples/demo.toml --out demo | tee said && grep 'weak right zygomatic branch' said &&
    test -s /usr/share/man/man1/hyperex-run.1.gz && bash -c 'source /usr/share/bash-completion/completions/hyperex; complete -p hyperex' &&
    hyperex new embedded embedded --out mine.toml && hyperex check mine.toml"
}
use_library() {
  install_packages "./libhyperex-dev_*.deb" g++ cmake && visitor_does library "cp -r $examples/cpp . && cmake -S cpp -B build && cmake --build build &&
    build/first_run | tee said && grep 'excursion of the corners' said && build/own_mesh"
}
use_python() {
  install_packages "./python3-hyperex_*.deb" &&
    in_root 'python3 -c "import hyperex"' && # root's Python writes files beside the module
    visitor_does python "python3 -c 'import hyperex; print(hyperex.embedded_face())' &&
    python3 $examples/python/first_steps.py face.glb | tee said && grep 'corners of the mouth' said && test -s face.glb"
}
# No file of theirs may stay, nor a package that came for them.
remove_packages() {
  in_root 'export DEBIAN_FRONTEND=noninteractive
    apt-get purge --yes --quiet=2 hyperex libhyperex-dev python3-hyperex 2>&1 | tee /tmp/purged
    if grep "not removed" /tmp/purged; then exit 1; fi
    apt-mark auto g++ cmake > /dev/null
    apt-get autoremove --purge --yes --quiet=2 -o APT::AutoRemove::SuggestsImportant=false \
      -o APT::AutoRemove::RecommendsImportant=false' || return 1
  local left
  left=$(find "$root"/{etc,usr,var,opt} -xdev -path "$root/var/log" -prune -o -name '*hyperex*' -print)
  [[ -z "$left" ]] || { echo "left behind: $left"; return 1; }
  left=$(comm -13 "$work/packages_before" <(installed_packages))
  [[ -z "$left" ]] || { echo "packages left behind: $left"; return 1; }
}
installed_packages() { in_root "dpkg-query --show --showformat '\${Package}\n'" | sort; }

try_packages() {
  step "make deb" as_root "make deb"
  step "lintian" as_root "apt-get install --yes --quiet=2 --no-install-recommends lintian &&
    lintian --fail-on error build/deb/*.deb"
  mkdir "$work/packages"
  cp "$root$repository"/build/deb/*.deb "$work/packages/"
  root=$work/user_root
  mkdir "$root"
  shared_data=0
  step "an empty Debian 12 for the packages" make_root
  carry_in
  mount_in
  cp -r "$work/packages" "$root/packages"
  chroot "$root" useradd --create-home --shell /bin/bash visitor
  in_root "apt-get update" > /dev/null
  installed_packages > "$work/packages_before"
  step "the program" use_program
  step "the C++ library" use_library
  step "the Python module" use_python
  step "removed again" remove_packages
}
