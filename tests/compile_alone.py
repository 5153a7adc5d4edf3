#!/usr/bin/env python3
"""Checks that C++ files compile alone: compile_alone.py BUILD [FILE…], by default all source files of the build.

BUILD is a build folder whose files are not grouped (./dev build); of each FILE (.cpp) its command is executed without code
generation. A whole build compiles several files together, which hides an #include that one of them lacks.
"""
import json
import os
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path


def check(entry):
    """Compiles a file without output; returns what the compiler reported, or an empty text."""
    command = shlex.split(entry["command"])
    if Path(command[0]).name == "ccache":
        command = command[1:]
    output = command.index("-o")
    command = [word for word in command[:output] + command[output + 2:] if not word.startswith("-O")] + ["-fsyntax-only"]
    done = subprocess.run(command, cwd=entry["directory"], capture_output=True, text=True)
    return done.stderr or f"exit code {done.returncode}\n" if done.returncode else ""


def main(build, files):
    project = Path(__file__).resolve().parent.parent
    entries = {Path(entry["file"]).resolve(): entry for entry in json.loads((Path(build) / "compile_commands.json").read_text())}
    generated = Path(build).resolve()
    wanted = [Path(file).resolve() for file in files] or [file for file in entries if generated not in file.parents]
    known = [file for file in wanted if file in entries]  # the example projects in doc/ are not part of the build
    failed = 0
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for index, (file, errors) in enumerate(zip(known, pool.map(check, [entries[file] for file in known])), 1):
            if errors:
                failed += 1
                print(f"{file.relative_to(project)} does not compile alone:\n{errors}", file=sys.stderr)
            if sys.stderr.isatty():
                print(f"\r{index} of {len(known)} files", end="", file=sys.stderr, flush=True)
    print(f"{len(known) - failed} of {len(known)} files compile alone")
    return 1 if failed else 0


if __name__ == "__main__":
    if len(sys.argv) < 2:
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    sys.exit(main(sys.argv[1], sys.argv[2:]))
