#!/usr/bin/env bash
# chroot.sh FOLDER COMMAND…: runs a command in a Debian system in a folder, with /proc and /dev, in an environment of its own.
# Needs root. ROBOSIM_VERIFY is passed on.
set -euo pipefail
((EUID == 0)) || { echo "chroot.sh: needs root for mount and chroot; run it with sudo" >&2; exit 1; }
[[ -f /etc/resolv.conf ]] && cp --remove-destination /etc/resolv.conf "$1/etc/resolv.conf"
inside='
  mount --make-rprivate /
  mount --bind "$1" "$1"  # a test makes mount namespaces, which needs a root that is a mount point
  mount -t proc proc "$1/proc"
  mount --rbind /dev "$1/dev"
  exec chroot "$1" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 TERM="${TERM:-dumb}" \
    ${ROBOSIM_VERIFY:+ROBOSIM_VERIFY=1} "${@:2}"'
# Its processes end with it, also when it is killed.
exec unshare --mount --pid --fork --kill-child bash -c "$inside" chroot "$@"
