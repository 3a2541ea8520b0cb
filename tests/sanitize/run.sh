#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the service and its tests with a sanitizer, runs them, and fails on every report: of a test
# or of a service that it started, also of one that was killed. The last line is the verdict.
#   tests/sanitize/run.sh tsan|asan [arguments of ctest: -R Reload]
set -euo pipefail
cd "$(dirname "$0")/../.."

preset="${1:-}"
case "$preset" in
  tsan) flags=-fsanitize=thread ;;
  asan) flags=-fsanitize=address,undefined ;;
  *) echo "found '$preset', allowed is tsan or asan" >&2; exit 64 ;;
esac
shift

deploy/install-deps.sh test
cmake --preset "$preset" -DDARKLING_TESTS=ON -DDARKLING_BENCH=OFF -DDARKLING_DESK_TOOL=OFF
cmake --build --preset "$preset" --target darklingd test_service

# Files, because the service's stderr is for the tests to read. 99: no program of ours exits so.
reports="$PWD/build/$preset/reports"
options="exitcode=99 log_path='$reports/report'"
export TSAN_OPTIONS="$options halt_on_error=0"
export ASAN_OPTIONS="$options"
export UBSAN_OPTIONS="$options print_stacktrace=1"

forget_reports() {
  rm -rf "$reports"
  mkdir -p "$reports"
}

forget_reports
c++ "$flags" -g tests/sanitize/broken.cpp -o "build/$preset/broken"
"build/$preset/broken" || true
if [[ -z "$(ls "$reports")" ]]; then
  echo "No report of a program that is broken on purpose: nothing was tested."
  exit 1
fi

forget_reports
status=0
ctest --preset "$preset" --parallel "$(nproc)" --no-tests=error -L '^service$' "$@" |
  tee "build/$preset/ctest.log" || status=$?
if [[ -n "$(ls "$reports")" ]]; then
  cat "$reports"/*
  status=1
fi
verdict="$(grep -E '^[0-9]+% tests passed' "build/$preset/ctest.log" || echo "No test ran to its end.")"
echo "$preset: $verdict; processes with reports: $(ls "$reports" | wc -l)"
exit "$status"
