#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Boots the guest, which runs SHARE/guest.sh, and ends with that script's exit code.
set -euo pipefail

accelerator="${DARKLING_VM_ACCEL:-tcg,thread=multi}"

usage() {
  cat <<END
run_vm.sh IMAGE_DIR SHARE [TIMEOUT_S]

Boots the guest of build_image.sh with the folder SHARE at /mnt/host. Afterwards SHARE holds log
(what guest.sh printed; it grows while the guest runs), status, journal and console. The image
stays as it was. Emulated, work takes about 28 times as long, while clocks run as ever.
Exit code: that of guest.sh; 70 when it never ended.

  DARKLING_VM_ACCEL   qemu's accelerator (default: $accelerator). \`kvm\` is not the default because
                      a /dev/kvm that is there need not work, and then the guest hangs.
END
}

case "${1:-}" in
  -h | --help)
    usage
    exit 0
    ;;
esac
if [[ $# -lt 2 || $# -gt 3 ]]; then
  usage >&2
  exit 64
fi
image="$(realpath "$1")"
share="$(realpath "$2")"
timeout_s="${3:-600}"

rm -f "$share"/{log,status,journal,console}
timeout --kill-after=5 "$timeout_s" qemu-system-x86_64 -accel "$accelerator" \
  -cpu max -smp 2 -m 1024 -nographic -no-reboot -nic none \
  -kernel "$image/vmlinuz" -initrd "$image/initrd.img" \
  -append "console=ttyS0 panic=-1 quiet loglevel=3 systemd.show_status=0 mitigations=off random.trust_cpu=on" \
  -drive "file=$image/root.ext4,format=raw,if=virtio,snapshot=on" \
  -virtfs "local,path=$share,mount_tag=host,security_model=none" \
  </dev/null >"$share/console" 2>&1 \
  || echo "run_vm.sh: the guest was ended after $timeout_s s, or qemu failed" >&2
if [[ ! -s "$share/status" ]]; then
  tail -n 20 "$share/console" >&2
  exit 70
fi
exit "$(<"$share/status")"
