#!/usr/bin/env python3
"""Executes a tutorial or another page: run_tutorial.py PAGE PREFIX [PYTHON_FOLDER], with RoboSim installed in PREFIX.
run_tutorial.py --everything PAGE FOLDER: as a user does from the first line on, with nothing installed, in FOLDER; also the blocks that
are not executed otherwise, as far as a machine can (tests/verify/readme.sh).

The blocks of the page are processed in order, in an empty temporary folder:
  a block after a line 'File `NAME`:'   is written to the file NAME
  sh                                    is executed by bash; it fails with the first command that fails
  python                                is executed by Python; all of a page share their variables
  a block after '<!-- not executed: REASON -->'  is skipped
  console, text                         is expected output of the last block executed; '…' stands for any text
A failure is reported as PAGE:LINE with the output.
"""
import ctypes
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import uuid
from pathlib import Path

from page import EXECUTED, Block, PageError, blocks_of, missing_line


PR_SET_CHILD_SUBREAPER = 36  # <sys/prctl.h>
# Time for programs that were asked to end.
ENDING_S = 60


class Tutorial:
    """One execution of a page in a folder."""

    def __init__(self, page, prefix, python_folder, folder):
        self._page = page
        self._folder = Path(folder)
        python_path = f"{prefix / python_folder}:{os.environ.get('PYTHONPATH', '')}".rstrip(":")
        self._environment = {**os.environ, "PATH": f"{prefix / 'bin'}:{os.environ['PATH']}", "PYTHONPATH": python_path,
                             "CMAKE_PREFIX_PATH": str(prefix), "LC_ALL": "C.UTF-8"}
        for variable in ("ROBOSIM_PATH", "ROBOSIM_PLUGIN_PATH", "ROBOSIM_TOKEN"):
            self._environment.pop(variable, None)
        self._output = ""
        self._python = None
        self._groups = []  # (process group, line) of each block of sh, whose background processes may run on

    def run(self):
        try:
            for block in blocks_of(self._page):
                if not block.reason:
                    self._process(block)
        finally:
            self._end_python()
            still_running = self._end_groups()
        if still_running:
            self._fail(still_running[0], "a process that this block started runs at the end of the page; end it")

    def _process(self, block):
        if block.file:
            file = self._folder / block.file
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(block.text, encoding="utf-8")
        elif block.language == "sh":
            self._run_sh(block)
        elif block.language == "python":
            self._run_python(block)
        else:
            missing = missing_line(block.text, self._output)
            if missing is not None:
                self._fail(block.line, f"the output lacks the line '{missing}'")

    def _run_sh(self, block):
        # To a file: a background process would keep a pipe open.
        with tempfile.TemporaryFile() as output:
            bash = subprocess.Popen(["bash", "-euo", "pipefail", "-c", block.text], cwd=self._folder, env=self._environment,
                                    stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT, start_new_session=True)
            self._groups.append((bash.pid, block.line))
            exit_code = bash.wait()
            output.seek(0)
            self._output = output.read().decode("utf-8", "replace")
        if exit_code:
            self._fail(block.line, f"the block ended with exit code {exit_code}")

    def _run_python(self, block):
        if not self._python:
            session = Path(__file__).with_name("python_session.py")
            self._python = subprocess.Popen([sys.executable, "-B", session], cwd=self._folder, env=self._environment, text=True,
                                            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        end = str(uuid.uuid4())
        json.dump({"file": str(self._page), "line": block.line, "text": block.text, "end": end}, self._python.stdin)
        self._python.stdin.write("\n")
        self._python.stdin.flush()
        lines = []
        for line in self._python.stdout:
            if line.rstrip("\n").endswith(end):
                self._output = "".join(lines) + line.rstrip("\n").removesuffix(end)
                return
            lines.append(line)
        self._output = "".join(lines)
        self._fail(block.line, "the block raised an exception")

    def _fail(self, line, what):
        raise PageError(f"{self._page}:{line}: {what}. Output:\n{self._output}")

    def _end_python(self):
        if self._python:
            self._python.stdin.close()
            self._python.wait()
            self._python.stdout.close()

    def _end_groups(self):
        """Ends the background processes that do not end by themselves; returns the lines of the blocks that started them."""
        deadline = time.monotonic() + ENDING_S
        while any(is_running(group) for group, _ in self._groups) and time.monotonic() < deadline:
            time.sleep(0.05)
        lines = [line for group, line in self._groups if is_running(group)]
        for group, _ in self._groups:
            if is_running(group):
                os.killpg(group, signal.SIGKILL)
        return lines


class EverythingTutorial(Tutorial):
    """One execution of a page by a user who has nothing but a clone: variables that a block exports hold for later blocks."""

    def __init__(self, page, folder):
        super().__init__(page, Path("/usr"), "lib/python3/dist-packages", folder)
        self._environment = dict(os.environ)
        self._exports = tempfile.NamedTemporaryFile(prefix="exports-")

    def run(self):
        try:
            for block in blocks_of(self._page):
                self._run_or_skip(block)
        finally:
            self._end_python()
            self._end_groups()

    def _run_or_skip(self, block):
        title = f"{self._page.name}:{block.line}"
        if block.reason and (block.reason.startswith(("needs", "opens windows")) or
                             not (block.file or block.language in EXECUTED)):
            print(f"{title}: skipped: {block.reason}", flush=True)
            return
        begin = time.monotonic()
        if block.language == "sh" and not block.file:
            text = f"source {self._exports.name}\n{block.text}\nexport -p >{self._exports.name}\n"
            if "until" in block.reason or "waits" in block.reason:
                text = f"source {self._exports.name}\n" + "".join(
                    f"timeout --signal INT --kill-after 30 30 {line} || [[ $? == @(0|124|130) ]]\n"
                    for line in block.text.splitlines() if line and not line.startswith("#"))
            block = Block(block.language, text, block.line)
        self._process(block)
        print(f"{title}: {time.monotonic() - begin:.0f} s", flush=True)


def is_running(group):
    """Whether a process group has a process, after those that have ended are reaped."""
    try:
        while os.waitpid(-group, os.WNOHANG)[0]:
            pass
    except ChildProcessError:
        pass
    try:
        os.killpg(group, 0)
        return True
    except ProcessLookupError:
        return False


def run_page(page, prefix, python_folder="lib/python3/dist-packages"):
    """Executes a page. Raises PageError for the first failure."""
    with tempfile.TemporaryDirectory(prefix="tutorial-") as folder:
        Tutorial(page, prefix.resolve(), python_folder, folder).run()


def main(arguments):
    if len(arguments) == 3 and arguments[0] == "--everything":
        try:
            EverythingTutorial(Path(arguments[1]).resolve(), arguments[2]).run()
        except PageError as error:
            print(error, file=sys.stderr)
            return 1
        return 0
    if len(arguments) not in (2, 3):
        print(__doc__, file=sys.stderr)
        return 2
    page, prefix, *python_folder = arguments
    # Background processes become children of this one when their block ends, so that they can be reaped.
    ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    try:
        run_page(Path(page), Path(prefix), *python_folder)
    except PageError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
