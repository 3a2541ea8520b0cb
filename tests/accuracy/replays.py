# SPDX-License-Identifier: Apache-2.0
"""Replays of recordings under one setting each, two at a time, and what they tell."""
import concurrent.futures
import dataclasses
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import time

import recordings

FRAMES_A_SECOND = 20  # of the rendered scenes
EYES_SWAPPED = "left and right are swapped"  # what ends a replay early


@dataclasses.dataclass(frozen=True)
class Replay:
    recording: recordings.Recording
    width_px: int = 320
    setting: str = ""  # `key=value`, where one differs from the defaults
    stride: int = 1
    injections: tuple = ()  # as for `replay --inject`, in their order

    def __str__(self):
        words = [self.recording.name, f"{self.width_px} px", self.setting,
                 f"stride {self.stride}" if self.stride > 1 else "", *self.injections]
        return ", ".join(word for word in words if word)


def read_positions(path):
    """Of a TUM trajectory: stamp in ms to position."""
    rows = [line.split() for line in path.read_text().splitlines() if not line.startswith("#")]
    return {round(1000 * float(row[0])): [float(word) for word in row[1:4]] for row in rows}


def scale_error(truth, estimate):
    """Length of the estimated path over the true one, less 1. Both are measured in steps of a
    second: jitter from frame to frame is no path."""
    stamps = sorted(truth.keys() & estimate.keys())[::FRAMES_A_SECOND]
    length = lambda at: sum(math.dist(at[a], at[b]) for a, b in zip(stamps, stamps[1:]))
    return length(estimate) / length(truth) - 1


def replay(program, run):
    """@return the figures of `--stats`, and `scale_error` of a rendered scene."""
    source = recordings.folder_of(run.recording)
    with tempfile.TemporaryDirectory() as folder:
        stats = pathlib.Path(folder) / "stats.json"
        trajectory = pathlib.Path(folder) / "trajectory.tum"
        words = [program, "replay", source, "--width", str(run.width_px), "--stride",
                 str(run.stride), "--stats", stats]
        if run.setting:
            words += ["--set", run.setting]
        if run.recording.truth_noise:
            words += ["--truth-noise", run.recording.truth_noise]
        for injection in run.injections:
            words += ["--inject", injection]
        if run.recording.scene:
            words += ["--trajectory", trajectory, "--format", "tum"]
        done = subprocess.run(words, capture_output=True, text=True)
        if done.returncode != 0 and EYES_SWAPPED not in done.stderr:
            raise SystemExit(f"{run}: exit code {done.returncode}\n{done.stderr}")
        figures = json.loads(stats.read_text())
        if done.returncode != 0:
            return figures
        if run.recording.scene:
            figures["scale_error"] = scale_error(read_positions(source / "groundtruth.tum"),
                                                 read_positions(trajectory))
        return figures


def summary(figures):
    drift = figures["drift_percent"]
    rpe_m = figures["rpe_rmse_m"]
    words = [f"drift {drift:.2f} %" if drift is not None else "",
             f"RPE {1000 * rpe_m:.2f} mm" if rpe_m is not None else "",
             f"{figures['degraded_frames']} degraded" if figures["degraded_frames"] else "",
             f"{figures['lost_frames']} lost" if figures["lost_frames"] else ""]
    return ", ".join(word for word in words if word)


def replay_all(program, runs, at_once=2):
    """@return run → figures."""
    runs = list(dict.fromkeys(runs))  # what several tables ask for is done once
    started_at = time.monotonic()
    figures = {}
    with concurrent.futures.ThreadPoolExecutor(max_workers=at_once) as pool:
        pending = {pool.submit(replay, program, run): run for run in runs}
        try:
            for done in concurrent.futures.as_completed(pending):
                run = pending[done]
                figures[run] = done.result()
                print(f"{len(figures):3}/{len(runs)} {time.monotonic() - started_at:4.0f} s  "
                      f"{run}: {summary(figures[run])}", file=sys.stderr, flush=True)
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
    return figures
