#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds, measures this machine and writes the figures into docs/performance.md. For a quiet machine;
# takes a minute or two. SOURCE, if given, is played in place of the rendered corridors, as for
# `darkling bench --source`.
#
#     tests/bench/performance.sh [SOURCE]
set -euo pipefail
cd "$(dirname "$0")/../.."

cmake --preset release
cmake --build --preset release --target darkling
out=build/release/performance
mkdir -p "$out"
darkling=build/release/bin/darkling

for size in 160x120 320x240 640x480; do
  "$darkling" bench --json --repeat 41 --size "$size" > "$out/kernels_$size.json"
done
"$darkling" bench --json --repeat 21 --source "${1:-synthetic:corridor,frames=60,width=640}" > "$out/stages.json"
"$darkling" bench --json --repeat 11 --sweep --source "${1:-synthetic:corridor,frames=20,width=640}" > "$out/sweep.json"
python3 -B tests/bench/write_performance.py "$out" docs/performance.md
