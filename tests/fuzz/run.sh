#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
set -euo pipefail
cd "$(dirname "$0")/../.."

all=(frame_log messages config calibration trajectory words jpeg)

usage() {
  cat <<END
Usage: tests/fuzz/run.sh [--for SECONDS] [--with COMPILER] [TARGET…]

Builds the fuzzers with AddressSanitizer and UBSan, and lets each TARGET (default: all) search for
SECONDS (60). What they learn stays in build/fuzz/corpus/TARGET and is where they go on next time.

  frame_log    a file opened and played as a frame log
  messages     bytes decoded as every type of message
  config       a configuration file, written and read back
  calibration  files of Kalibr, EuRoC, KITTI, OpenCV and ROS
  trajectory   a KITTI, TUM or EuRoC trajectory, compared with itself
  words        sources, injections, settings and times of the command line
  jpeg         bytes as a JPEG image of a camera

COMPILER is clang++ where there is one (packages clang and libclang-rt-14-dev), else c++; with another
one, build/fuzz is build/fuzz-COMPILER. Without libFuzzer a driver of our own damages the seeds at random: it finds the same faults, later.

An input that breaks something is written to build/fuzz/corpus/broken_TARGET-…; to see it again:
  build/fuzz/bin/fuzz_TARGET -max_total_time=0 build/fuzz/corpus/broken_TARGET-…

Exit codes: 0 nothing was found · 64 usage · 70 something was found, or the build failed
END
}

refuse() {
  echo "run.sh: $1" >&2
  echo "Try: tests/fuzz/run.sh --help" >&2
  exit 64
}

seconds=60
compiler="$(command -v clang++ || echo c++)"
build=build/fuzz
targets=()
while [[ $# -gt 0 ]]; do
  case "$1" in
    --help | -h) usage; exit 0 ;;
    --for)
      [[ "${2:-}" =~ ^[1-9][0-9]{0,6}$ ]] || refuse "--for: found '${2:-}', allowed are whole seconds"
      seconds="$2"; shift 2 ;;
    --with)
      command -v "${2:-}" >/dev/null || refuse "--with: '${2:-}' is no compiler here"
      compiler="$2"; build="build/fuzz-$(basename "$2")"; shift 2 ;;
    -*) refuse "unknown option '$1'" ;;
    *)
      [[ " ${all[*]} " == *" $1 "* ]] || refuse "unknown target '$1', allowed are ${all[*]}"
      targets+=("$1"); shift ;;
  esac
done
[[ ${#targets[@]} -gt 0 ]] || targets=("${all[@]}")

cmake -S . -B "$build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DDARKLING_FUZZ=ON -DDARKLING_SANITIZE=address,undefined -DDARKLING_TESTS=OFF \
  -DDARKLING_BENCH=OFF -DDARKLING_DESK_TOOL=OFF || exit 70
cmake --build "$build" --target "${targets[@]/#/fuzz_}" write_seeds || exit 70
"$build/bin/write_seeds" "$build/seeds"

# Files that a target writes are in memory.
if [[ -w /dev/shm ]]; then export TMPDIR=/dev/shm; fi
status=0
summary=""
for target in "${targets[@]}"; do
  corpus="$build/corpus/$target"
  log="$build/$target.log"
  mkdir -p "$corpus"
  verdict="nothing found"
  "$build/bin/fuzz_$target" -max_total_time="$seconds" -max_len=8192 -rss_limit_mb=1024 -timeout=20 \
    -artifact_prefix="$build/corpus/broken_$target-" "$corpus" "$build/seeds/$target" 2>&1 |
    tee "$log" || { status=70; verdict="BROKEN: see $log"; }
  runs="$(sed -n 's/^Done \([0-9]*\) runs.*/\1/p' "$log")"
  summary+="$(printf '%-12s %12s runs  %s' "$target" "${runs:-?}" "$verdict")"$'\n'
done
printf '\n%s' "$summary"
exit "$status"
