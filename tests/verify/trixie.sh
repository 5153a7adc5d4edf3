#!/usr/bin/env bash
# Builds RoboSim and runs every test on Debian 13 (trixie), in a chroot that mmdebstrap creates in build/verify/trixie and
# later calls reuse. Arguments are passed to ctest. Needs root for mount and chroot.
set -euo pipefail
project=$(readlink -f "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../..")
root=$project/build/verify/trixie

((EUID == 0)) || { echo "trixie.sh: needs root for mount and chroot; run it with sudo" >&2; exit 1; }
"$project/tests/debian_system.sh" trixie
# npm may need certificates that only the host has, so the modules fetched on the host are copied. They must be newer than
# the list of modules, or else ./dev fetches them again.
copy=$root/srv/robosim
cp -a --no-target-directory "$project/tests/browser/node_modules" "$copy/tests/browser/node_modules"
touch "$copy/tests/browser/node_modules/.package-lock.json"
exec "$project/tests/chroot.sh" "$root" bash -c 'cd /srv/robosim && exec ./dev test "$@"' dev "$@"
