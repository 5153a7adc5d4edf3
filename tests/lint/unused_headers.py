#!/usr/bin/env python3
"""Finds headers of lib/ that no file of the product includes, except those that doc/sdk.md and doc/from_aria.md name for users.

usage: unused_headers.py [FOLDER]      FOLDER: the source tree, by default that of this file

A header that only its own .cpp file, tests or benchmarks include is not part of the product, and is deleted or moved to testing/.
Exit code 1 if there are any.
"""
import re
import subprocess
import sys
from pathlib import Path

INCLUDE = re.compile(r'^\s*#\s*include\s*["<](?:robosim/)?([^">]+)', re.M)
NOT_PRODUCT = re.compile(r"_test\.cpp$|/testing/|^tests/|^doc/|^apps/robosim_bench/")
FOR_USERS = re.compile(r"`([a-z_/0-9]+\.h)`")
USERS_PAGES = ("doc/sdk.md", "doc/from_aria.md")


def unused_headers(texts, for_users):
    """Sorted paths of unused headers. @param texts {path: content} of all C++ files @param for_users paths in #include"""
    included = set()
    for path, text in texts.items():
        if not NOT_PRODUCT.search(path):
            own = re.sub(r"^lib/[a-z]+/|\.cpp$", "", path) + ".h"
            included |= {file for file in INCLUDE.findall(text) if file != own}
    headers = {path: path.split("/", 2)[2] for path in texts if path.startswith("lib/") and path.endswith(".h") and "/testing/" not in path}
    return sorted(path for path, file in headers.items() if file not in included | for_users)


def main():
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parents[2]
    files = subprocess.run(["git", "ls-files", "-z", "--", "*.h", "*.cpp"], cwd=root, check=True, capture_output=True, text=True).stdout
    texts = {file: (root / file).read_text() for file in files.split("\0")[:-1] if (root / file).exists()}
    unused = unused_headers(texts, {header for page in USERS_PAGES for header in FOR_USERS.findall((root / page).read_text())})
    for path in unused:
        print(f"{path}: no file of the product includes it; delete it, move it to testing/, or list it in doc/sdk.md", file=sys.stderr)
    sys.exit(len(unused) > 0)


if __name__ == "__main__":
    main()
