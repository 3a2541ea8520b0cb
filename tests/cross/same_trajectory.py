#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The same recording gives the same trajectory, byte for byte, on another architecture.

    same_trajectory.py NATIVE FOREIGN

NATIVE renders each recording and replays it; FOREIGN, the same program of a cross build, replays
that recording with its reference kernels and with its NEON ones. All trajectories are compared as
bytes, seventeen digits a number, and equal they are: x86-64 with a fused mathematics library, AArch64
and ARMv7, which has no fused operation at all. (Rendering is another matter: there the mathematics
libraries do show, so the golden trajectories, rendered anew on each, have a tolerance.)

Exits with 77, which is "skipped", where there is no native program.
"""
import pathlib
import subprocess
import sys
import tempfile

# The last is rectified by us: lens and mounting are part of what must not differ.
RECORDINGS = {
    "mine": [],
    "quarry": [],
    "corridor": [],
    "unrectified": ["--set", "distortion=0.5", "--set", "roll_right_deg=1"],
}
FRAMES, WIDTH = 24, 200
SKIPPED = 77


def run(*words):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}\nended with {done.returncode}:\n{done.stderr}")


def replay(program, recording, kernels, path):
    run(program, "replay", recording, "--width", WIDTH, "--kernels", kernels, "--trajectory", path)
    return path.read_bytes()


def difference(expected, found):
    """What differs between two trajectories, or nothing."""
    if expected == found:
        return None
    rows = [text.decode().splitlines() for text in (expected, found)]
    if len(rows[0]) != len(rows[1]):
        return f"{len(rows[1])} poses instead of {len(rows[0])}"
    apart = [max(abs(float(a) - float(b)) for a, b in zip(one.split(), other.split()))
             for one, other in zip(*rows)]
    first = next(i for i, (one, other) in enumerate(zip(*rows)) if one != other)
    return f"from pose {first} on, by at most {max(apart):.3g}"


def main(native, foreign):
    if not pathlib.Path(native).is_file():
        print(f"No native program {native}; build it with\n"
              "  cmake --preset release && cmake --build --preset release --target darkling")
        return SKIPPED
    failed = False
    for name, keys in RECORDINGS.items():
        with tempfile.TemporaryDirectory(prefix="darkling-test-") as folder:
            folder = pathlib.Path(folder)
            scene = name if not keys else "quarry"
            run(native, "render", scene, folder / name, "--frames", FRAMES, "--width", WIDTH, *keys)
            expected = replay(native, folder / name, "auto", folder / "native.txt")
            if expected.count(b"\n") != FRAMES:
                sys.exit(f"{name}: {FRAMES} frames were rendered, the trajectory has not as many")
            for kernels in ("ref", "neon"):
                found = replay(foreign, folder / name, kernels, folder / f"{kernels}.txt")
                what = difference(expected, found)
                failed = failed or what is not None
                print(f"{name}, {kernels}: {what or 'the same bytes'}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
