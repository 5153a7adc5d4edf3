#!/usr/bin/env bash
# debian_system.sh RELEASE: prepares a Debian system with a copy of this source tree, for building and testing on another
# release of Debian: build/verify/RELEASE, with the copy in its folder /srv/robosim. The first call creates the system with
# mmdebstrap; later calls update the copy only. Needs root.
set -euo pipefail
project=$(readlink -f "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/..")
release=$1
root=$project/build/verify/$release
mirror=${ROBOSIM_DEBIAN_MIRROR:-http://deb.debian.org/debian}

if [[ ! -x $root/bin/bash ]]; then
  echo "Creating a Debian system ($release) in $root"
  mkdir -p "$root"
  mmdebstrap --quiet --variant=apt --include=ca-certificates "$release" "$root" "$mirror"
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
