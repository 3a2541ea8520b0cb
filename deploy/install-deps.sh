#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the Debian packages of packages.txt that are missing; when none is, does nothing at all.
#
#   deploy/install-deps.sh build   what building and running needs
#   deploy/install-deps.sh         the same, and what the tests need
#   deploy/install-deps.sh cross   the same, and what cross builds need
#   deploy/install-deps.sh vm      what the tests need, and what those in a virtual machine need
#   deploy/install-deps.sh fuzz    what building needs, and what the fuzzers need
#   deploy/install-deps.sh measure what building needs, and what plots of the accuracy need
set -euo pipefail

here="$(cd "$(dirname "$0")" && pwd)"
case "${1:-test}" in
  build) groups='^build$' ;;
  test) groups='^(build|test|native)$' ;;
  cross) groups='^(build|test|native|cross)$' ;;
  vm) groups='^(build|test|native|vm)$' ;;
  fuzz) groups='^(build|fuzz)$' ;;
  measure) groups='^(build|measure)$' ;;
  *)
    echo "install-deps.sh: unknown group \`$1\`; use build, test, cross, vm, fuzz or measure" >&2
    exit 64
    ;;
esac

mapfile -t wanted < <(awk -v groups="$groups" '$1 ~ groups { print $2 }' "$here/packages.txt")
installed="$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null || true)"
missing=()
for package in "${wanted[@]}"; do
  grep -qx "installed $package" <<<"$installed" || missing+=("$package")
done
if [[ ${#missing[@]} -eq 0 ]]; then
  exit 0
fi

as_root=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "install-deps.sh: packages are missing and there is no sudo; run as root:" >&2
    echo "  apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 69
  fi
  as_root=(sudo)
fi

apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get -y -qq -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 -o Acquire::Retries=3 "$@"
}

echo "Installing ${#missing[@]} packages: ${missing[*]}"
# The package lists are fetched only when those at hand will not do (absent, or too old).
if ! apt install --no-install-recommends "${missing[@]}" >/dev/null 2>&1; then
  apt update
  apt install --no-install-recommends "${missing[@]}" >/dev/null
fi
