"""Blocks of code of a page in Markdown."""
import re
from dataclasses import dataclass

_FENCE = re.compile(r"```(\w*)\s*$")
_NOT_EXECUTED = re.compile(r"<!-- not executed: (\S.*) -->\s*$")
_FILE = re.compile(r"File `([^`]+)`:\s*$")

EXECUTED = ("sh", "python")
EXPECTED = ("console", "text")


class PageError(Exception):
    """A page that cannot be tested, with file:line."""


@dataclass
class Block:
    language: str
    text: str
    line: int  # of the first line of code in the page, from 1
    file: str = ""  # name of the file that the block is the content of; empty for others
    reason: str = ""  # why the tests do not execute it; empty for others


def blocks_of(page, is_strict=True):
    """The blocks of a page (a Path), in order; those after a comment '<!-- not executed: REASON -->' have a reason.

    Raises PageError for a block that no test would cover, if strict.
    """
    blocks = []
    lines = page.read_text(encoding="utf-8").split("\n")
    last_text = ""  # the last line of prose that is not empty
    index = 0
    while index < len(lines):
        fence = _FENCE.match(lines[index])
        if not fence:
            last_text = lines[index] or last_text
            index += 1
            continue
        begin = index + 1
        end = next((i for i in range(begin, len(lines)) if lines[i].rstrip() == "```"), None)
        if end is None:
            raise PageError(f"{page}:{index + 1}: the block does not end; add ``` after it")
        file = _FILE.search(last_text)
        not_executed = _NOT_EXECUTED.match(last_text)
        block = Block(fence[1], "".join(line + "\n" for line in lines[begin:end]), begin + 1, file[1] if file else "",
                      not_executed[1] if not_executed else "")
        if is_strict and not block.file and not block.reason and block.language not in EXECUTED + EXPECTED:
            raise PageError(f"{page}:{index + 1}: a block of '{block.language}' is not executed; put a line 'File `NAME`:' "
                            f"before it, or '<!-- not executed: REASON -->', or make it one of "
                            f"{', '.join(EXECUTED + EXPECTED)}")
        blocks.append(block)
        last_text = ""
        index = end + 1
    return blocks


def missing_line(expected, output):
    """The first line of the expected output that the output does not contain, or None.

    The lines occur in this order, with any other lines between them. '…' stands for any text within a line.
    """
    rest = iter(output.splitlines())
    for line in expected.splitlines():
        pattern = re.compile(".*".join(re.escape(part) for part in line.rstrip().split("…")))
        if not any(pattern.fullmatch(candidate.rstrip()) for candidate in rest):
            return line
    return None
