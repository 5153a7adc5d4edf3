#!/usr/bin/env python3
"""Builds the documentation as static pages, with navigation and search: build.py OUTPUT [RUNS]

OUTPUT  folder of the pages, which is emptied first
RUNS    folder with the pages of runs of tutorial_runs.py; without it the tutorials show none

README.md, the pages of doc/ and what they link to are copied and adapted, because MkDocs reads one folder:
- Source files and folders that pages link to become pages with the content of the files.
- "<!-- run: … -->" in a tutorial becomes the page of this run (tutorial_runs.py).
- Diagrams in Mermaid, which GitHub draws, are drawn by Graphviz (diagram.py).
Exit code 1 if a link leads nowhere or a page is not in the navigation (mkdocs.yml).
"""
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import diagram

ROOT = Path(__file__).resolve().parents[2]
SITE = ROOT / "doc/site"
LANGUAGES = {".cpp": "cpp", ".h": "cpp", ".py": "python", ".xml": "xml", ".sh": "sh", ".proto": "protobuf", ".cfg": "ini", ".cff": "yaml",
             ".txt": "text"}
PICTURES = {".png", ".svg", ".webp", ".jpg", ".css"}
LINK = re.compile(r"(\]\()([^()\s#]+)((?:#[^()\s]*)?\))")
RUN = re.compile(r"<!-- run: .* -->\n")
FENCE = re.compile(r"(^```.*?^```$\n?)", re.MULTILINE | re.DOTALL)


class Pages:
    """The copy of the pages in a folder."""

    def __init__(self, folder, runs):
        self._folder = folder
        self._runs = runs
        self._sources = set()

    def stage(self):
        for page in pages_of_the_tree():
            self._write(page.relative_to(ROOT), self._adapted(page))
        for picture in sorted((ROOT / "doc").rglob("*")):
            if picture.suffix in PICTURES:
                target = self._folder / picture.relative_to(ROOT)
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(picture, target)

    def _write(self, path, text):
        target = self._folder / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, encoding="utf-8")

    def _adapted(self, page):
        parts = FENCE.split(page.read_text(encoding="utf-8"))
        for index, part in enumerate(parts):
            if part.startswith("```mermaid\n"):
                parts[index] = f'<div class="diagram">{diagram.svg(part)}</div>\n'
            elif not part.startswith("```"):
                part = LINK.sub(lambda link: link[1] + self._target(page, link[2]) + link[3], part)
                parts[index] = RUN.sub(lambda run: self._run(page), part)
        return "".join(parts)

    def _run(self, page):
        """The element that shows the run of a tutorial."""
        if not self._runs or not (self._runs / f"{page.stem}.html").exists():
            return ""
        return (f'<iframe class="run" loading="lazy" title="The run of this tutorial" src="../../runs/{page.stem}.html"></iframe>\n\n'
                f'<a href="../../runs/{page.stem}.html">The run in a page of its own</a>\n')

    def _target(self, page, target):
        """The target of a link, which is a page of its own for source files and folders."""
        path = (page.parent / target).resolve()
        if "://" in target or target.startswith("mailto:") or path.suffix in PICTURES | {".md"} or not path.exists():
            return target
        if path not in self._sources:
            self._sources.add(path)
            self._write(self._page_of(path), self._listing(path))
        return target.rstrip("/") + self._page_of(path).name.removeprefix(path.name)

    @staticmethod
    def _page_of(path):
        return path.relative_to(ROOT).with_name(path.name + ".files.md")

    @staticmethod
    def _listing(path):
        files = [path]
        if path.is_dir():
            tracked = subprocess.run(["git", "-C", ROOT, "ls-files", "-z", path], check=True, capture_output=True, text=True).stdout
            files = [ROOT / name for name in tracked.split("\0") if name]
        text = f"# {path.relative_to(ROOT)}\n"
        for file in files:
            if path.is_dir():
                text += f"\n## {file.relative_to(path)}\n"
            content = file.read_text(encoding="utf-8").rstrip("\n")
            fence = "`" * max(3, 1 + max(map(len, re.findall("`+", content)), default=0))
            text += f"\n{fence}{LANGUAGES.get(file.suffix, 'text')}\n{content}\n{fence}\n"
        return text


def pages_of_the_tree():
    """The pages for readers; those in doc/examples are shown with their files."""
    others = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "worlds/README.md", "rawlogs/README.md")
    return [ROOT / page for page in others] + [page for page in sorted((ROOT / "doc").rglob("*.md"))
                                               if ROOT / "doc/examples" not in page.parents]


def unlisted_pages():
    """Pages that the navigation lacks."""
    listed = set(re.findall(r"[\w/]+\.md", (SITE / "mkdocs.yml").read_text(encoding="utf-8")))
    return [page for page in pages_of_the_tree() if str(page.relative_to(ROOT)) not in listed]


def write_search_of_files(output):
    """The index and the worker of the search as a script, for pages that are opened as files (theme/main.html)."""
    index = (output / "search/search_index.json").read_text(encoding="utf-8")
    worker = next(output.glob("assets/javascripts/workers/search.*.js")).read_text(encoding="utf-8")
    (output / "search/of_files.js").write_text(
        f"var __search = {{ index: Promise.resolve({index}),\n"
        f"worker: URL.createObjectURL(new Blob([{json.dumps(worker)}])) }};\n", encoding="utf-8")


def build(output, runs):
    faults = [f"{page.relative_to(ROOT)}: is not in the navigation; add it to doc/site/mkdocs.yml" for page in unlisted_pages()]
    with tempfile.TemporaryDirectory(prefix="pages-") as folder:
        pages = Path(folder) / "pages"
        Pages(pages, runs).stage()
        settings = Path(folder) / "mkdocs.yml"
        fixed = (SITE / "mkdocs.yml").read_text(encoding="utf-8").replace("  name: material\n", f"  name: material\n  custom_dir: {SITE}/theme\n")
        settings.write_text(f"{fixed}docs_dir: {pages}\n", encoding="utf-8")
        done = subprocess.run(["mkdocs", "build", "--quiet", "--strict", "--config-file", settings, "--site-dir", output], check=False)
    if done.returncode == 0:
        write_search_of_files(output)
    if runs:
        shutil.copytree(runs, output / "runs")
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults or done.returncode else 0


def main(arguments):
    if len(arguments) not in (1, 2) or any(argument.startswith("-") for argument in arguments):
        print(__doc__, file=sys.stderr)
        return 2
    output, *runs = (Path(argument).resolve() for argument in arguments)
    return build(output, runs[0] if runs else None)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
