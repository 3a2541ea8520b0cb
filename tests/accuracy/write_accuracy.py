#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures the accuracy and writes it into a page, with its plots in the folder named like it.

    write_accuracy.py PROGRAM PAGE
"""
import pathlib
import sys

import plots
import recordings
import settings
from replays import Replay, replay_all

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from measured_page import fill_page, table

NOTHING = "–"


def three_digits(value):
    """Of a length in mm."""
    return f"{value:#.3g}".rstrip(".") if value < 1000 else f"{value:.0f}"


def or_nothing(value, text):
    return text(value) if value is not None else NOTHING


def drift(figures):
    return or_nothing(figures["drift_percent"], lambda d: f"{d:.2f}")


def turn(figures):
    return or_nothing(figures["drift_deg_per_m"], lambda d: f"{d:.3f}")


def rpe_mm(figures):
    return three_digits(1000 * figures["rpe_rmse_m"])


def ate_mm(figures):
    return three_digits(1000 * figures["ate_rmse_m"])


def scale(figures):
    return or_nothing(figures.get("scale_error"), lambda s: f"{100 * s:+.2f}".replace("-", "−"))


def doubtful_count(figures):
    return figures["degraded_frames"] + figures["lost_frames"]


def doubtful(figures):
    return f"{figures['degraded_frames']}, {figures['lost_frames']}" if doubtful_count(figures) else ""


def mark(figures):
    """Behind a figure of a run that was not followed all the way."""
    return " †" if doubtful_count(figures) > 0.01 * figures["frames"] else ""


class Measured:
    """Every table of the page, by its name there."""

    def __init__(self, program, at_hand):
        self.at_hand = at_hand
        self.ablations = [("as configured", "")] + settings.known_ablations(program)
        self.figures = replay_all(program, self.width_runs() + self.ablation_runs() + self.stride_runs())

    def width_runs(self):
        return [Replay(r, width) for r in self.at_hand for width in settings.widths_of(r)]

    def ablation_runs(self):
        return [Replay(r, setting=setting) for _, setting in self.ablations for r in self.at_hand]

    def stride_runs(self):
        return [Replay(r, stride=stride) for r in self.at_hand if r.name in settings.STRIDE_RECORDINGS
                for stride in settings.STRIDES]

    def widths(self):
        rows = []
        for run in self.width_runs():
            f = self.figures[run]
            is_first = run.width_px == settings.WIDTHS_PX[0]
            rows.append([run.recording.name if is_first else "", f"{f['width']}x{f['height']}", drift(f),
                         turn(f), rpe_mm(f), ate_mm(f), scale(f), doubtful(f)])
        return table(["recording", "thumbnail", "drift, %", "deg/m", "RPE, mm", "ATE, mm", "scale, %",
                      "degraded, lost"], rows)

    def ablation_table(self, at, cell):
        rows = []
        for name, setting in self.ablations:
            run_of = lambda r: self.figures[Replay(r, setting=setting)]
            rows.append([name] + [cell(run_of(r)) + mark(run_of(r)) for r in at])
        return table([""] + [r.name for r in at], rows)

    def exchanged(self):
        return ("Drift, %:\n\n" + self.ablation_table([r for r in self.at_hand if r.is_long], drift)
                + "\nRPE, mm a frame:\n\n" + self.ablation_table(self.at_hand, rpe_mm))

    def strides(self):
        rows = []
        for run in self.stride_runs():
            f = self.figures[run]
            rows.append([run.recording.name if run.stride == 1 else "", run.stride, f["frames"], drift(f),
                         turn(f), rpe_mm(f), ate_mm(f), doubtful(f)])
        return table(["recording", "every n-th frame", "frames", "drift, %", "deg/m", "RPE, mm", "ATE, mm",
                      "degraded, lost"], rows)

    def uncertainty(self):
        """Of rendered drives: other truths are less exact than what is measured."""
        rows = []
        for run in self.width_runs():
            f = self.figures[run]
            if not run.recording.scene or run.width_px not in settings.UNCERTAINTY_WIDTHS_PX:
                continue
            cells = [or_nothing(f[key], lambda n: f"{n:.2f}") for key in ("nees_motion", "nees_pose")]
            rows.append([run.recording.name, f"{f['width']}x{f['height']}"] + cells)
        return table(["recording", "thumbnail", "motions", "poses"], rows)

    def plot(self, folder):
        folder.mkdir(exist_ok=True)
        plots.plot_widths(folder / "width.png", {
            r: [(run.width_px, self.figures[run]) for run in self.width_runs() if run.recording == r]
            for r in self.at_hand})
        plots.plot_ablations(folder / "exchanged.png", {
            r: [(name, self.figures[Replay(r, setting=setting)]) for name, setting in self.ablations]
            for r in self.at_hand})


def main(program, page):
    page = pathlib.Path(page)
    measured = Measured(program, recordings.prepare(program))
    fill_page(page, lambda name: getattr(measured, name)())
    measured.plot(page.with_suffix(""))


if __name__ == "__main__":
    main(*sys.argv[1:])
