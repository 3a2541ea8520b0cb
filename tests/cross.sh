#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds for 64-bit and for 32-bit ARM and runs, under emulation, the tests of what is computed there:
# kernels, laws, golden, and unit tests for 32-bit. The last lines are the verdicts.
set -euo pipefail
cd "$(dirname "$0")/.."

deploy/install-deps.sh cross

# Mostly a wait for the network, so both at once.
toolchains/sysroot.sh arm64 build/sysroot/arm64 &
arm64=$!
toolchains/sysroot.sh armhf build/sysroot/armhf &
armhf=$!
status=0
wait "$arm64" || status=$?
wait "$armhf" || status=$?
if [[ $status -ne 0 ]]; then
  echo "No test ran: a sysroot is missing."
  exit "$status"
fi

# The native program, to compare with; usually built already.
if [[ ! -f build/release/CMakeCache.txt ]]; then
  cmake --preset release
fi
cmake --build --preset release --target darkling

# Unit tests are run where types have other sizes: they hold half of all that is compiled, and on
# 64 bits differ from the native ones only by the kernels, which have tests of their own.
declare -A kinds=([aarch64]="kernels laws golden" [armhf]="kernels unit laws golden")
for preset in aarch64 armhf; do
  cmake --preset "$preset" -DDARKLING_TESTS=ON -DDARKLING_BENCH=OFF -DDARKLING_DESK_TOOL=ON
  read -ra names <<<"${kinds[$preset]}"
  cmake --build --preset "$preset" --target darkling darklingd "${names[@]/#/test_}"
  ctest --preset "$preset" --parallel "$(nproc)" --no-tests=error \
    -L "^($(IFS='|'; echo "${names[*]}"))$" | tee "build/$preset/ctest.log" || status=$?
done

for preset in aarch64 armhf; do
  echo "$preset, emulated:"
  grep -E '^[0-9]+% tests passed' "build/$preset/ctest.log" || echo "No test ran to its end."
done
exit "$status"
