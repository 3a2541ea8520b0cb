# SPDX-License-Identifier: Apache-2.0
"""How often a motion that claims to be right is not."""
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from measured_page import table


def without_flaws(recording, figures):
    """@return the figures, without the errors that are the truth's."""
    if figures["confidently_wrong"] is None:
        return figures
    wrong = set(figures["confidently_wrong_frames"]) - set(recording.flawed_truth)
    return figures | {"confidently_wrong": len(wrong)}


def judged(figures):
    """Those with a truth: not what was refused at once."""
    return [f for f in figures if f["confidently_wrong"] is not None]


def wrong_percent(figures):
    """@return share of all frames; None for none."""
    of = judged(figures)
    frames = sum(f["frames"] for f in of)
    return 100 * sum(f["confidently_wrong"] for f in of) / frames if frames else None


def cells_of(figures):
    of = judged(figures)
    total = lambda key: sum(f[key] for f in of)
    return [len(of), total("frames"), total("confident_frames"), total("confidently_wrong"),
            f"{wrong_percent(of):.2f}"]


COUNTED = ["runs", "frames", "confident", "of them wrong", "% of frames"]


def by_recording(runs_of, at_hand, figures):
    """@param runs_of  kind → its replays, of which those as configured count."""
    rows = []
    for kind, runs in runs_of.items():
        name = kind
        runs = [run for run in runs if not run.setting]
        for recording in at_hand:
            of = judged(figures[run] for run in runs if run.recording == recording)
            if of:
                rows.append([name, recording.name] + cells_of(of))
                name = ""
        if judged(figures[run] for run in runs):
            rows.append(["", "all"] + cells_of(figures[run] for run in runs))
    return table(["", "recording"] + COUNTED, rows)


def name_of(injection):
    return injection.partition(",")[0].partition("@")[0].partition("=")[0]


def by_injection(runs, figures):
    """A run counts for each of its injections."""
    names = sorted({name_of(injection) for run in runs for injection in run.injections})
    having = lambda name: [figures[run] for run in runs if name in map(name_of, run.injections)]
    return table(["injection"] + COUNTED, [[name] + cells_of(having(name)) for name in names])
