#!/usr/bin/env bash
# Builds RoboSim and runs every test on Debian 13 (trixie), in a chroot that mmdebstrap creates in build/verify/trixie and
# later calls reuse. Arguments are passed to ctest. Needs root for mount and chroot.
set -euo pipefail
project=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../..
project=$(readlink -f "$project")
root=$project/build/verify/trixie
mirror=${ROBOSIM_DEBIAN_MIRROR:-http://deb.debian.org/debian}

((EUID == 0)) || { echo "trixie.sh: needs root for mount and chroot; run it with sudo" >&2; exit 1; }
if [[ ! -x $root/bin/bash ]]; then
  echo "Creating a Debian 13 system in $root"
  mkdir -p "$root"
  mmdebstrap --quiet --variant=apt --include=ca-certificates trixie "$root" "$mirror"
fi

# The chroot gets a copy of the tracked files as they are in the working tree. Only files with other contents are copied,
# and they get the present time, so that a second call compiles exactly what has changed.
copy=$root/srv/robosim
mkdir -p "$copy"
(cd "$project" && git ls-files -z && git ls-files -z --others --exclude-standard) | sort -z -u >"$root/srv/files"
(cd "$copy" && find . -path ./build -prune -o -name node_modules -prune -o -type f -printf '%P\0') | sort -z |
  comm -z -13 "$root/srv/files" - | (cd "$copy" && xargs -0 -r rm -f)
while IFS= read -r -d '' file; do
  [[ ! -f $project/$file ]] || cmp -s "$project/$file" "$copy/$file" ||
    (cd "$project" && cp --parents --preserve=mode --remove-destination "$file" "$copy")
done <"$root/srv/files"
# npm may need certificates that only the host has, so the modules fetched on the host are copied. They must be newer than
# the list of modules, or else ./dev fetches them again.
cp -a --no-target-directory "$project/tests/browser/node_modules" "$copy/tests/browser/node_modules"
touch "$copy/tests/browser/node_modules/.package-lock.json"
exec "$project/tests/chroot.sh" "$root" bash -c 'cd /srv/robosim && ROBOSIM_UNITY=ON exec ./dev test "$@"' dev "$@"
