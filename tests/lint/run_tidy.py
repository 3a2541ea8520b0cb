#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs clang-tidy over the translation units of a build and fails on any finding.

    run_tidy.py ROOT BUILD [--jobs N] [FOLDER...]     (default: src drivers platform)

A unit that was clean is not looked at again until it, a project header that it includes, its
command line, .clang-tidy or clang-tidy itself changes: the proof is a file in BUILD/tidy_clean.
"""
import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

INCLUDE = re.compile(rb'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)


def command_for_clang(entry):
    """The compile command without what only gcc understands: ccache, precompiled headers."""
    words = shlex.split(entry["command"])
    first = next(i for i, word in enumerate(words) if re.search(r"(\+\+|g?cc|clang)[-.\d]*$", word))
    kept, skip_next = ["clang++"], False
    for word in words[first + 1:]:
        if skip_next:
            skip_next = False
        elif word == "-include":
            skip_next = True
        elif word not in ("-Winvalid-pch", "-Werror"):
            kept.append(word)
    return kept


def headers_of(root, path, seen):
    """The project headers that `path` includes, directly or not."""
    for name in INCLUDE.findall(path.read_bytes()):
        for base in (root / "src", root, root / "tests"):
            header = base / name.decode()
            if header.is_file() and header not in seen:
                seen.add(header)
                headers_of(root, header, seen)
    return seen


def fingerprint(root, path, command, common):
    digest = hashlib.sha256(common)
    digest.update(" ".join(command).encode())
    for file in [path, *sorted(headers_of(root, path, set()))]:
        digest.update(str(file).encode() + b"\0" + file.read_bytes())
    return digest.hexdigest()


def units(root, build, folders):
    """(source, command) of every translation unit below the folders."""
    entries = json.loads((build / "compile_commands.json").read_text())
    for entry in entries:
        path = pathlib.Path(entry["file"]).resolve()
        if path.is_relative_to(root) and path.relative_to(root).parts[0] in folders:
            yield path, command_for_clang(entry)


def run_one(root, path, command):
    arguments = ["clang-tidy", "--quiet", f"--config-file={root}/.clang-tidy", str(path), "--"]
    done = subprocess.run(arguments + command[1:], capture_output=True, text=True, cwd=root)
    return done.returncode, done.stdout or done.stderr


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("folders", nargs="*", default=["src", "drivers", "platform"])
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    root, build = options.root.resolve(), options.build.resolve()

    version = subprocess.run(["clang-tidy", "--version"], check=True, capture_output=True).stdout
    common = version + (root / ".clang-tidy").read_bytes()
    clean = build / "tidy_clean"
    clean.mkdir(exist_ok=True)
    due, total = {}, 0
    for path, command in units(root, build, options.folders):
        total += 1
        mark = clean / fingerprint(root, path, command, common)
        if not mark.exists():
            due[path] = (command, mark)

    failed = 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        jobs = {pool.submit(run_one, root, path, command): (path, mark)
                for path, (command, mark) in due.items()}
        for job in concurrent.futures.as_completed(jobs):
            path, mark = jobs[job]
            status, text = job.result()
            if status == 0:
                mark.touch()
            else:
                failed += 1
                print(f"== {path.relative_to(root)}\n{text}", flush=True)
    print(f"clang-tidy: {total} files, {len(due)} looked at, {failed} with findings")
    return 1 if failed or total == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
