#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes a Debian 12 guest with real V4L2 drivers and real systemd: DIR/vmlinuz, DIR/initrd.img,
# DIR/root.ext4. The guest runs /mnt/host/guest.sh from the shared folder, so what is tested is not
# in the image, and an image made once serves until one of its own inputs changes.
#
# vivid and uvcvideo come with Debian's kernel; vimc and v4l2loopback are built here from Debian's
# sources. Nothing is mounted, and no loop device is used.
set -euo pipefail

suite=bookworm
mirror="${DARKLING_MIRROR:-http://deb.debian.org/debian}"
here="$(cd "$(dirname "$0")" && pwd)"
# What the service is linked with, and what the scenarios look with.
guest_packages=(
  dbus iproute2 kmod libcamera-ipa libcamera0.0.3 liblcm1
  libspdlog1.10 libsystemd0 libyaml-cpp0.7 procps systemd systemd-sysv udev v4l-utils
)
modules=(virtio_pci virtio_blk ext4 9p 9pnet_virtio vivid uvcvideo)

usage() {
  cat <<END
build_image.sh DIR

Makes the guest in DIR, or does nothing when DIR holds just that. Needs root, and the packages of
\`deploy/install-deps.sh vm\`. Exit code 77: something it is made of cannot be had here.

  DARKLING_MIRROR   the Debian mirror (default: $mirror)
END
}

absent() {
  echo "build_image.sh: $1" >&2
  exit 77
}

# The newest kernel whose headers are installed: modules are built against them.
kernel_version() {
  local headers
  headers="$(printf '%s\n' /usr/src/linux-headers-*-amd64 | sort -V | tail -1)"
  [[ -d "$headers" ]] || absent "no kernel headers are installed; run deploy/install-deps.sh vm"
  echo "${headers#/usr/src/linux-headers-}"
}

fetch_kernel() {
  local package="linux-image-$kernel"
  mkdir -p "$new/package"
  # The package lists are fetched only when those at hand will not do.
  (cd "$new/package" && { apt-get -qq download "$package" \
    || { apt-get -qq update && apt-get -qq download "$package"; }; }) >"$new/kernel.log" 2>&1 \
    || { cat "$new/kernel.log" >&2 && absent "$package cannot be fetched"; }
  dpkg-deb --extract "$new/package/$package"_*.deb "$new/kernel"
  depmod -b "$new/kernel" "$kernel"
  cp "$new/kernel/boot/vmlinuz-$kernel" "$new/vmlinuz"
}

build_modules() {
  local headers="/usr/src/linux-headers-$kernel" vimc=drivers/media/test-drivers/vimc
  mkdir -p "$new/modules/v4l2loopback"
  tar -xf /usr/src/linux-source-6.1.tar.xz -C "$new/modules" --strip-components=4 "linux-source-6.1/$vimc"
  tar -xf /usr/src/v4l2loopback.tar.bz2 -C "$new/modules/v4l2loopback" --strip-components=2
  make -s -C "$headers" M="$new/modules/vimc" CONFIG_VIDEO_VIMC=m modules
  make -s -C "$headers" M="$new/modules/v4l2loopback" modules
  strip --strip-debug "$new"/modules/*/*.ko
}

fetch_root() {
  mmdebstrap --mode=root --variant=minbase --aptopt='Acquire::Retries "3"' \
    --dpkgopt='path-exclude=/usr/share/man/*' --dpkgopt='path-exclude=/usr/share/doc/*' \
    --dpkgopt='path-exclude=/usr/share/locale/*' \
    --include="$(IFS=, && echo "${guest_packages[*]}")" "$suite" "$new/root" "$mirror" \
    >"$new/root.log" 2>&1 \
    || { cat "$new/root.log" >&2 && absent "the guest's packages cannot be fetched from $mirror"; }
}

# The files of modules and of all that they need, in the order in which they can be loaded.
module_files() {
  local module
  for module in "$@"; do
    modprobe -d "$new/kernel" -S "$kernel" --show-depends "$module" | awk '/^insmod/ { print $2 }'
  done | awk '!seen[$0]++'
}

install_modules() {
  local target="$new/root/lib/modules/$kernel"
  mkdir -p "$target/kernel" "$target/extra"
  module_files "${modules[@]}" | xargs cp -t "$target/kernel"
  # What these need, vivid needs too.
  cp "$new"/modules/*/*.ko "$target/extra"
  cp "$new/kernel/lib/modules/$kernel"/modules.{builtin,builtin.modinfo,order} "$target"
  depmod -b "$new/root" "$kernel"
}

set_up_guest() {
  local root="$new/root" unit
  install -m 644 "$here/guest/vmtest.service" "$root/etc/systemd/system/vmtest.service"
  install -m 755 "$here/guest/vmtest" "$root/usr/local/sbin/vmtest"
  mkdir -p "$root/etc/systemd/system/multi-user.target.wants"
  ln -sf ../vmtest.service "$root/etc/systemd/system/multi-user.target.wants/vmtest.service"
  ln -sf /lib/systemd/system/multi-user.target "$root/etc/systemd/system/default.target"
  # Nobody logs in, and under emulation each of these costs a second.
  for unit in apt-daily.timer apt-daily-upgrade.timer dpkg-db-backup.timer e2scrub_all.timer \
    e2scrub_reap.service fstrim.timer getty@tty1.service serial-getty@ttyS0.service \
    systemd-timesyncd.service; do
    ln -sf /dev/null "$root/etc/systemd/system/$unit"
  done
  echo darkling-vm >"$root/etc/hostname"
  echo '/dev/vda / ext4 rw,noatime 0 0' >"$root/etc/fstab"
  : >"$root/etc/machine-id"
}

make_initrd() {
  local tree="$new/initrd" file
  mkdir -p "$tree"/{bin,proc,sys,dev,root,modules}
  cp /bin/busybox "$tree/bin/busybox"
  while IFS= read -r file; do
    cp "$file" "$tree/modules"
    basename "$file" >>"$tree/order"
  done < <(module_files virtio_pci virtio_blk ext4)
  install -m 755 "$here/guest/init" "$tree/init"
  (cd "$tree" && find . | cpio -o -H newc --quiet | gzip -1) >"$new/initrd.img"
}

case "${1:-}" in
  -h | --help)
    usage
    exit 0
    ;;
esac
if [[ $# -ne 1 ]]; then
  usage >&2
  exit 64
fi
[[ "$(dpkg --print-architecture)" == amd64 ]] || absent "guests are made on amd64 only"
[[ $(id -u) -eq 0 ]] || absent "a guest's root needs root to be made"
for tool in mmdebstrap modprobe mke2fs cpio busybox; do
  command -v "$tool" >/dev/null || absent "$tool is missing; run deploy/install-deps.sh vm"
done
dir="$(realpath -m "$1")"
kernel="$(kernel_version)"

# What the image is made of; the file with it is written last, so only a whole image has one.
recipe="$(echo "kernel $kernel" && sha256sum "$here/build_image.sh" "$here"/guest/* | sed 's# .*/# #' \
  && dpkg-query -W linux-source-6.1 v4l2loopback-source)"
if [[ -f "$dir/recipe" && "$(<"$dir/recipe")" == "$recipe" ]]; then
  exit 0
fi

echo "Making a guest with Linux $kernel in $dir"
mkdir -p "$(dirname "$dir")"
new="$(mktemp -d "$dir.XXXXXX")"
trap 'rm -rf "$new"' EXIT
chmod 755 "$new"
fetch_root &
root_job=$!
fetch_kernel
build_modules >"$new/modules.log" 2>&1 || { cat "$new/modules.log" >&2 && exit 70; }
status=0
wait "$root_job" || status=$?
[[ $status -eq 0 ]] || exit "$status"
install_modules
set_up_guest
make_initrd
mke2fs -q -t ext4 -O ^has_journal -d "$new/root" "$new/root.ext4" 1200M
rm -rf "$new"/{root,kernel,package,modules,initrd} "$new"/*.log
printf '%s\n' "$recipe" >"$new/recipe"
rm -rf "$dir"
mv -T "$new" "$dir"
