"""Faults that pages.py reports, in a small source tree."""
import tempfile
import unittest
from pathlib import Path

from pages import Pages

GOOD = {
    "README.md": "# Title\n\nSee [a](doc/a.md#two-words) and [below](#title).\n",
    "doc/a.md": "# A\n\n## Two `words`\n\n| x | y |\n|---|---|\n| 1 | `a\\|b` |\n",
    "lib/a.h": "/// Described in doc/a.md#two-words.\n",
}


def faults_of(changed=None):
    """Faults of the tree above with some files of other content."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in {**GOOD, **(changed or {})}.items():
            path = Path(folder) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        pages = Pages(Path(folder).resolve())
        pages.check_links()
        pages.check_tables()
        pages.check_code()
        return pages.faults


def faults_of_file(name, text):
    return faults_of({name: text})


class PagesTest(unittest.TestCase):
    def test_accepts_links_to_pages_headings_and_tables(self):
        self.assertEqual(faults_of(), [])

    def test_reports_links_to_nothing(self):
        self.assertEqual(faults_of_file("README.md", "[a](doc/a.md#three)\n[b](doc/b.md)\n"),
                         ["README.md:1: doc/a.md#three: the page has no such heading", "README.md:2: doc/b.md: there is no such file"])

    def test_reports_pages_without_a_link(self):
        self.assertEqual(faults_of_file("doc/b.md", "# B\n"), ["doc/b.md:1: no page links to this one"])

    def test_reports_pages_in_code_that_do_not_exist(self):
        self.assertEqual(faults_of_file("lib/a.h", "// doc/old.md\n"), ["lib/a.h:1: doc/old.md: there is no such file"])

    def test_reports_an_empty_line_within_a_table(self):
        self.assertEqual(faults_of_file("doc/a.md", "## Two words\n\n| x |\n|---|\n| 1 |\n\n| 2 |\n"),
                         ["doc/a.md:7: a row without a head: no empty line may divide a table"])

    def test_reports_a_row_of_another_width(self):
        self.assertEqual(faults_of_file("doc/a.md", "## Two words\n\n| x |\n|---|\n| 1 | 2 |\n"),
                         ["doc/a.md:5: 2 cells in a table of 1 columns"])

    def test_reports_blocks_without_end_and_does_not_read_blocks(self):
        self.assertEqual(faults_of_file("doc/a.md", "## Two words\n```\n[a](nothing)\n"), ["doc/a.md:2: the block of code does not end"])

    def test_reports_long_pages(self):
        self.assertEqual(faults_of_file("doc/a.md", "## Two words\n" + "\n" * 400),
                         ["doc/a.md:401: the page has 401 lines; divide it, 350 at most"])


if __name__ == "__main__":
    unittest.main()
