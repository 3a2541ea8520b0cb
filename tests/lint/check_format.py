#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every C++ file is as clang-format would write it. `clang-format -i FILE` repairs."""
import pathlib
import re
import subprocess
import sys

import project_files


def faults(root):
    root = pathlib.Path(root).resolve()
    files = [str(path) for path in project_files.code_files(root)]
    if not files:
        return []
    style = f"--style=file:{root}/.clang-format"
    done = subprocess.run(["clang-format", style, "--dry-run", "-Werror", *files],
                          capture_output=True, text=True)
    names = re.findall(r"^(\S+?):\d+:\d+: error:", done.stderr, re.MULTILINE)
    if done.returncode != 0 and not names:
        return [done.stderr]
    return [f"{pathlib.Path(name).relative_to(root)}: run clang-format -i on it"
            for name in sorted(set(names))]


if __name__ == "__main__":
    found = list(faults(sys.argv[1]))
    print("\n".join(found))
    sys.exit(1 if found else 0)
