#!/usr/bin/env python3
"""Writes a page of the run of each tutorial: tutorial_runs.py PREFIX PYTHON_FOLDER OUTPUT, with RoboSim installed in PREFIX.

A tutorial names the recording with '<!-- run: ARGUMENTS -->': arguments of `robosim export` (the recording first); with
'<!-- run: ARGUMENTS after: COMMAND -->' a command makes it. The blocks before this line are executed as the tests do, then the
page OUTPUT/TUTORIAL.html is exported. Exit code 1 if a tutorial fails; the other pages are written.
"""
import ctypes
import re
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/tutorials"))
from page import Block, PageError  # noqa: E402
from run_tutorial import PR_SET_CHILD_SUBREAPER, Tutorial  # noqa: E402

RUN = re.compile(r"<!-- run: (.*?)(?: after: (.*))? -->$", re.MULTILINE)


class RecordedTutorial(Tutorial):
    """A tutorial up to its recording, with two further blocks: the command that makes it, and the export."""

    def __init__(self, page, prefix, python_folder, folder, output):
        super().__init__(page, prefix, python_folder, folder)
        self._output_page = output

    def _blocks(self):
        text = self._page.read_text(encoding="utf-8")
        run = RUN.search(text)
        line = text.count("\n", 0, run.start()) + 1
        recording, *options = run[1].split(maxsplit=1)
        commands = f"{run[2] or ''}\nrobosim export {recording} {self._output_page} {' '.join(options)}\n"
        return [block for block in super()._blocks() if block.line < line] + [Block("sh", commands, line)]


def main(arguments):
    if len(arguments) != 3 or any(argument.startswith("-") for argument in arguments):
        print(__doc__, file=sys.stderr)
        return 2
    prefix, python_folder, output = Path(arguments[0]).resolve(), arguments[1], Path(arguments[2]).resolve()
    output.mkdir(parents=True, exist_ok=True)
    ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    failures = 0
    pages = [page for page in sorted((ROOT / "doc/tutorials").glob("*.md")) if RUN.search(page.read_text(encoding="utf-8"))]
    for number, page in enumerate(pages, 1):
        print(f"Run of tutorial {number} of {len(pages)}: {page.stem}", flush=True)
        with tempfile.TemporaryDirectory(prefix="tutorial-") as folder:
            try:
                RecordedTutorial(page, prefix, python_folder, folder, output / f"{page.stem}.html").run(ends_programs=True)
            except PageError as error:
                failures += 1
                print(error, file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
