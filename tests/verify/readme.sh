#!/usr/bin/env bash
# readme.sh [RELEASE]: executes the code of README.md, of the tutorials, and of the first section with code of every other page in doc/,
# literally and in order, in a fresh minimal Debian system (bookworm by default, or trixie) in a chroot, as a user who is not root but may
# use sudo. Also blocks that the tests do not execute, as far as a machine can. Prints the time of each block, and all failures at the end.
# An hour on two idle cores. Needs root for mount and chroot; windows open on a display of Xvfb if that is installed.
set -euo pipefail
project=$(readlink -f "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../..")
mirror=${ROBOSIM_DEBIAN_MIRROR:-http://deb.debian.org/debian}
release=${1:-bookworm}
root=$project/build/verify/readme.$release

((EUID == 0)) || { echo "readme.sh: needs root for mount and chroot; run it with sudo" >&2; exit 1; }
echo "Creating a minimal Debian $release in $root"
rm -rf "$root"
mkdir -p "$root"
mmdebstrap --quiet --variant=minbase --include=ca-certificates "$release" "$root" "$mirror"
# What the README assumes: git, a clone, a user with sudo who answers apt with yes. python3 is for the program that executes the blocks.
"$project/tests/chroot.sh" "$root" bash -euc '
  export DEBIAN_FRONTEND=noninteractive
  apt-get -qq update
  apt-get -qq -y install --no-install-recommends git sudo python3 >/dev/null
  echo "APT::Get::Assume-Yes \"true\";" >/etc/apt/apt.conf.d/90yes
  echo "127.0.0.1 $(hostname)" >>/etc/hosts
  useradd --create-home --shell /bin/bash student
  echo "student ALL=(ALL) NOPASSWD: ALL" >/etc/sudoers.d/student'
git -c safe.directory='*' clone --quiet --no-hardlinks "$project" "$root/home/student/robosim"
"$project/tests/chroot.sh" "$root" chown -R student: /home/student/robosim

if command -v Xvfb >/dev/null; then
  Xvfb -displayfd 1 -screen 0 1280x800x24 -ac -nolisten tcp >"$root/srv/display" 2>/dev/null &
  xvfb=$!
  trap 'kill $xvfb' EXIT
  until [[ -s $root/srv/display ]]; do sleep 0.1; done
  mkdir -p "$root/tmp/.X11-unix"
  ln "/tmp/.X11-unix/X$(<"$root/srv/display")" "$root/tmp/.X11-unix"
fi

# page NAME [first]: a login shell, whose path has ~/.local/bin once that folder exists
page() {
  # shellcheck disable=SC2016  # expanded by the shell in the chroot
  "$project/tests/chroot.sh" "$root" su - student -c '
    [[ ! -s /srv/display ]] || export DISPLAY=:$(</srv/display)
    cd robosim
    exec python3 -B tests/tutorials/run_tutorial.py --everything "$0" "$PWD" $1' "$@"
}

cd "$project"
failed=()
page README.md || failed+=(README.md)
for name in doc/tutorials/*.md doc/*.md; do
  [[ $name != doc/tutorials/README.md ]] || continue
  if [[ $name == doc/tutorials/* ]]; then
    page "$name" || failed+=("$name")
  else
    page "$name" first || failed+=("$name")
  fi
done
[[ ${#failed[@]} == 0 ]] || { echo "readme.sh: failed on Debian $release: ${failed[*]}" >&2; exit 1; }
echo "The code of README.md, the tutorials and the guides works on Debian $release"
