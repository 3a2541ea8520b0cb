#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Measures what injected faults do to recordings and rendered scenes and writes the tables and plots of
# docs/robustness.md. Builds nothing; some minutes on two cores, besides rendering, which is kept in
# build/accuracy for the next time. Recordings are looked for in $DARKLING_DATA, as by the tests.
#
#     tests/robustness/run.sh [--quick] [--seeds N] [--at-once N] [--page FILE] [PROGRAM]
set -euo pipefail
cd "$(dirname "$0")/../.."

# The one that Debian's packages belong to, where python3 is another.
for python in python3 /usr/bin/python3; do
  if "$python" -c 'import matplotlib' 2>/dev/null; then
    exec "$python" -B tests/robustness/write_robustness.py "$@"
  fi
done
echo "run.sh: plots need python3-matplotlib: deploy/install-deps.sh measure" >&2
exit 69
