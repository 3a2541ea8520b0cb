#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures what injected faults do and writes it into a page, with its plots in the folder named like
it. Progress goes to stderr."""
import argparse
import pathlib
import shutil
import sys

import cases
import recordings  # after cases, which finds the accuracy scripts
from measured import Measured, Scope

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from measured_page import fill_page

QUICK_RECORDINGS = ("kitti_06", "mine")


def parse(words):
    parser = argparse.ArgumentParser(prog="run.sh", description=__doc__)
    parser.add_argument("program", nargs="?", default="build/release/bin/darkling")
    parser.add_argument("--quick", action="store_true",
                        help="two recordings, bit-planes only, no plots, into build/robustness")
    parser.add_argument("--seeds", type=int, metavar="N",
                        help="drawn runs of which confident errors are counted (default 500, quick 6)")
    parser.add_argument("--at-once", type=int, default=2, metavar="N", help="processes (default 2)")
    parser.add_argument("--page", type=pathlib.Path, help="default: docs/robustness.md")
    return parser.parse_args(words)


def measure(words):
    asked = parse(words)
    if not pathlib.Path(asked.program).is_file():
        raise SystemExit(f"run.sh: {asked.program} is not there; build it first: "
                         "cmake --preset release && cmake --build --preset release --target darkling")
    page = asked.page or recordings.ROOT / "docs" / "robustness.md"
    if not page.is_file():
        raise SystemExit(f"run.sh: {page} is not there; copy docs/robustness.md for its marks")
    wanted = cases.RECORDINGS
    if asked.quick:
        wanted = [r for r in wanted if r.name in QUICK_RECORDINGS]
        if not asked.page:
            quick = recordings.ROOT / "build" / "robustness" / page.name
            quick.parent.mkdir(parents=True, exist_ok=True)
            page = pathlib.Path(shutil.copy(page, quick))
    scope = Scope(at_hand=tuple(recordings.prepare(asked.program, wanted)),
                  descriptors=cases.DESCRIPTORS[:1] if asked.quick else cases.DESCRIPTORS,
                  seeds=asked.seeds if asked.seeds is not None else 6 if asked.quick else 500,
                  has_plots=not asked.quick)
    measured = Measured(asked.program, scope, asked.at_once)
    fill_page(page, measured.write)
    if scope.has_plots:
        measured.plot(page.with_suffix(""))
    print(f"written: {page}", file=sys.stderr)


if __name__ == "__main__":
    try:
        measure(sys.argv[1:])
    except KeyboardInterrupt:
        print("run.sh: stopped, nothing written", file=sys.stderr)
        sys.exit(130)
