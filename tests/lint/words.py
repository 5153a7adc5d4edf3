#!/usr/bin/env python3
"""Finds words that doc/words.txt rejects, in texts and within identifiers.

usage: words.py [FILE ...]      without arguments: all texts of the repository that git knows

A line of doc/words.txt is an extended regular expression of whole words, a tab, and what to write instead. An identifier is divided at
underscores and before capitals, so that isRunOver contains the words "run over". Exit code 1 if there are any.
"""
import re
import subprocess
import sys
from pathlib import Path

CHECKED = ("*.h", "*.cpp", "*.md", "*.proto", "*.mjs", "*.js", "*.html", "*.py", "*.sh", "*.cmake", "*CMakeLists.txt", "dev")
QUOTES_THEM = {"doc/style.md"}
IDENTIFIER = re.compile(r"[A-Za-z_]\w*")
BOUNDARY = re.compile(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])|_")


def rules_of(text):
    """[(compiled pattern, advice)] of the lines of doc/words.txt"""
    lines = (line.split("\t") for line in text.splitlines() if line.strip() and not line.startswith("#"))
    return [(re.compile(rf"\b(?:{pattern})\b", re.I), advice) for pattern, advice in lines]


def faults_of(line, rules):
    """[(word, advice)] of one line"""
    divided = [" ".join(BOUNDARY.split(name)) for name in IDENTIFIER.findall(line)]
    texts = [line, *(words for words in divided if " " in words)]
    return [(match[0], advice) for pattern, advice in rules for match in [next(filter(None, map(pattern.search, texts)), None)] if match]


def main():
    root = Path(__file__).resolve().parents[2]
    files = sys.argv[1:] or subprocess.run(["git", "ls-files", "-z", "--", *CHECKED], cwd=root, check=True, capture_output=True,
                                           text=True).stdout.split("\0")[:-1]
    rules = rules_of((root / "doc/words.txt").read_text())
    count = 0
    for name in files:
        if name in QUOTES_THEM or not (root / name).exists():  # deleted
            continue
        for number, line in enumerate((root / name).read_text(errors="replace").splitlines(), 1):
            for word, advice in faults_of(line, rules):
                print(f"{name}:{number}: {word!r}; write: {advice} (doc/style.md)", file=sys.stderr)
                count += 1
    sys.exit(count > 0)


if __name__ == "__main__":
    main()
