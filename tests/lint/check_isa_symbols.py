#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Files compiled for a wider instruction set define nothing the linker may share.

An inline function that a kernel file instantiates is emitted as a weak symbol; the linker keeps one
copy for the whole program, and when it keeps the AVX2 one, processors without AVX2 crash far away
from any kernel.

    check_isa_symbols.py OBJECT...
"""
import re
import subprocess
import sys

ISA_OBJECT = re.compile(r"_(sse41|avx2|neon)\.cpp\.o$")
# nm's letters for weak, unique and common definitions.
SHARED = re.compile(r"^\S*\s+([WVuC])\s+(.+)$")


def faults(objects):
    for name in filter(ISA_OBJECT.search, objects):
        symbols = subprocess.run(["nm", "-C", "--defined-only", name], check=True,
                                 capture_output=True, text=True).stdout
        for line in symbols.splitlines():
            match = SHARED.match(line)
            if match:
                yield f"{name}: defines {match[2]}, which the linker may use everywhere"


if __name__ == "__main__":
    found = list(faults(sys.argv[1:]))
    print("\n".join(found))
    checked = sum(1 for name in sys.argv[1:] if ISA_OBJECT.search(name))
    print(f"{checked} kernel objects looked at")
    sys.exit(1 if found or checked == 0 else 0)
