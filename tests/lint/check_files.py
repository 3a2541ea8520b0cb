#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every source file names its licence, stays short and says what things are; no file holds the
path of somebody's own machine."""
import pathlib
import re
import sys

import project_files

MAX_LINES = 300
SPDX = "SPDX-License-Identifier: Apache-2.0"
# They say that something exists, not what it is.
EMPTY_WORD = re.compile(r"manager|helper|util", re.IGNORECASE)
TYPE = re.compile(r"^\s*(?:class|struct|union|enum(?: class)?|using)\s+(?:\[\[\w+\]\]\s*)?(\w+)")
OWN_PATH = re.compile(r"(?<![\w.$}~-])/(?:home|Users|work|root)/\w")


def faults_in_source(path, name):
    lines = path.read_text().splitlines()
    if not any(SPDX in line for line in lines[:2]):
        yield f"{name}:1: no `{SPDX}` in the first two lines"
    if len(lines) > MAX_LINES:
        yield f"{name}: {len(lines)} lines, at most {MAX_LINES} are allowed; split it"
    if EMPTY_WORD.search(path.name):
        yield f"{name}: the file's name says manager, helper or util; say what it does"
    if path.suffix not in project_files.CODE_SUFFIXES:
        return
    for number, line in enumerate(lines, 1):
        match = TYPE.match(line)
        if not match:
            continue
        if EMPTY_WORD.search(match[1]):
            yield f"{name}:{number}: type {match[1]} says manager, helper or util"
        if match[1].endswith("Data"):
            yield f"{name}:{number}: type {match[1]} ends in Data; everything is data"


def faults(root):
    root = pathlib.Path(root)
    for path in project_files.source_files(root):
        yield from faults_in_source(path, path.relative_to(root))
    for path in project_files.text_files(root):
        for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
            if OWN_PATH.search(line):
                yield f"{path.relative_to(root)}:{number}: a path of one machine: {line.strip()}"


if __name__ == "__main__":
    found = list(faults(sys.argv[1]))
    print("\n".join(found))
    sys.exit(1 if found else 0)
