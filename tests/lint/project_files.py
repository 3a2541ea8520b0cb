# SPDX-License-Identifier: Apache-2.0
"""Which files of the project the linters look at."""
import pathlib

CODE_FOLDERS = ("src", "drivers", "platform", "tests")
CODE_SUFFIXES = (".h", ".cpp")
SCRIPT_SUFFIXES = (".py", ".sh", ".cmake")


def _walk(root):
    for path in sorted(root.rglob("*")):
        parts = path.relative_to(root).parts
        if path.is_file() and parts[0] not in ("build", "out", ".git", ".cache"):
            if "__pycache__" not in parts:
                yield path


def code_files(root, folders=CODE_FOLDERS):
    """C++ sources and headers below the given folders."""
    for path in _walk(pathlib.Path(root)):
        if path.suffix in CODE_SUFFIXES and path.relative_to(root).parts[0] in folders:
            yield path


def source_files(root):
    """Everything that people write as source: C++, scripts, build files."""
    root = pathlib.Path(root)
    wanted = CODE_SUFFIXES + SCRIPT_SUFFIXES
    for path in _walk(root):
        is_named = path.name == "CMakeLists.txt" or path.suffix in wanted
        if is_named or path.relative_to(root) == pathlib.Path(".ci/run"):
            yield path


def text_files(root):
    """Every file of the project that holds text."""
    for path in _walk(pathlib.Path(root)):
        if b"\0" not in path.read_bytes()[:4096]:
            yield path
