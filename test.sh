#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds everything and runs every test, then those of the ARM builds under
# emulation and those of the service in a virtual machine. The last line is the verdict.
# Arguments go to ctest: `./test.sh -L kernels` runs one kind, and of the native build only.
set -euo pipefail
cd "$(dirname "$0")"

deploy/install-deps.sh test
cmake --preset release -DDARKLING_TESTS=ON -DDARKLING_BENCH=ON -DDARKLING_DESK_TOOL=ON
cmake --build --preset release

# clang-tidy over everything takes as long as all else together: `./test.sh -L tidy`.
wanted=("$@")
if [[ $# -eq 0 ]]; then wanted=(-LE '^tidy$'); fi
log=build/release/ctest.log
status=0
ctest --preset release --parallel "$(nproc)" --no-tests=error "${wanted[@]}" | tee "$log" || status=$?

verdict="$(grep -E '^[0-9]+% tests passed' "$log" || echo "No test ran to its end.")"
if [[ $status -eq 0 && $# -eq 0 ]]; then
  # The guest mostly waits: beside the builds for ARM it costs little time. They step back for it, as
  # the service there has a watchdog.
  vm_log=build/vm_test.log
  tests/vm/vm_test.sh >"$vm_log" 2>&1 &
  vm=$!
  nice -n 15 tests/cross.sh || status=$?
  vm_status=0
  wait "$vm" || vm_status=$?
  echo "in a virtual machine:"
  grep -E '^(FAIL|skip) ' "$vm_log" || true
  tail -n 1 "$vm_log"
  if [[ $vm_status -ne 0 && $vm_status -ne 77 ]]; then
    tail -n 60 "$vm_log"
    status=1
  fi
  echo "native:"
fi
echo "$verdict"
exit "$status"
