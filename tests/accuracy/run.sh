#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Measures the accuracy on every recording and rendered scene and writes the tables and plots of
# docs/accuracy.md. Builds nothing; ten minutes on two cores, half of which is rendering, and that is
# kept in build/accuracy for the next time. Recordings are looked for in $DARKLING_DATA, as by the tests.
#
#     tests/accuracy/run.sh [PROGRAM]
set -euo pipefail
cd "$(dirname "$0")/../.."

program="${1:-build/release/bin/darkling}"
if [[ ! -x $program ]]; then
  echo "run.sh: $program is not there; build it first: cmake --preset release &&" >&2
  echo "        cmake --build --preset release --target darkling" >&2
  exit 66
fi
# The one that Debian's packages belong to, where python3 is another.
for python in python3 /usr/bin/python3; do
  if "$python" -c 'import matplotlib' 2>/dev/null; then
    exec "$python" -B tests/accuracy/write_accuracy.py "$program" docs/accuracy.md
  fi
done
echo "run.sh: plots need python3-matplotlib: deploy/install-deps.sh measure" >&2
exit 69
