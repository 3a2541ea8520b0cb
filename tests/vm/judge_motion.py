#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds what the service published in the guest against the truth of the drive that was played.

The drive was played forth and back at the guest's own time; the feeder's log says which pair of the
recording was shown when."""
import argparse
import bisect
import collections
import json
import pathlib
import re
import subprocess

# A replay of the same drive has an ATE of 11 mm and an RPE of 2 mm; these are what nobody would call
# tracking, with a margin for other processors.
MAX_ATE_M = 0.05
MAX_RPE_M = 0.01
MIN_DISTANCE_M = 1.0
MIN_POSES = 50


def numbers_by_stamp(heard):
    """Of every published pose: its frame's number by its stamp, ns."""
    found = re.findall(r"^VO_POSE mono_ns=(\d+) seq=(\d+) ", heard.read_text(), re.MULTILINE)
    return {int(stamp_ns): int(number) for stamp_ns, number in found}


def pair_of_frame(numbers, shown_ns):
    """What to add to a frame's number for the line of the feeder's log it belongs to. Most frames
    arrive before the next pair is shown; those that emulation delays do not have a vote."""
    votes = collections.Counter(bisect.bisect_right(shown_ns, stamp_ns) - 1 - number
                                for stamp_ns, number in numbers.items())
    return votes.most_common(1)[0][0]


def truth_at(stamps, results, truth):
    """TUM rows of the true pose at each of the estimate's stamps."""
    poses = [line.split()[1:] for line in truth.read_text().splitlines()
             if line and not line.startswith("#")]
    shown = [line.split() for line in (results / "feed.log").read_text().splitlines()]
    shown = [row for row in shown if len(row) == 2]  # the last line may be half
    numbers = numbers_by_stamp(results / "heard")
    offset = pair_of_frame(numbers, [int(row[0]) for row in shown])
    rows = []
    for stamp in stamps:
        number = numbers[int(stamp.replace(".", ""))]
        rows.append(" ".join([stamp, *poses[int(shown[number + offset][1])]]))
    return "\n".join(rows) + "\n"


def say(holds, claim, found):
    print(f"ok   judged_motion: {claim} ({found})" if holds
          else f"FAIL judged_motion: {claim} -- found: {found}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("darkling", help="the desk program")
    parser.add_argument("results", type=pathlib.Path, help="what scenario 01 left")
    parser.add_argument("truth", type=pathlib.Path, help="the recording's truth, TUM")
    words = parser.parse_args()

    estimate = words.results / "estimate.tum"
    rows = estimate.read_text().splitlines() if estimate.exists() else []
    say(len(rows) >= MIN_POSES, f"at least {MIN_POSES} poses were published", f"{len(rows)} poses")
    if len(rows) < 2:
        return
    truth = words.results / "truth.tum"
    truth.write_text(truth_at([row.split()[0] for row in rows], words.results, words.truth))
    done = subprocess.run([words.darkling, "eval", "--json", str(truth), str(estimate)],
                          capture_output=True, text=True)
    if done.returncode != 0:
        say(False, "the motion can be judged", done.stderr.strip())
        return
    error = json.loads(done.stdout)
    say(error["truth_path_m"] >= MIN_DISTANCE_M, f"it drove at least {MIN_DISTANCE_M} m",
        f"{error['truth_path_m']:.2f} m")
    say(error["ate_rmse_m"] <= MAX_ATE_M, f"its path is the true one within {MAX_ATE_M} m",
        f"{error['ate_rmse_m']:.4f} m")
    say(error["rpe_rmse_m"] <= MAX_RPE_M, f"so is each motion within {MAX_RPE_M} m",
        f"{error['rpe_rmse_m']:.5f} m")


if __name__ == "__main__":
    main()
