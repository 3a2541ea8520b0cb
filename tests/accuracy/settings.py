# SPDX-License-Identifier: Apache-2.0
"""The questions: at which widths, with what exchanged, and at which steps between frames."""
import subprocess

WIDTHS_PX = (96, 128, 160, 240, 320, 480, 640)
UNCERTAINTY_WIDTHS_PX = (160, 320)
STRIDES = (1, 2, 3)
STRIDE_RECORDINGS = ("kitti_06", "euroc_mh01_a")

# What is exchanged, a line each: its name in the tables, and the setting. Lines that this build does
# not know, or that are its defaults, are left out.
ABLATIONS = (
    ("intensity", "descriptor=intensity"),
    ("block matching", "stereo=block"),
    ("100 points", "points_per_level=100"),
    ("250 points", "points_per_level=250"),
    ("500 points", "points_per_level=500"),
    ("1000 points", "points_per_level=1000"),
    ("2000 points", "points_per_level=2000"),
    ("refinement", "refinement=true"),
    ("no refinement", "refinement=false"),
    ("window of 3 keyframes", "window_keyframes=3"),
    ("window of 7 keyframes", "window_keyframes=7"),
    ("200 window points", "window_points=200"),
    ("1000 window points", "window_points=1000"),
)


def widths_of(recording):
    return [width for width in WIDTHS_PX if width <= recording.width_px]


def print_config(program, setting=None):
    """@return the configuration as text, nothing where `setting` is refused; and why."""
    words = [program, "replay", "--print-config"] + (["--set", setting] if setting else [])
    done = subprocess.run(words, capture_output=True, text=True)
    return (done.stdout if done.returncode == 0 else None), done.stderr.strip()


def known_ablations(program):
    default, _ = print_config(program)
    known = []
    for name, setting in ABLATIONS:
        config, refusal = print_config(program, setting)
        if config is None:
            print(f"{setting} is left out: {refusal}", flush=True)
        elif config != default:
            known.append((name, setting))
    return known
