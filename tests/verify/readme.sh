#!/usr/bin/env bash
# readme.sh [RELEASE]: executes the code of README.md and of the tutorials literally and in order, in a fresh
# minimal Debian system (bookworm by default, or trixie) in a chroot, as a user who is not root but may use sudo. Also blocks that the
# tests do not execute, as far as a machine can. Prints the time of each block. An hour. Needs root for mount and chroot.
set -euo pipefail
project=$(readlink -f "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../..")
release=${1:-bookworm}
root=$project/build/verify/$release

((EUID == 0)) || { echo "readme.sh: needs root for mount and chroot; run it with sudo" >&2; exit 1; }
rm -rf "$root"
"$project/tests/debian_system.sh" "$release"
# What the README assumes: git, a clone, a user with sudo. python3 is for the program that executes the blocks.
"$project/tests/chroot.sh" "$root" bash -euc '
  export DEBIAN_FRONTEND=noninteractive
  apt-get -qq update
  apt-get -qq -y install --no-install-recommends git sudo python3-minimal >/dev/null
  useradd --create-home --shell /bin/bash student
  echo "student ALL=(ALL) NOPASSWD: ALL" >/etc/sudoers.d/student
  cp -r /srv/robosim /home/student/robosim
  chown -R student: /home/student/robosim'
pages=(README.md doc/tutorials/*.md)
cd "$project"
for page in "${pages[@]}"; do
  [[ $page != doc/tutorials/README.md ]] || continue
  # shellcheck disable=SC2016  # expanded by the shell in the chroot
  "$project/tests/chroot.sh" "$root" su - student -c '
    cd robosim
    folder=$PWD
    [[ $0 == README.md ]] || { folder=$(mktemp -d); export PATH=$HOME/.local/bin:$PATH; }
    exec python3 -B tests/tutorials/run_tutorial.py --everything "$0" "$folder"' "$page"
done
