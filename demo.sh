#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds `darkling`, renders a mine that a rover drives through in the
# light of its own headlamp, and tracks it. Later runs build and render only what changed.
set -euo pipefail
cd "$(dirname "$0")"

build=build/release
darkling=$build/bin/darkling
out=out/mine

echo "== Install and build"
deploy/install-deps.sh build
if [[ ! -f $build/CMakeCache.txt ]]; then
  # Tests would need more packages; test.sh switches them on.
  cmake --preset release -DDARKLING_TESTS=OFF -DDARKLING_BENCH=OFF >/dev/null
fi
cmake --build --preset release --target darkling

# The stamp is written last: a rendering that was interrupted is done again, and so is one of an
# older program.
stamp=$out.rendered
if [[ ! -f $stamp || $darkling -nt $stamp ]]; then
  echo "== Render a mine in stereo"
  rm -rf "$out" "$stamp"
  mkdir -p "$(dirname "$out")"
  "$darkling" render mine "$out"
  touch "$stamp"
fi

echo "== Track it"
"$darkling" replay "$out" --trajectory "$out.tum" --format tum --stats "$out.json"

cat <<END

The images and their exact truth are in $out, the trajectory is $out.tum, all figures are in
$out.json. Try another scene, or less light:
  $darkling replay synthetic:quarry
  $darkling replay synthetic:mine,electrons=1000
END
