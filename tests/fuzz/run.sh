#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the fuzzers with clang, AddressSanitizer and UBSan, and lets each search for SECONDS (60).
# What they learn stays in build/fuzz/corpus; an input that breaks something is written beside it.
set -euo pipefail
cd "$(dirname "$0")/../.."

seconds="${1:-60}"
cmake -S . -B build/fuzz -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DDARKLING_FUZZ=ON -DDARKLING_SANITIZE=address,undefined -DDARKLING_TESTS=OFF \
  -DDARKLING_BENCH=OFF -DDARKLING_DESK_TOOL=OFF
cmake --build build/fuzz --target fuzz_frame_log fuzz_messages write_seeds
build/fuzz/bin/write_seeds build/fuzz/seeds
for target in frame_log messages; do
  mkdir -p "build/fuzz/corpus/$target"
  build/fuzz/bin/fuzz_$target -max_total_time="$seconds" -max_len=8192 -rss_limit_mb=1024 \
    -artifact_prefix="build/fuzz/corpus/broken_$target-" \
    "build/fuzz/corpus/$target" "build/fuzz/seeds/$target"
done
