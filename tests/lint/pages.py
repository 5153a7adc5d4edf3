#!/usr/bin/env python3
"""Checks the pages in Markdown, and what other files say of them.

usage: pages.py [FOLDER]      FOLDER: the source tree, by default that of this file

- Links to files, pictures and headings (by GitHub's anchors) lead to something, also the paths of pages in comments of code.
- Every row of a table has as many cells as its head, and no empty line divides a table.
- A block of code ends, and a page of doc/ has at most 350 lines.
- README.md, or a page that it names, links to every page of doc/.
Exit code 1 if there are faults, each with file:line.
"""
import os
import re
import sys
from pathlib import Path

LINES_MAX = 350
OMITTED = {"build", "node_modules", ".git", "__pycache__"}
LINK = re.compile(r"\]\(([^()\s]+)\)")
HEADING = re.compile(r"#{1,6}\s+(.*?)\s*#*$")
SEPARATOR = re.compile(r"\|(?:\s*:?-+:?\s*\|)+\s*$")
PAGE_IN_CODE = re.compile(r"(?<![\w./*])doc/[\w/]+\.(?:md|txt)\b(?:#([\w-]+))?")
CODE = {".h", ".cpp", ".py", ".sh", ".mjs", ".js", ".html", ".cmake", ".proto", ".xml", ".txt", ".cfg", ".ini", ""}


def files_of(root):
    files = []
    for folder, folders, names in os.walk(root):
        folders[:] = set(folders) - OMITTED  # which are not entered
        files += [Path(folder, name) for name in set(names) - OMITTED]
    return sorted(path for path in files if path.is_file())


def prose_of(text):
    """Lines with their numbers from 1, without those of blocks of code. @return also the line of a block that does not end, or None"""
    prose, fence, begin = [], None, None
    for number, line in enumerate(text.split("\n"), 1):
        mark = re.match(r"\s*(```+|~~~+)", line)
        if mark and fence is None:
            fence, begin = mark[1], number
        elif mark and line.strip() == fence:
            fence = begin = None
        elif fence is None:
            prose.append((number, line))
    return prose, begin


def anchors_of(prose):
    """GitHub's anchors of the headings."""
    anchors = set()
    for _, line in prose:
        heading = HEADING.match(line)
        if not heading:
            continue
        text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading[1])
        anchor = base = re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-")
        count = 0
        while anchor in anchors:
            count += 1
            anchor = f"{base}-{count}"
        anchors.add(anchor)
    return anchors


def cells_of(row):
    """Number of cells; a bar in code or after a backslash divides none only after a backslash, as on GitHub."""
    return len(re.split(r"(?<!\\)\|", row.strip().strip("|")))


class Pages:
    def __init__(self, root):
        self._root = root
        self._files = files_of(root)
        self._prose = {}
        self.faults = []
        for path in self._files:
            if path.suffix == ".md":
                text = path.read_text(encoding="utf-8")
                self._prose[path], unended = prose_of(text)
                if unended:
                    self._fault(path, unended, "the block of code does not end")
                lines = text.count("\n")
                if path.relative_to(root).parts[0] == "doc" and lines > LINES_MAX:
                    self._fault(path, lines, f"the page has {lines} lines; divide it, {LINES_MAX} at most")
        self._anchors = {path: anchors_of(prose) for path, prose in self._prose.items()}

    def _fault(self, path, line, what):
        self.faults.append(f"{path.relative_to(self._root)}:{line}: {what}")

    def _check_target(self, path, number, link, target, anchor):
        if not target.exists():
            self._fault(path, number, f"{link}: there is no such file")
        elif anchor and target in self._anchors and anchor not in self._anchors[target]:
            self._fault(path, number, f"{link}: the page has no such heading")

    def check_links(self):
        linked = set()
        for path, prose in self._prose.items():
            for number, line in prose:
                for link in LINK.findall(re.sub(r"`[^`]*`", "", line)):
                    if re.match(r"[a-z]+:", link):
                        continue
                    file, _, anchor = link.partition("#")
                    target = (path.parent / file).resolve() if file else path
                    linked |= {target, target / "README.md"}
                    self._check_target(path, number, link, target, anchor)
        for path in self._prose:
            if path.relative_to(self._root).parts[0] == "doc" and path not in linked:
                self._fault(path, 1, "no page links to this one")

    def check_tables(self):
        for path, prose in self._prose.items():
            lines = dict(prose)
            columns = None  # of the table that contains the last line
            for number, line in prose:
                if not line.startswith("|"):
                    columns = None
                    continue
                if columns is None:
                    if not SEPARATOR.match(lines.get(number + 1, "")):
                        self._fault(path, number, "a row without a head: no empty line may divide a table")
                    columns = cells_of(line)
                if cells_of(line) != columns:
                    self._fault(path, number, f"{cells_of(line)} cells in a table of {columns} columns")

    def check_code(self):
        for path in self._files:
            if path.suffix not in CODE or path.name.startswith("page") or "corpus" in path.parts:
                continue
            try:
                text = path.read_text(encoding="utf-8")
            except UnicodeDecodeError:
                continue
            for number, line in enumerate(text.split("\n"), 1):
                for found in PAGE_IN_CODE.finditer(line):
                    page, _, anchor = found[0].partition("#")
                    self._check_target(path, number, found[0], self._root / page, anchor)


def main(arguments):
    pages = Pages(Path(arguments[0] if arguments else Path(__file__).parents[2]).resolve())
    pages.check_links()
    pages.check_tables()
    pages.check_code()
    for fault in pages.faults:
        print(fault, file=sys.stderr)
    return 1 if pages.faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
