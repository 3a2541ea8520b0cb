#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds what the service published in the guest against the truth of the drive that was played.

The drive was played forth and back at the guest's own time: the feeder's log says which pair of the
recording was shown when, which makes a truth by the guest's clock out of the recording's."""
import argparse
import json
import pathlib
import subprocess

# A replay of the same drive has an ATE of 11 mm and an RPE of 2 mm; these are what nobody would call
# tracking, with a margin for other processors.
MAX_ATE_M = 0.05
MAX_RPE_M = 0.01
MIN_DISTANCE_M = 1.0


def retimed_truth(feed_log, truth):
    """TUM rows of the pairs shown, by the guest's clock."""
    poses = [line.split()[1:] for line in truth.read_text().splitlines()
             if line and not line.startswith("#")]
    rows = []
    for line in feed_log.read_text().splitlines():
        fields = line.split()
        if len(fields) == 2:  # the last line may be half
            stamp_s = f"{int(fields[0]) // 10**9}.{int(fields[0]) % 10**9:09d}"
            rows.append(" ".join([stamp_s, *poses[int(fields[1])]]))
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
    poses = len(estimate.read_text().splitlines()) if estimate.exists() else 0
    say(poses >= 50, "poses were published with stamps", f"{poses} poses")
    if poses < 2:
        return
    truth = words.results / "truth.tum"
    truth.write_text(retimed_truth(words.results / "feed.log", words.truth))
    done = subprocess.run([words.darkling, "eval", "--json", str(truth), str(estimate)],
                          capture_output=True, text=True)
    if done.returncode != 0:
        say(False, "the motion can be judged", done.stderr.strip())
        return
    error = json.loads(done.stdout)
    say(error["distance_m"] >= MIN_DISTANCE_M, f"it drove at least {MIN_DISTANCE_M} m",
        f"{error['distance_m']:.2f} m")
    say(error["ate_rmse_m"] <= MAX_ATE_M, f"its path is the true one within {MAX_ATE_M} m",
        f"{error['ate_rmse_m']:.4f} m")
    say(error["rpe_rmse_m"] <= MAX_RPE_M, f"so is each motion within {MAX_RPE_M} m",
        f"{error['rpe_rmse_m']:.5f} m")


if __name__ == "__main__":
    main()
