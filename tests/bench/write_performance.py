#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes what `darkling bench --json` measured into a page, between the marks that name it.

    write_performance.py FOLDER PAGE

FOLDER holds kernels_*.json, stages.json and sweep.json; in PAGE, what stands between
`<!-- measured: NAME -->` and `<!-- end -->` is replaced.
"""
import json
import pathlib
import platform
import re
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from measured_page import fill_page, table


def percent(share):
    return f"{100 * share:.0f} %"


def machine(reports):
    name = platform.processor() or platform.machine()
    info = pathlib.Path("/proc/cpuinfo")
    if info.exists():
        models = re.findall(r"^(?:model name|Model)\s*:\s*(.+)$", info.read_text(), re.MULTILINE)
        name = models[0] if models else name
    peaks = reports["kernels"]["320x240"]["peaks"]
    rows = [[p["kernels"], f"{p['byte_operations_per_ns']:.0f}", f"{p['float_operations_per_ns']:.0f}"]
            for p in peaks]
    return f"{name}, one core.\n\n" + table(["registers", "byte Gops/s", "float Gops/s"], rows)


def costs(reports):
    rows = []
    for k in reports["kernels"]["320x240"]["kernels"]:
        cost = k["cost_per_unit"]
        rows.append([k["kernel"], k["unit"], f"{cost['bytes']:.0f}", f"{cost['byte_operations']:.0f}",
                     f"{cost['float_operations']:.0f}", f"{k['working_set_bytes'] / 1024:.0f}",
                     f"{k['copy_bytes_per_ns']:.0f}"])
    return table(["kernel", "unit", "bytes", "byte ops", "float ops", "set, KiB", "copy, GB/s"], rows)


def kernels(reports):
    rows = []
    for k in reports["kernels"]["320x240"]["kernels"]:
        for v in k["variants"]:
            rows.append([k["kernel"] if v["kernels"] == "ref" else "", v["kernels"],
                         f"{v['ns_per_unit']:.3g}", f"{v['gain_over_ref']:.1f}", f"{v['bound_ns']:.2g}",
                         v["nearer_to"], percent(v["ratio"])])
    return table(["kernel", "variant", "ns a unit", "over ref", "bound, ns", "bound by", "achieved"],
                 rows)


def sizes(reports):
    by_size = reports["kernels"]
    names = sorted(by_size, key=lambda size: int(size.split("x")[0]))
    rows = []
    for i, k in enumerate(by_size[names[0]]["kernels"]):
        best = [by_size[name]["kernels"][i]["variants"][-1] for name in names]
        rows.append([k["kernel"], best[0]["kernels"]] +
                    [f"{v['ns_per_unit']:.3g} ({v['gain_over_ref']:.1f})" for v in best])
    return table(["kernel", "variant"] + names, rows)


def frame(reports):
    s = reports["stages"]
    rows = []
    for kind, name in (("keyframes", "keyframe"), ("others", "other frame")):
        c = s[kind]
        if c["frames"] == 0:
            continue
        work = c["work"]
        rows.append([name, f"{work['bytes'] / 1e6:.2f}", f"{work['byte_operations'] / 1e6:.1f}",
                     f"{work['float_operations'] / 1e6:.2f}", f"{c['memory_us']:.0f}",
                     f"{c['arithmetic_us']:.0f}", f"{c['kernels_us']:.0f}", f"{c['frame_us']:.0f}",
                     percent(c["ratio"])])
    return table(["", "MB", "byte Mops", "float Mops", "memory, µs", "arithmetic, µs", "kernels, µs",
                  "frame, µs", "achieved"], rows)


def stages(reports):
    s = reports["stages"]
    rows = []
    for name, kinds in s["stage_us"].items():
        cells = [f"{kinds[kind][p]:.0f}" if kinds[kind] else "–"
                 for kind in ("all", "keyframes", "others") for p in ("p50", "p99")]
        rows.append([name] + cells)
    return (f"`{s['source']}` at {s['width']}x{s['height']} px, kernels {s['kernels']}, microseconds; "
            f"rectification is {100 * s['rectify_share']:.1f} % of the time of all frames.\n\n"
            + table(["stage", "all p50", "p99", "keyframes p50", "p99", "others p50", "p99"], rows))


def exponents(series):
    text = [f"{series[key]:.2f}" if series[key] is not None else "–"
            for key in ("keyframe_exponent", "other_exponent")]
    return f"\nExponents: {text[0]} for keyframes, {text[1]} for other frames.\n"


def width(reports):
    series = reports["sweep"]["by_width"]
    rows = [[f"{p['width']}x{p['height']}", f"{p['keyframe_us']:.0f}",
             f"{p['keyframe_ns_per_pixel']:.1f}", f"{p['other_us']:.0f}",
             f"{p['other_ns_per_pixel']:.2f}"] for p in series["settings"]]
    return table(["thumbnail", "keyframe, µs", "ns a pixel", "other frame, µs", "ns a pixel"],
                 rows) + exponents(series)


def points(reports):
    series = reports["sweep"]["by_points"]
    rows = [[p["points_per_level"], f"{p['keyframe_us']:.0f}", f"{p['other_us']:.0f}"]
            for p in series["settings"]]
    return table(["points a level", "keyframe, µs", "other frame, µs"], rows) + exponents(series)


WRITERS = {f.__name__: f
           for f in (machine, costs, kernels, sizes, frame, stages, width, points)}


def read_reports(folder):
    read = lambda name: json.loads((folder / name).read_text())
    by_size = [read(path.name)["kernels"] for path in folder.glob("kernels_*.json")]
    return {"kernels": {f"{k['width']}x{k['height']}": k for k in by_size},
            "stages": read("stages.json")["stages"], "sweep": read("sweep.json")["sweep"]}


def main(folder, page):
    reports = read_reports(pathlib.Path(folder))
    fill_page(pathlib.Path(page), lambda name: WRITERS[name](reports))


if __name__ == "__main__":
    main(*sys.argv[1:])
