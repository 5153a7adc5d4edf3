#!/usr/bin/env python3
"""Writes robosim(1) and a manual page for each subcommand, compressed, by help2man from the output of --help.

    man_pages.py PROGRAM FOLDER

help2man formats usage, arguments and options. The text after them (examples, tables, exit codes) is passed to it as
sections of an include file, which keeps its line breaks."""
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

TITLED = re.compile(r"(Positionals|Subcommands):\n|[A-Z][^\n]*:\n  -")  # arguments, subcommands, a group of options
PROSE = ("EXIT STATUS", "ENVIRONMENT")  # filled; the other sections keep their lines
STARTS = {"Try:": "EXAMPLES", "Example": "EXAMPLES", "Exit codes:": "EXIT STATUS",
          "Log records on standard error:": "ENVIRONMENT"}


def run(*command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, encoding="utf-8").stdout


def divided(text):
    """The part of a help text that help2man formats, and the rest."""
    blocks = re.split(r"\n{2,}", text.strip("\n"))
    known = [block for i, block in enumerate(blocks) if i == 0 or TITLED.match(block)]
    return "\n\n".join(known), "\n\n".join(blocks[len(known):])


def subcommands(text):
    """Names and summaries of the subcommands in a help text."""
    listed = re.search(r"^Subcommands:\n((?:  .*\n)+)", text, re.M)
    joined = re.sub(r"\n {20,}", " ", listed[1]) if listed else ""  # help in further lines
    return dict(line.split(maxsplit=1) for line in joined.splitlines())


def escaped(line):
    line = line.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq").replace("`", "\\(ga")
    return "\\&" + line if line.startswith(".") else line


def sections(text):
    """The sections of a text after the options: title to lines."""
    found = {"NOTES": [], "EXAMPLES": [], "EXIT STATUS": [], "ENVIRONMENT": []}
    title = "NOTES"
    for line in text.splitlines():
        start = next((start for start in STARTS if line.startswith(start)), None)
        if start:
            title = STARTS[start]
            if start.endswith(":"):
                line = line[len(start):].strip()
        found[title].append(re.sub("^ {6}(?=robosim )", "", line))  # aligned with the command after "Try:"
        if not line:
            title = "NOTES"
    return found


def roff(title, lines):
    text = [escaped(line.strip() if title in PROSE else line) for line in "\n".join(lines).strip("\n").splitlines()]
    if not text:
        return ""
    return "\n".join([f"[{title}]", *(text if title in PROSE else [".nf", *text, ".fi"]), "", ""])


def see_also(names, children):
    pages = ["-".join(names[:-1])] if len(names) > 1 else []
    pages += ["-".join([*names, child]) for child in children]
    lines = ", ".join(f".BR {page} (1)" for page in pages).replace(", ", " ,\n")
    return f"[SEE ALSO]\n{lines}\n.PP\nThe documentation is in the folder /usr/share/doc/robosim.\n"


def write_page(program, names, summary, common, folder):
    """Writes the page of a subcommand, and those of its subcommands.
    common: the text at the end of the help of the program and of each subcommand"""
    text = run(program, *names[1:], "--help")
    head, rest = divided(text)
    own = sections(rest.removesuffix(common))
    general = sections(common)
    for title in general if len(names) == 1 else PROSE:
        own[title] = own[title] or general[title]
    children = subcommands(text)

    head = head.replace("Positionals:", "Arguments:").replace("-h,--help", "-h, --help")
    page = "-".join(names)
    version = run(program, "--version").split()[-1]
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        (scratch / "help").write_text(head + "\n", encoding="utf-8")
        (scratch / "include").write_text("".join(roff(*section) for section in own.items()) + see_also(names, children),
                                         encoding="utf-8")
        fake = scratch / page  # help2man runs a program
        fake.write_text(f"#!/bin/sh\ncase $1 in\n  --version) echo '{page} (RoboSim) {version}' ;;\n"
                        f"  *) cat {shlex.quote(str(scratch / 'help'))} ;;\nesac\n", encoding="utf-8")
        fake.chmod(0o755)
        output = folder / f"{page}.1"
        run("help2man", "--no-info", "--no-discard-stderr", "--locale=C.UTF-8", "--name", summary,
            "--include", str(scratch / "include"), "--output", str(output), str(fake))
        run("gzip", "-9nf", str(output))
    for child, child_summary in children.items():
        write_page(program, [*names, child], child_summary[0].lower() + child_summary[1:], common, folder)


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    common = divided(run(program, "--help"))[1]
    write_page(program, ["robosim"], "simulate teams of cooperating mobile robots", common, folder)


if __name__ == "__main__":
    main()
