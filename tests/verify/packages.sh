#!/usr/bin/env bash
# packages.sh [RELEASE]: builds the Debian packages for a release of Debian (bookworm, trixie), installs them in a minimal system
# of it, which mmdebstrap creates in build/verify, and uses them there as an ordinary user: program, manual pages, completion,
# example, Python. The default is the release of this system; packages for another one are built in a chroot, which later calls
# reuse, and left in build/packages.RELEASE. Needs root for mount and chroot.
set -euo pipefail
project=$(readlink -f "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../..")
mirror=${ROBOSIM_DEBIAN_MIRROR:-http://deb.debian.org/debian}
# shellcheck source=/dev/null
host=$(. /etc/os-release && echo "$VERSION_CODENAME")
release=${1:-$host}

((EUID == 0)) || { echo "packages.sh: needs root for mount and chroot; run it with sudo" >&2; exit 1; }
if [[ $release == "$host" ]]; then
  packages=$project/build/packages
  "$project/dev" package
else
  packages=$project/build/packages.$release
  "$project/tests/debian_system.sh" "$release"
  root=$project/build/verify/$release
  date_of_commit=$(git -C "$project" log -1 --format=%ct)
  # shellcheck disable=SC2016  # expanded by the shell in the chroot
  "$project/tests/chroot.sh" "$root" bash -c 'cd /srv/robosim && SOURCE_DATE_EPOCH=$1 exec ./dev package' dev "$date_of_commit"
  rm -rf "$packages"
  cp -r "$root/srv/robosim/build/packages" "$packages"
fi

root=$project/build/verify/packages.$release
echo "Creating a minimal Debian $release in $root"
rm -rf "$root"
mkdir -p "$root"
mmdebstrap --quiet --variant=minbase --include=ca-certificates "$release" "$root" "$mirror"
# A minimal system of mmdebstrap has all documentation; that of a container image has none, and would omit manual pages.
rm -f "$root"/etc/dpkg/dpkg.cfg.d/*doc*
cp "$packages"/*.deb "$root/srv/"

"$project/tests/chroot.sh" "$root" bash -euxc '
  export DEBIAN_FRONTEND=noninteractive
  apt-get -qq update
  apt-get -qq -y install --no-install-recommends /srv/*.deb fonts-dejavu-core g++ cmake make man-db >/dev/null
  useradd --create-home student'

"$project/tests/chroot.sh" "$root" su - student -c 'set -eux
  robosim --version
  cp -r /usr/share/robosim/worlds .
  robosim run worlds/maze_20x20.xml --record maze.rawlog --picture maze.png --csv maze.csv
  robosim replay maze.rawlog --check worlds/maze_20x20.xml
  robosim check worlds/opho2_1.xml
  robosim export maze.rawlog maze.pdf
  man robosim-run | grep -q -- --record
  bash -c "source /usr/share/bash-completion/completions/robosim; COMP_WORDS=(robosim re) COMP_CWORD=1; _robosim; [[ \${COMPREPLY[*]} == *replay* ]]"
  cp -r /usr/share/doc/robosim/doc/examples/flocking .
  cmake -S flocking -B build && cmake --build build
  cd flocking && robosim run flock.xml --plugin ../build/libflocking.so --time 20 --observer alignment
  ../build/flocking run flock.xml --time 20 --observer alignment
  ../build/flocking serve flock.xml --listen :0 --time 1
  python3 -c "
import robosim
world = robosim.World.generate(\"maze\", robots=2, seed=7)
with robosim.Simulation(world, controller=\"wander\") as simulation:
    simulation.step(100)
    print(simulation.digest, simulation.poses)"'
apt_left=$("$project/tests/chroot.sh" "$root" bash -c 'dpkg --audit')
[[ -z $apt_left ]] || { echo "$apt_left" >&2; exit 1; }
echo "The packages work on Debian $release:"
ls -l "$packages"/*.deb
