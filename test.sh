#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds everything and runs every test, then those of the ARM builds under
# emulation. The last line is the verdict.
# Arguments go to ctest: `./test.sh -L kernels` runs one kind, and of the native build only.
set -euo pipefail
cd "$(dirname "$0")"

deploy/install-deps.sh test
cmake --preset release -DDARKLING_TESTS=ON -DDARKLING_BENCH=ON -DDARKLING_DESK_TOOL=ON
cmake --build --preset release

log=build/release/ctest.log
status=0
ctest --preset release --parallel "$(nproc)" --no-tests=error "$@" | tee "$log" || status=$?

verdict="$(grep -E '^[0-9]+% tests passed' "$log" || echo "No test ran to its end.")"
if [[ $status -eq 0 && $# -eq 0 ]]; then
  # When it fails, its own last line is the verdict.
  tests/cross.sh || exit $?
  echo "native:"
fi
echo "$verdict"
exit "$status"
