"""Tests of run_tutorial.py on small pages."""
import os
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from page import PageError, missing_line
from run_tutorial import EverythingTutorial, commands_of, first_section, run_page


def run(text):
    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder) / "page.md"
        page.write_text(text, encoding="utf-8")
        run_page(page, Path("/usr"))


def temporary_folder(test):
    folder = tempfile.TemporaryDirectory()
    test.addCleanup(folder.cleanup)
    return Path(folder.name).resolve()


def run_everything(text, test, prepare=lambda folder: None, bound_s=60):
    """Executes a page as tests/verify/readme.sh does; returns a folder with clone/ and folder/. bound_s: of commands until Ctrl-C."""
    root = temporary_folder(test)
    for name in ("clone", "folder"):
        (root / name).mkdir()
    prepare(root / "folder")
    (root / "page.md").write_text(text, encoding="utf-8")
    with (mock.patch("builtins.print"), mock.patch.object(EverythingTutorial, "BOUND_S", bound_s),
          mock.patch.object(EverythingTutorial, "DELAY_S", 0)):
        EverythingTutorial(root / "page.md", root / "clone", root / "folder").run()
    return root


class RunTutorialTest(unittest.TestCase):
    def test_executes_blocks_in_order_in_one_folder(self):
        run("File `a/b.txt`:\n\n```text\nhello\n```\n```sh\ncat a/b.txt\n```\n```console\nhello\n```\n"
            "```python\nx = open('a/b.txt').read()\n```\n```python\nprint(x)\n```\n```text\nhel…\n```\n")

    def test_reports_the_line_of_a_failing_command_with_its_output(self):
        with self.assertRaisesRegex(PageError, r"page.md:4: the block ended with exit code 1.*\nbefore\n$"):
            run("# T\n\n```sh\necho before\nfalse\necho after\n```\n")

    def test_reports_the_line_of_an_exception(self):
        with self.assertRaisesRegex(PageError, r'(?s)page.md:2: the block raised.*page.md", line 3, in <module>.*ValueError'):
            run("```python\nx = 1\nraise ValueError(x)\n```\n")

    def test_reports_output_that_differs(self):
        with self.assertRaisesRegex(PageError, r"page.md:5: the output lacks the line '2 robots'"):
            run("```sh\necho 3 robots\n```\n```console\n2 robots\n```\n")

    def test_reports_blocks_that_are_not_executed(self):
        with self.assertRaisesRegex(PageError, "page.md:1: a block of 'cpp' is not executed"):
            run("```cpp\nint main() {}\n```\n")
        with self.assertRaisesRegex(PageError, "page.md:1: the block does not end"):
            run("```sh\ntrue\n")

    def test_skips_blocks_with_a_reason(self):
        run("<!-- not executed: installs packages -->\n```sh\nfalse\n```\n\n<!-- not executed: in C++ -->\n\n```cpp\nx\n```\n")
        with self.assertRaisesRegex(PageError, "page.md:3: the block ended with exit code 1"):
            run("<!-- not executed: -->\n```sh\nfalse\n```\n")

    def test_keeps_background_processes_for_later_blocks_and_reports_those_left(self):
        run("```sh\nsleep 1000 & echo $! >pid\n```\n```sh\nkill $(cat pid); tail -f /dev/null --pid $(cat pid)\n```\n")
        with (mock.patch("run_tutorial.ENDING_S", 0),
              self.assertRaisesRegex(PageError, "page.md:2: a process that this block started runs")):
            run("```sh\nsleep 1000 &\n```\n")

    def test_everything_executes_also_blocks_with_a_reason_and_keeps_exported_variables(self):
        folder = run_everything("<!-- not executed: installs packages -->\n```sh\nexport A=7\n```\n```sh\necho $A >a\n```\n"
                                "<!-- not executed: needs a robot -->\n```sh\nfalse\n```\n", self)
        self.assertEqual((folder / "folder/a").read_text(encoding="utf-8"), "7\n")

    def test_everything_executes_commands_of_dev_in_the_clone_and_others_in_a_folder_of_their_own(self):
        folder = run_everything("```sh\n: ./dev; pwd >a\n```\n```sh\npwd >a\n```\n", self)
        self.assertEqual((folder / "clone/a").read_text(encoding="utf-8"), f"{folder}/clone\n")
        self.assertEqual((folder / "folder/a").read_text(encoding="utf-8"), f"{folder}/folder\n")

    def test_everything_interrupts_commands_that_run_until_ctrl_c(self):
        folder = run_everything("```sh\necho 1 >a\ntail -f a   # until Ctrl-C\necho 2 >>a\n```\n", self, bound_s=0.2)
        self.assertEqual((folder / "folder/a").read_text(encoding="utf-8"), "1\n2\n")

    def test_everything_runs_commands_of_several_terminals_at_the_same_time(self):
        run_everything("<!-- not executed: in two terminals, until Ctrl-C -->\n```sh\necho x >pipe\ncat pipe\n```\n", self,
                       prepare=lambda folder: os.mkfifo(folder / "pipe"))

    def test_everything_reports_a_failure_before_a_conjunction(self):
        with self.assertRaisesRegex(PageError, "page.md:2: the block ended with exit code 1"):
            run_everything("```sh\nfalse && true\ntrue\n```\n", self)

    def test_everything_reports_every_failure(self):
        with self.assertRaisesRegex(PageError, "(?s)page.md:2: the block ended with exit code 1.*"
                                               "page.md:6: 'false  # until Ctrl-C' ended with 1"):
            run_everything("```sh\nfalse\n```\n\n```sh\nfalse  # until Ctrl-C\n```\n", self)

    def test_the_first_section_ends_at_the_heading_after_its_code(self):
        page = temporary_folder(self) / "page.md"
        page.write_text("# T\n## A\n```xml\n<a/>\n```\n## B\n```sh\n1\n```\n```python\n2\n```\n## C\n```sh\n3\n```\n", encoding="utf-8")
        self.assertEqual([block.text for block in first_section(page)], ["1\n", "2\n"])
        page.write_text("# T\n```cpp\n1\n```\n", encoding="utf-8")
        self.assertEqual(first_section(page), [])

    def test_a_command_may_have_several_lines(self):
        self.assertEqual(commands_of("a \\\n  b\n# c\nd '1\n2'\n"), ["a \\\n  b", "d '1\n2'"])



class ExpectedOutputTest(unittest.TestCase):
    def test_lines_occur_in_order_with_any_text_for_an_ellipsis(self):
        self.assertIsNone(missing_line("a … c\n…\nz\n", "first\na b c\nmore\nz\n"))
        self.assertEqual(missing_line("z\na … c\n", "a b c\nz\n"), "a … c")
        self.assertEqual(missing_line("a\n", "ab\n"), "a")


if __name__ == "__main__":
    unittest.main()
