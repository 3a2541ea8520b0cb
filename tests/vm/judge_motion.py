#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds what the service published in the guest against the truth of the drive that was played.

The drive was played forth and back at the guest's own time; the feeder's log says which pair of the
recording was shown when."""
import argparse
import bisect
import collections
import itertools
import json
import math
import pathlib
import subprocess

# A replay of the same drive has an ATE of 11 mm and an RPE of 2 mm; beyond these nobody would call it
# tracking. Of the steps a tenth is let go: an emulation that stalls mixes up pairs in time.
MAX_ATE_M = 0.05
MAX_STEP_ERROR_M = 0.01
MIN_DISTANCE_M = 1.0
MIN_POSES = 20
MAX_DELAY_NS = 30_000_000  # of the 200 ms between two pairs


def truth_at(stamps, feed_log, truth):
    """TUM rows of the true pose at those of the estimate's stamps that leave no doubt which pair was
    seen. Stamps are those of arrival, the loopback driver promises nothing of its own: a frame is of
    the pair shown last, unless emulation delayed it beyond the next one."""
    poses = [line.split()[1:] for line in truth.read_text().splitlines()
             if line and not line.startswith("#")]
    shown = [line.split() for line in feed_log.read_text().splitlines()]
    shown_ns = [int(row[0]) for row in shown if len(row) == 2]  # the last line may be half
    stamps_ns = [int(stamp.replace(".", "")) for stamp in stamps]
    lines = [bisect.bisect_right(shown_ns, stamp_ns) - 1 for stamp_ns in stamps_ns]
    frames_of = collections.Counter(lines)
    return [" ".join([stamp, *poses[int(shown[line][1])]])
            for stamp, stamp_ns, line in zip(stamps, stamps_ns, lines)
            if frames_of[line] == 1 and 0 <= stamp_ns - shown_ns[line] <= MAX_DELAY_NS]


def step_errors(truth_rows, pose_rows):
    """By how much each step is longer or shorter than the true one, m, the least first."""
    true_at = {row.split()[0]: [float(word) for word in row.split()[1:4]] for row in truth_rows}
    both = [(true_at[stamp], [float(word) for word in words[:3]])
            for stamp, *words in (row.split() for row in pose_rows) if stamp in true_at]
    return sorted(abs(math.dist(a[0], b[0]) - math.dist(a[1], b[1]))
                  for a, b in itertools.pairwise(both))


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
    poses = estimate.read_text().splitlines() if estimate.exists() else []
    rows = truth_at([pose.split()[0] for pose in poses], words.results / "feed.log", words.truth)
    say(len(rows) >= MIN_POSES, f"at least {MIN_POSES} poses can be judged",
        f"{len(rows)} of {len(poses)}")
    if len(rows) < 2:
        return
    truth = words.results / "truth.tum"
    truth.write_text("\n".join(rows) + "\n")
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
    errors = step_errors(rows, poses)
    worst_m = errors[len(errors) * 9 // 10]
    say(worst_m <= MAX_STEP_ERROR_M, f"nine of ten steps are right within {MAX_STEP_ERROR_M} m",
        f"{worst_m:.5f} m, half of them within {errors[len(errors) // 2]:.5f} m")


if __name__ == "__main__":
    main()
