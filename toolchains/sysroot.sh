#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes the folder of Debian 12 headers and libraries that a cross build compiles and links against
# and that the emulator loads from. Nothing in it is configured or run, the host's packages stay as
# they are, and no privileges are needed.
set -euo pipefail

suite=bookworm
mirror="${DARKLING_MIRROR:-http://deb.debian.org/debian}"
root="$(cd "$(dirname "$0")/.." && pwd)"

usage() {
  cat <<END
sysroot.sh ARCH DIR

Unpacks Debian 12 ($suite) libraries for ARCH (arm64 or armhf) into DIR: what deploy/packages.txt
lists of libraries, and all that these need. Does nothing when DIR holds just that already. DIR is
replaced only when the new one is complete.

  DARKLING_MIRROR   the Debian mirror (default: $mirror)
END
}

fail() {
  echo "sysroot.sh: $2" >&2
  exit "$1"
}

# The target needs the development packages only (they bring the libraries); compilers and tools are
# the host's. The cross compilers bring the C++ library's headers, the C library's are not in the list
# because natively they come with build-essential.
packages() {
  awk '$1 ~ /^(build|test)$/ && $2 ~ /-dev$/ { print $2 }' "$root/deploy/packages.txt"
  echo libc6-dev
}

# The emulator looks for every path here before it looks on the host: a /tmp or /dev of the sysroot's
# own would hide the real ones.
keep_what_is_linked() {
  find "$1" -mindepth 1 -maxdepth 1 ! -name lib ! -name usr -exec rm -rf {} +
  rm -rf "${1:?}"/usr/{bin,games,sbin,src} "${1:?}"/usr/share/{doc,fonts,icons,locale,man}
}

# Absolute links lead out of the sysroot.
make_links_relative() {
  local sysroot="$1" link target
  while IFS= read -r -d '' link; do
    target="$(readlink "$link")"
    ln -snf "$(realpath -ms --relative-to="$(dirname "$link")" "$sysroot$target")" "$link"
  done < <(find "$sysroot" -lname '/*' -print0)
}

# Alternatives, which a maintainer script would have set.
choose_alternatives() {
  local libraries="$1" name
  for name in blas lapack; do
    if [[ -e "$libraries/$name/lib$name.so.3" ]]; then
      ln -snf "$name/lib$name.so.3" "$libraries/lib$name.so.3"
    fi
  done
}

make_sysroot() {
  local dir="$1"
  # chrootless: the one mode that asks neither for root nor for user namespaces; nothing is run in
  # the new root anyway. A mirror that is named stands alone: without the security archive, which
  # changes daily, two sysroots differ only across point releases. Nothing of it is shipped.
  mmdebstrap --mode=chrootless --variant=extract --format=directory \
    --architectures="$arch" --aptopt='Acquire::Retries "3"' \
    --include="$(packages | paste -sd,)" "$suite" "$dir" "$mirror" >"$new.log" 2>&1 \
    || { cat "$new.log" >&2 && fail 69 "the packages for $arch cannot be fetched from $mirror"; }
  keep_what_is_linked "$dir"
  make_links_relative "$dir"
  choose_alternatives "$dir/usr/lib/$triplet"
}

case "${1:-}" in
  -h | --help)
    usage
    exit 0
    ;;
esac
if [[ $# -ne 2 ]]; then
  usage >&2
  exit 64
fi
case "$1" in
  arm64) triplet=aarch64-linux-gnu ;;
  armhf) triplet=arm-linux-gnueabihf ;;
  *) fail 64 "unknown architecture \`$1\`; use arm64 or armhf" ;;
esac
arch="$1"
dir="$(realpath -m "$2")"

# What the folder is made of; the file with it is written last, so only a whole sysroot has one.
recipe="$(printf '%s\n' "suite $suite" "arch $arch" "script $(sha256sum <"$0" | cut -c1-16)" "$(packages | sort)")"
stamp=.darkling-sysroot
if [[ -f "$dir/$stamp" && "$(<"$dir/$stamp")" == "$recipe" ]]; then
  exit 0
fi
if [[ -e "$dir" && ! -f "$dir/$stamp" && -n "$(ls -A "$dir")" ]]; then
  fail 73 "$dir exists and was not made by this script; remove it or name another folder"
fi
command -v mmdebstrap >/dev/null \
  || fail 69 "mmdebstrap is missing; run deploy/install-deps.sh cross"

mkdir -p "$(dirname "$dir")"
new="$(mktemp -d "$dir.XXXXXX")"
trap 'rm -rf "$new" "$new.log"' EXIT
chmod 755 "$new"
echo "Making a sysroot for $arch in $dir"
# Not `make_sysroot || …`: bash would go on after a failure inside it.
make_sysroot "$new"
printf '%s\n' "$recipe" >"$new/$stamp"
rm -rf "$dir"
mv -T "$new" "$dir"
