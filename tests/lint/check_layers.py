#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Includes go downwards only, and OpenCV stays out of headers.

    app → io → vo → kernels → geometry → base        drivers → platform → base        (app joins both)
    io, drivers and app → messages → base
"""
import pathlib
import re
import sys

import project_files

# What each layer may include besides itself.
BELOW = {
    "base": set(),
    "messages": {"base"},
    "geometry": {"base"},
    "kernels": {"geometry", "base"},
    "vo": {"kernels", "geometry", "base"},
    "io": {"messages", "vo", "kernels", "geometry", "base"},
    "platform": {"base"},
    "drivers": {"platform", "messages", "geometry", "base"},
    "app": {"io", "vo", "kernels", "geometry", "base", "messages", "drivers", "platform"},
}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def layer_of(path):
    """The layer a file belongs to; None for the tests, which may include everything."""
    first, *rest = path.parts
    return rest[0] if first == "src" else first if first in BELOW else None


def faults_in(root, path):
    layer = layer_of(path.relative_to(root))
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        bracket, name = match.groups()
        where = f"{path.relative_to(root)}:{number}"
        if path.suffix == ".h" and name.startswith("opencv"):
            yield f"{where}: OpenCV in a header costs every includer seconds; use it in a .cpp"
        if bracket == "<" or layer is None:
            continue
        target = name.split("/")[0]
        if "/" not in name or target not in BELOW:
            yield f'{where}: "{name}" is no path from the root of the project or of src/'
        elif target != layer and target not in BELOW[layer]:
            allowed = ", ".join(sorted(BELOW[layer])) or "nothing"
            yield f'{where}: {layer} includes "{name}"; besides itself it may include {allowed}'


def faults(root):
    root = pathlib.Path(root)
    for path in project_files.code_files(root):
        yield from faults_in(root, path)


if __name__ == "__main__":
    found = list(faults(sys.argv[1]))
    print("\n".join(found))
    sys.exit(1 if found else 0)
