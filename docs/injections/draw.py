#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the pictures of docs/injections.md, both eyes side by side: draw.py DARKLING.

The same program gives the same bytes. In 32 levels, which makes half the bytes."""
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

SCENE = "synthetic:quarry,frames=40,width=128,speed=2"
FRAME = 39
PICTURES = {
    "clean": [], "electrons": ["electrons=10"], "gain": ["gain=1.8"], "gamma": ["gamma=2"],
    "saturate": ["saturate=0.3"], "flicker": ["flicker=0.5"], "lamp": ["lamp=6"],
    "vignette": ["vignette=0.9"], "blackout": ["blackout"], "blur_px": ["blur_px=9"],
    "roll_right_deg": ["roll_right_deg=8"], "occlude": ["occlude=0.25"],
    "skew_ms": ["skew_ms=125"], "corrupt": ["corrupt=1,seed=3"],
    "swap": ["swap"], "cover": ["cover=right"], "noise": ["noise"],
}


def paeth(a, b, c):
    return min((a, b, c), key=lambda x: abs(a + b - c - x))


def read_png(path):
    """The rows of an 8-bit grey image."""
    rest = path.read_bytes()[8:]
    packed = b""
    while rest:
        length, kind = struct.unpack(">I4s", rest[:8])
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", rest[8:18])
            assert (depth, colour) == (8, 0), f"{path}: not 8-bit grey"
        elif kind == b"IDAT":
            packed += rest[8:8 + length]
        rest = rest[12 + length:]
    flat = zlib.decompress(packed)
    rows, above = [], bytes(width)
    for y in range(height):
        code, *line = flat[y * (width + 1):(y + 1) * (width + 1)]
        for x in range(width):
            a, b, c = line[x - 1] if x else 0, above[x], above[x - 1] if x else 0
            line[x] = (line[x] + (0, a, b, (a + b) // 2, paeth(a, b, c))[code]) % 256
        rows.append(bytes(line))
        above = rows[-1]
    return rows


def chunk(kind, content):
    whole = kind + content
    return struct.pack(">I", len(content)) + whole + struct.pack(">I", zlib.crc32(whole))


def write_png(path, rows):
    above, lines = bytes(len(rows[0])), b""
    for row in rows:
        lines += b"\2" + bytes((v - w) % 256 for v, w in zip(row, above))
        above = row
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
                     chunk(b"IDAT", zlib.compress(lines, 9)) + chunk(b"IEND", b""))


def draw(darkling, log, injections, folder):
    """The rows of both eyes, a white line between them."""
    options = [word for injection in injections for word in ("--inject", injection)]
    subprocess.run([darkling, "convert", log, folder, "--format", "euroc", *options],
                   check=True, stdout=subprocess.DEVNULL)
    eyes = [read_png(sorted((folder / "mav0" / eye / "data").glob("*.png"))[-1])
            for eye in ("cam0", "cam1")]
    return [bytes(v // 8 * 8 + v // 32 for v in left + b"\xff\xff" + right)
            for left, right in zip(*eyes)]


def main(darkling):
    here = pathlib.Path(__file__).parent
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        log = folder / "scene.lcmlog"
        subprocess.run([darkling, "convert", SCENE, log, "--frames", f"{FRAME - 8}:{FRAME + 1}"],
                       check=True, stdout=subprocess.DEVNULL)
        for name, injections in PICTURES.items():
            write_png(here / f"{name}.png", draw(darkling, log, injections, folder / name))


if __name__ == "__main__":
    main(sys.argv[1])
