#!/usr/bin/env python3
"""Executes a tutorial or another page: run_tutorial.py PAGE PREFIX [PYTHON_FOLDER], with RoboSim installed in PREFIX.
run_tutorial.py --everything PAGE CLONE [FIRST]: as a user does from the first line on, who has nothing but a clone; also the blocks that
are not executed otherwise, as far as a machine can (tests/verify/readme.sh). Blocks with ./dev are executed in the clone. FIRST, a
word: only the first section that has code, all of it in the clone.

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

    def run(self, ends_programs=False):
        """Executes the page. Programs that run at its end are a failure, or are ended."""
        try:
            for block in self._blocks():
                if not block.reason:
                    self._process(block)
        finally:
            self._end_python()
            still_running = self._end_groups(0 if ends_programs else ENDING_S)
        if still_running and not ends_programs:
            self._fail(still_running[0], "a process that this block started runs at the end of the page; end it")

    def _blocks(self):
        return blocks_of(self._page)

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

    def _end_groups(self, bound_s=ENDING_S):
        """Ends the background processes that do not end by themselves in time; returns the lines of the blocks that started them."""
        deadline = time.monotonic() + bound_s
        while any(is_running(group) for group, _ in self._groups) and time.monotonic() < deadline:
            time.sleep(0.05)
        lines = [line for group, line in self._groups if is_running(group)]
        for group, _ in self._groups:
            if is_running(group):
                os.killpg(group, signal.SIGKILL)
        return lines


class EverythingTutorial(Tutorial):
    """One execution of a page by a user who has nothing but a clone: variables that a block exports hold for later blocks."""

    BOUND_S = 20  # of a command that runs until Ctrl-C
    DELAY_S = 3  # between commands in terminals of their own

    def __init__(self, page, clone, folder):
        super().__init__(page, Path("/usr"), "lib/python3/dist-packages", folder)
        self._clone = Path(clone)
        self._environment = dict(os.environ)
        self._exports = tempfile.NamedTemporaryFile(prefix="exports-")

    def run(self, blocks=None):
        failures = []
        try:
            for block in blocks_of(self._page) if blocks is None else blocks:
                title = f"{self._page.name}:{block.line}"
                reason = self._reason_to_skip(block)
                if reason is not None:
                    if reason:
                        print(f"{title}: skipped: {reason}", flush=True)
                    continue
                begin = time.monotonic()
                try:
                    self._process_everything(block)
                    print(f"{title}: done in {time.monotonic() - begin:.0f} s", flush=True)
                except PageError as error:  # later blocks are executed, so that one call finds all failures
                    print(f"{title}: FAILED after {time.monotonic() - begin:.0f} s", flush=True)
                    failures.append(str(error))
        finally:
            self._end_python()
            self._end_groups()
        if failures:
            raise PageError("\n".join(failures))

    def _reason_to_skip(self, block):
        """None for a block that is executed; empty for what is not code."""
        if block.file or block.language not in EXECUTED:
            return None if block.file or not block.reason else ""
        return block.reason if block.reason.startswith("needs") else None

    def _process_everything(self, block):
        if block.language != "sh" or block.file:
            self._process(block)
            return
        normal = self._folder
        if "./dev" in block.text or "build/packages" in block.text:
            self._folder = self._clone
        try:
            if "terminals" in block.reason:
                self._run_in_terminals(commands_of(block.text), block.line)
                return
            pending = ""
            for command in commands_of(block.text):
                if "Ctrl-C" not in block.reason + command and not block.reason.startswith(("opens windows", "waits")):
                    pending += f"{command}\n[[ $? == 0 ]] || exit 1\n"  # set -e does not end a block at 'false && true'
                    continue
                self._run_pending(pending, block.line)
                pending = ""
                self._run_in_terminals([command], block.line)
            self._run_pending(pending, block.line)
        finally:
            self._folder = normal

    def _run_pending(self, text, line):
        if text:
            self._run_sh(Block("sh", f"source {self._exports.name}\n{text}export -p >{self._exports.name}\n", line))

    def _run_in_terminals(self, commands, line):
        """Runs commands at the same time, each for BOUND_S unless it ends, and then sends what Ctrl-C does."""
        started = []
        for command in commands:
            output = tempfile.TemporaryFile()
            started.append((command, output, subprocess.Popen(
                ["bash", "-euo", "pipefail", "-c", f"source {self._exports.name}\n{command}"], cwd=self._folder, env=self._environment,
                stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT, start_new_session=True)))
            time.sleep(self.DELAY_S)
        deadline = time.monotonic() + self.BOUND_S
        problems = []
        is_any_interrupted = False
        for command, output, bash in started:  # the environment, then its clients
            is_interrupted = False
            try:
                bash.wait(max(0, deadline - time.monotonic()))
            except subprocess.TimeoutExpired:
                is_interrupted = is_any_interrupted = True
                os.killpg(bash.pid, signal.SIGINT)
                try:
                    bash.wait(ENDING_S)
                except subprocess.TimeoutExpired:
                    os.killpg(bash.pid, signal.SIGKILL)
                    bash.wait()
            output.seek(0)
            text = output.read().decode("utf-8", "replace")
            is_expected = not bash.returncode or is_interrupted and bash.returncode in (-signal.SIGINT, 128 + signal.SIGINT)
            # The simulated robot of a program of ARIA has ended before the program.
            is_expected |= is_any_interrupted and "the connection with the robot" in text and " is lost" in text
            if not is_expected:
                problems.append(f"'{command}' ended with {bash.returncode}{' after Ctrl-C' if is_interrupted else ''}. Output:\n{text}")
            output.close()
        if problems:
            raise PageError(f"{self._page}:{line}: " + "\n".join(problems))


def commands_of(text):
    """The lines of a block, those that a backslash or a quote continues joined."""
    commands = []
    pending = ""
    for line in text.splitlines():
        pending += line + "\n"
        if not line.endswith("\\") and subprocess.run(["bash", "-n", "-c", pending], capture_output=True).returncode == 0:
            commands.append(pending.rstrip("\n"))
            pending = ""
    return [command for command in commands + [pending] if command and not command.startswith("#")]


def first_section(page):
    """The blocks of sh and python of the first section of a page, a Path, that has any."""
    lines = page.read_text(encoding="utf-8").split("\n")
    headings = [number for number, line in enumerate(lines, 1) if line.startswith("## ")] + [len(lines) + 1]
    blocks = [block for block in blocks_of(page, is_strict=False) if block.language in EXECUTED]
    end = next((heading for heading in headings if blocks and heading > blocks[0].line), 0)
    return [block for block in blocks if block.line < end]


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
    except PermissionError:  # its number has passed to processes of another user
        return False


def run_page(page, prefix, python_folder="lib/python3/dist-packages"):
    """Executes a page. Raises PageError for the first failure."""
    with tempfile.TemporaryDirectory(prefix="tutorial-") as folder:
        Tutorial(page, prefix.resolve(), python_folder, folder).run()


def main(arguments):
    if len(arguments) in (3, 4) and arguments[0] == "--everything":
        page = Path(arguments[1]).resolve()
        # A background job of a shell ignores Ctrl-C, and so would all programs that it starts.
        signal.signal(signal.SIGINT, signal.default_int_handler)
        with tempfile.TemporaryDirectory(prefix="tutorial-") as folder:
            try:
                if len(arguments) == 4:
                    EverythingTutorial(page, arguments[2], arguments[2]).run(first_section(page))
                else:
                    EverythingTutorial(page, arguments[2], folder).run()
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
