# SPDX-License-Identifier: Apache-2.0
"""The questions: what is injected, at which levels, and what is demanded of the result."""
import dataclasses
import pathlib
import random
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "accuracy"))
from recordings import Recording

# The truths of recordings are not exact: see docs/accuracy.md.
RECORDINGS = (
    Recording("kitti_06", 1226, truth_noise="0.006,0.04"),
    # Between two of its rows, 5 ms apart, its position jumps by 4.9 mm beside the way; rows before
    # and after differ by 2.5 mm each.
    Recording("euroc_mh01_a", 752, is_long=False, truth_noise="0.015,0", flawed_truth=(16,)),
    Recording("mine", 320, "mine,frames=200,width=320,seed=71"),
    Recording("quarry", 320, "quarry,frames=200,width=320,seed=71"),
    Recording("corridor", 320, "corridor,frames=200,width=320,seed=71"),
)
FRAMES = {"kitti_06": 51, "euroc_mh01_a": 163}
RENDERED_FRAMES = 200
DESCRIPTORS = (("bit-planes", ""), ("intensity", "descriptor=intensity"))

BLACKOUT = range(25, 31)
FAULT = range(30, 60)
MOST_WRONG_PERCENT = 0.2  # of the frames of drawn runs
SOON = 5  # frames within which a fault is noticed, and a good stream is used again


@dataclasses.dataclass(frozen=True)
class Case:
    """One injection at one level. What is demanded is of bit-planes."""
    name: str  # in tables
    level: float  # in plots
    injections: tuple
    most_ratio: float = 0  # to the clean run; 0 where nothing is demanded
    most_error: tuple = ()  # (recording or "rendered", %, or mm where it is short)
    may_be_lost: bool = True


def steps(injection):
    """On for ten frames, off for ten, as far as the longest recording goes."""
    return tuple(f"{injection}@{first}:{first + 10}" for first in range(20, RENDERED_FRAMES, 20))


def dark(electrons, rendered, euroc, kitti):
    limits = [("euroc_mh01_a", euroc), ("kitti_06", kitti)]
    return Case(f"electrons={electrons}", electrons, (f"electrons={electrons}",),
                most_error=tuple(limits + ([("rendered", rendered)] if rendered else [])))


def plain(injection, **wanted):
    name, _, level = injection.partition("=")
    return Case(injection, float(level), (injection,), **wanted)


# Group → its cases, in the order of the page.
GROUPS = {
    "brightness": (
        Case("gain=0.5, steps", 0.5, steps("gain=0.5"), most_ratio=1.3),
        Case("gain=2, steps", 2, steps("gain=2"), most_ratio=1.3),
        plain("gamma=0.5", most_ratio=1.3),
        plain("gamma=2", most_ratio=1.3),
        plain("flicker=0.5", most_ratio=1.3)),
    "uneven_light": (plain("lamp=3", most_ratio=1.5), plain("vignette=0.7", most_ratio=1.5)),
    "darkness": (dark(60, 1.0, 0.9, 1.2), dark(15, 2.5, 1.3, 1.3), dark(5, None, 2.5, 1.6)),
    "view": (plain("blur_px=4", most_ratio=2), plain("blur_px=8", may_be_lost=False),
             plain("occlude=0.3", most_ratio=2)),
    "gaps": (Case(f"blackout, {len(BLACKOUT)} frames", 0,
                  (f"blackout@{BLACKOUT.start}:{BLACKOUT.stop}",)),
             plain("drop_every=5", most_ratio=1.5)),
}

# More levels, for the plots only.
PLOTTED = {
    "electrons": (200, 60, 15, 5, 3),
    "blur_px": (2, 4, 8, 12),
    "occlude": (0.1, 0.3, 0.5),
    "lamp": (1, 3, 6),
    "gamma": (0.5, 0.7, 1.4, 2),
    "flicker": (0.25, 0.5, 0.75),
}
PLOTTED_RECORDINGS = ("kitti_06", "mine")

STREAMS = ("black", "white", "constant=128", "noise", "cover=left", "cover=right", "same_eyes",
           "freeze", "swap", "roll_right_deg=3", "skew_ms=100", "tear=both")
STREAM_RECORDINGS = ("euroc_mh01_a", "mine")

# What drawn runs are made of: a name, its levels, and for how many frames (0: for all).
DRAWN = (("electrons", (3, 5, 15, 60), 0), ("gain", (0.25, 0.5, 2, 4), 20), ("gamma", (0.5, 2), 0),
         ("flicker", (0.3, 0.7), 0), ("lamp", (3, 6), 0), ("saturate", (0.2, 0.5), 10),
         ("blur_px", (4, 8, 16), 20), ("occlude", (0.1, 0.3, 0.5), 0), ("drop", (0.05, 0.2), 0),
         ("corrupt", (0.1, 0.5), 0), ("blackout", (), 6), ("freeze", (), 5), ("noise", (), 5),
         ("white", (), 8), ("same_eyes", (), 10), ("cover", ("left", "right"), 10),
         ("tear", ("left", "right", "both"), 10), ("skew_ms", (25, 100), 10),
         ("roll_right_deg", (0.5, 2), 10))


def frame_count(recording):
    return FRAMES.get(recording.name, RENDERED_FRAMES)


def drawn_injections(seed, frames):
    """One to three injections; the same for a seed, whatever else is drawn."""
    draw = random.Random(seed)
    injections = []
    for name, levels, length in draw.sample(DRAWN, draw.randint(1, 3)):
        text = f"{name}={draw.choice(levels)}" if levels else name
        if length:
            first = draw.randrange(5, frames - length)
            text += f"@{first}:{first + length}"
        injections.append(f"{text},seed={seed + 1}")
    return tuple(injections)
