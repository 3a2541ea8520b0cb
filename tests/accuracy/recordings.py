# SPDX-License-Identifier: Apache-2.0
"""What accuracy is measured on: recordings of others, and scenes that are rendered once."""
import dataclasses
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
KEPT_SCENES = ROOT / "build" / "accuracy" / "scenes"


@dataclasses.dataclass(frozen=True)
class Recording:
    name: str
    width_px: int  # of the source
    scene: str = ""  # as for `darkling render`; empty where it is a recording
    is_long: bool = True  # 5 m and more: there is a drift
    truth_noise: str = ""  # as for `replay --truth-noise`, where the truth is not exact
    flawed_truth: tuple = ()  # frames over whose motion the truth itself jumps


# The seeds are used nowhere else: nothing was tuned on these drives.
RECORDINGS = (
    Recording("kitti_06", 1226),
    Recording("euroc_mh01_a", 752, is_long=False),
    Recording("euroc_v101_static", 752, is_long=False),
    Recording("mine", 480, "mine,frames=600,width=480,seed=61"),
    Recording("quarry", 480, "quarry,frames=600,width=480,seed=62"),
    Recording("corridor", 480, "corridor,frames=600,width=480,seed=63"),
    Recording("dark_mine", 480, "mine,frames=200,width=480,seed=64,electrons=100"),
    Recording("even_quarry", 480, "quarry,frames=200,width=480,seed=65,vignetting=0"),
)


def folder_of(recording):
    if recording.scene:
        return KEPT_SCENES / recording.scene
    data = os.environ.get("DARKLING_DATA") or ROOT.parent / "shared" / "data"
    return pathlib.Path(data) / recording.name


def is_rendered(folder):
    """Not where the renderer has changed since."""
    sources = (ROOT / "drivers" / "synthetic").iterdir()
    return folder.is_dir() and folder.stat().st_mtime > max(f.stat().st_mtime for f in sources)


def render(program, recording):
    folder = folder_of(recording)
    unfinished = folder.with_name(folder.name + ".unfinished")
    for old in (folder, unfinished):
        shutil.rmtree(old, ignore_errors=True)
    folder.parent.mkdir(parents=True, exist_ok=True)
    subprocess.run([program, "render", recording.scene, unfinished], check=True)
    unfinished.rename(folder)
    folder.touch()


def prepare(program, wanted=RECORDINGS):
    """Renders what is not there yet.
    @return the recordings that are at hand."""
    at_hand = []
    for recording in wanted:
        folder = folder_of(recording)
        if recording.scene and not is_rendered(folder):
            print(f"rendering {recording.scene}", file=sys.stderr, flush=True)
            render(program, recording)
        if folder.is_dir():
            at_hand.append(recording)
        else:
            print(f"{recording.name} is not at hand and left out: no {folder}", file=sys.stderr,
                  flush=True)
    return at_hand
