#!/usr/bin/env bash
# portable.sh [RELEASE…]: makes the portable archive (./dev package --portable), and uses it in minimal Debian systems (bookworm and
# trixie by default), which mmdebstrap creates in build/verify, as an ordinary user: runs, recordings, pictures, several processes, the
# errors of what it lacks, and cameras with the system's graphics driver; the wheel where Python is that of this system.
# Needs root for mount and chroot.
set -euo pipefail
project=$(readlink -f "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../..")
mirror=${ROBOSIM_DEBIAN_MIRROR:-http://deb.debian.org/debian}
releases=("$@")
[[ ${#releases[@]} != 0 ]] || releases=(bookworm trixie)

((EUID == 0)) || { echo "portable.sh: needs root for mount and chroot; run it with sudo" >&2; exit 1; }
"$project/dev" package --portable
archive=("$project"/build/portable/*.tar.xz)

for release in "${releases[@]}"; do
  root=$project/build/verify/portable.$release
  echo "Creating a minimal Debian $release in $root"
  rm -rf "$root"
  mkdir -p "$root"
  mmdebstrap --quiet --variant=minbase --include=ca-certificates,xz-utils "$release" "$root" "$mirror"
  cp "${archive[0]}" "$root/srv/robosim.tar.xz"
  "$project/tests/chroot.sh" "$root" useradd --create-home --shell /bin/bash student
  "$project/tests/chroot.sh" "$root" su - student -c 'set -eux
    tar xf /srv/robosim.tar.xz
    mv robosim-* "a folder with spaces"
    export PATH="$PWD/a folder with spaces/bin:$PATH"
    robosim --version
    robosim run maze_20x20 --record maze.rawlog --picture maze.png --csv maze.csv 2>errors
    test ! -s errors
    robosim replay maze.rawlog --check maze_20x20
    robosim export maze.rawlog maze.pdf maze.npz
    robosim export opho2_1 opho2_1.gridmap opho2_1.yaml opho2_1.bt opho2_1.3Dscene
    robosim run lab_map --picture lab.png --time 10
    robosim check courtyard_and_office
    robosim generate cave cave.xml --robots 3 --seed 7
    robosim bench gold maze_20x20 --runs 2 --time 60
    robosim serve small_maze --wait-for-robots --time 20 --record served.rawlog &
    robosim robot Pioneer1 Scout1
    wait $!
    robosim replay served.rawlog
    grep -a -q DejaVuSans maze.pdf
    (robosim view maze_20x20 2>&1 || true) | grep "the portable archive has no windows"
    (robosim robot --arcos tcp:127.0.0.1:1 --laser /dev/ttyUSB1 --controller still 2>&1 || true) | grep "no drivers for joysticks and serial"
    (robosim run open_house --time 2 --record house.rawlog 2>&1 || true) | grep "cameras need OpenGL.*install"'
  # With the system's graphics driver, whose libraries are of other versions than those of the archive.
  "$project/tests/chroot.sh" "$root" bash -euxc '
    export DEBIAN_FRONTEND=noninteractive
    apt-get -qq update
    apt-get -qq -y install --no-install-recommends libegl1 libgl1-mesa-dri python3-numpy python3-venv >/dev/null'
  "$project/tests/chroot.sh" "$root" su - student -c 'set -eux
    "a folder with spaces/bin/robosim" run open_house --time 2 --record house.rawlog --record-images external
    ls house_Images/*.jpg | head -n 1
    version=$(python3 -c "import sys; print(f\"cp{sys.version_info.major}{sys.version_info.minor}\")")
    wheel=$(echo "a folder with spaces"/*.whl)
    if [[ $wheel == *-$version-* ]]; then
      python3 -m venv --system-site-packages venv
      venv/bin/pip install --no-index "$wheel"
      venv/bin/python -c "
import robosim, ssl, xml.parsers.expat
world = robosim.World.generate(\"maze\", robots=2, seed=7)
with robosim.Simulation(world, controller=\"wander\") as simulation:
    simulation.record(\"run.rawlog\")
    simulation.step(100)
    simulation.stop_recording()
    print(simulation.digest, simulation.poses)
print(robosim.read_rawlog(\"run.rawlog\").robots)
robosim.World.load(\"lab_map\")
world.plan()
print(ssl.create_default_context())"
    fi'
  echo "The portable archive works on Debian $release"
done
ls -l "${archive[0]}"
