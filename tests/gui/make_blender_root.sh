#!/usr/bin/env bash
# make_blender_root.sh ROOT
# A folder with a real, windowed Blender 5.2 LTS in it, from Debian's packages: as root, about two minutes, 1.3 GB.
# Does nothing where ROOT is. Its mounts live in a namespace of its own and end with it.
set -euo pipefail
if [ -z "${IN_NAMESPACE:-}" ]; then
  mkdir -p "$(dirname "$1")"
  IN_NAMESPACE=1 exec flock "$1.lock" unshare --mount "$0" "$1"
fi
root=$1
[ ! -x "$root/usr/bin/blender" ] || exit 0

part=$root.part
rm -rf --one-file-system "$root" "$part"
mirror=$(apt-get indextargets --format '$(REPO_URI)' | awk 'NR == 1')
debootstrap --variant=minbase sid "$part" $mirror >/dev/null
mount -t proc proc "$part/proc"
mount -t sysfs sysfs "$part/sys"
mount --rbind /dev "$part/dev"
# sid's Release file may be past its Valid-Until; its signature is checked all the same.
apt=(chroot "$part" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Acquire::Check-Valid-Until=false)
"${apt[@]}" update
# Debian's Blender needs python3-cattr and python3-requests without saying so. SciPy is left out: the extension brings its own.
"${apt[@]}" install -y --no-install-recommends blender python3-numpy python3-cattr python3-requests \
  xvfb xauth libgl1-mesa-dri libglx-mesa0 libegl1 imagemagick >/dev/null
"${apt[@]}" clean
chroot "$part" blender --version | head -n 1
umount -R "$part/dev" "$part/sys" "$part/proc"
mv "$part" "$root"
