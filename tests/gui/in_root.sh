#!/usr/bin/env bash
# in_root.sh ROOT [FOLDER ...] -- COMMAND ...
# Runs a command inside ROOT, where each FOLDER lies at its own path. Mounts, processes and network (there is none) are in
# namespaces of their own: whatever ends this script ends all that it started, and leaves nothing mounted.
set -euo pipefail
if [ -z "${IN_NAMESPACE:-}" ]; then
  IN_NAMESPACE=1 exec unshare --mount --net --pid --fork --kill-child "$0" "$@"
fi
root=$1
shift
mount -t proc proc "$root/proc"
mount -t sysfs sysfs "$root/sys"
mount --rbind /dev "$root/dev"
mount -t tmpfs tmpfs "$root/tmp"
while [ "$1" != -- ]; do
  mkdir -p "$root$1"
  mount --bind "$1" "$root$1"
  shift
done
shift
chroot "$root" "$@" # no exec: as the first process of its namespace a command would ignore signals
