#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the service into a virtual machine with real V4L2 drivers and real systemd, and tries there
# what cannot be tried elsewhere: hangs, kills, cameras that go, full disks, lost routes. One boot;
# every check is a line that begins with `ok`, `FAIL` or `skip`, and the last line is the verdict.
set -euo pipefail
cd "$(dirname "$0")/../.."

readonly build=build/release vm=build/vm guest_limit_s=800

usage() {
  cat <<END
vm_test.sh [SCENARIO…]

Runs tests/vm/scenarios/SCENARIO*.sh, all by default. Afterwards $vm/share holds what the guest
printed (log), its journal, and results/ with what each scenario kept.
Exit code: 0 all checks passed, 1 some failed, 77 no virtual machine can be had here.
END
}

make_assets() {
  local assets="$1" darkling="$build/bin/darkling"
  mkdir -p "$assets/bin"
  cp "$build"/bin/{feed_loopback,hear} "$assets/bin"
  # 5 pairs a second is what an emulated processor keeps up with.
  "$darkling" render mine "$vm/mine" --force --frames 60 --width 160 \
    --set rate_hz=5 --set speed=0.3 >/dev/null
  "$build/bin/dump_frames" "$vm/mine" "$assets/mine.raw" >"$assets/mine.size"
  # The least size of the kernel's test driver; only the calibration is wanted.
  "$darkling" render corridor "$vm/wide" --force --frames 1 --width 320 --height 180 >/dev/null
  # Its driver of a camera for libcamera makes multiples of 6.
  "$darkling" render corridor "$vm/square" --force --frames 1 --width 96 --height 96 >/dev/null
  local name
  for name in mine wide square; do
    (cd "$vm" && find "$name" -name '*.yaml' -print0 | cpio --quiet -0 -pd "$OLDPWD/$assets")
  done
}

make_share() {
  local share="$1" name
  rm -rf "$share"
  mkdir -p "$share/scenarios" "$share/assets"
  cp tests/vm/{guest,checks}.sh "$share"
  for name in "${scenarios[@]}"; do cp tests/vm/scenarios/"$name"*.sh "$share/scenarios"; done
  DESTDIR="$PWD/$share/stage" cmake --install "$build" --component service --strip --prefix /usr >"$vm/install.log"
  make_assets "$share/assets"
}

# What the guest prints, as it prints it.
follow() {
  until [[ -f "$1" ]]; do sleep 0.5; done
  exec tail -n +1 -f "$1"
}

verdict() {
  local log="$1" passed failed skipped
  passed="$(grep -c '^ok ' "$log" || true)"
  failed="$(grep -c '^FAIL ' "$log" || true)"
  skipped="$(grep -c '^skip ' "$log" || true)"
  if [[ $passed -eq 0 ]]; then
    echo "No check was made."
    return 1
  fi
  echo "$passed of $((passed + failed)) checks passed"
  echo "vm: $passed passed, $failed failed, $skipped skipped"
  [[ $failed -eq 0 ]]
}

case "${1:-}" in
  -h | --help)
    usage
    exit 0
    ;;
esac
scenarios=("$@")
if [[ $# -eq 0 ]]; then scenarios=(""); fi

deploy/install-deps.sh vm || { echo "skip vm: packages cannot be installed here"; exit 77; }
command -v qemu-system-x86_64 >/dev/null || { echo "skip vm: there is no qemu-system-x86_64"; exit 77; }
# Usually built already, and perhaps in use.
if [[ ! -f build/release/CMakeCache.txt ]]; then
  cmake --preset release -DDARKLING_TESTS=ON -DDARKLING_DESK_TOOL=ON >/dev/null
fi
cmake --build --preset release --target darkling darklingd dump_frames feed_loopback hear
mkdir -p "$vm"
status=0
tests/vm/build_image.sh "$vm/image" || status=$?
if [[ $status -eq 77 ]]; then echo "skip vm: no guest can be made here"; fi
if [[ $status -ne 0 ]]; then exit "$status"; fi

share="$vm/share"
make_share "$share"
follow "$share/log" &
follower=$!
tests/vm/run_vm.sh "$vm/image" "$share" "$guest_limit_s" || status=$?
sleep 1
kill "$follower"
if [[ $status -ne 0 ]] || ! grep -q '^end of all scenarios' "$share/log"; then
  echo "FAIL vm: the guest runs all scenarios to their end -- found: exit code $status" | tee -a "$share/log"
fi
if compgen -G "$share/results/01_*" >/dev/null; then
  tests/vm/judge_motion.py "$build/bin/darkling" "$share"/results/01_* "$vm/mine/groundtruth.tum" \
    | tee -a "$share/log"
fi
verdict "$share/log"
