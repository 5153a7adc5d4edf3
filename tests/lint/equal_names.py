#!/usr/bin/env python3
"""Finds types, functions and variables with external linkage that have one qualified name in several files.

usage: equal_names.py [FILE ...]      without arguments: all C++ files of the repository that git knows

Equal names break C++'s one definition rule as soon as both files are linked together, and the compiler does not report
it. Checked are definitions at namespace scope: classes, structs, unions and enums by qualified name; functions by
qualified name and types of parameters; variables by qualified name. Names in unnamed namespaces, static functions,
constants without `inline`, aliases, specialisations and extern "C" are exempt. Exit code 1 if there are any.
"""
import collections
import os
import re
import subprocess
import sys

COMMENT_OR_TEXT = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"([^()\s]{0,16})\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![\w])\'(?:\\.|[^\'\\\n])+\'', re.S)
DIRECTIVE = re.compile(r"^[ \t]*#(?:[^\n\\]|\\.)*(?:\\\n(?:[^\n\\]|\\.)*)*", re.M)
TOKEN = re.compile(r"[{};]")
NAME = r"[A-Za-z_]\w*"
NAMESPACE = re.compile(rf"^(?:inline\s+)?namespace\b\s*((?:{NAME})?(?:::{NAME})*)$")
TYPE = re.compile(rf"^(?:class|struct|union|enum(?:\s+(?:class|struct))?)\s+((?:{NAME}::)*{NAME})(?=$|\s*:[^:]|\s+final\b)")
FUNCTION = re.compile(rf"((?:{NAME}::)*(?:operator\s*[^\s\w(]+|operator\s*\(\)|operator (?:new|delete)(?:\[\])?|~?{NAME}))\s*$")
VARIABLE = re.compile(rf"({NAME})\s*(?:\[[^\]]*\]\s*)*$")
# Functions that each program may define for itself.
REPLACEABLE = re.compile(r"main\(|LLVMFuzzerTestOneInput\(|operator(?:new|delete)")
KEYWORDS = {"if", "for", "while", "switch", "catch", "return", "TEST", "TEST_F", "TEST_P", "TYPED_TEST"}


def blanked(text):
    """The text without comments, contents of literals and preprocessor directives, with the same line numbers."""
    keep_lines = lambda found: '""' + "\n" * found.group().count("\n")
    text = COMMENT_OR_TEXT.sub(lambda m: keep_lines(m) if m.group()[0] not in "/" else " " + "\n" * m.group().count("\n"), text)
    return DIRECTIVE.sub(lambda m: "\n" * m.group().count("\n"), text)


def without_templates(head):
    """A declaration without its leading template<…>, requires and attributes."""
    head = re.sub(r"\[\[.*?\]\]|\balignas\s*\([^)]*\)", " ", head).strip()
    while head.startswith("template"):
        depth, at = 0, head.find("<")
        if at < 0:
            break
        while at < len(head):
            depth += {"<": 1, ">": -1}.get(head[at], 0)
            at += 1
            if depth == 0:
                break
        head = head[at:].strip()
    return head


def parameters_of(head):
    """Splits a function's declaration at its list of parameters. @return what is before, and the types, or None"""
    at = head.find("(")
    while at >= 0:
        before = head[:at].rstrip()
        if before.endswith("operator"):
            at = head.find("(", at + 1)
            continue
        depth = 0
        for end in range(at, len(head)):
            depth += {"(": 1, ")": -1}.get(head[end], 0)
            if depth == 0:
                return before, types_of(head[at + 1:end]), head[end + 1:].strip()
        return None
    return None


def types_of(parameters):
    """Types of parameters, without their names and defaults."""
    parts, depth, part = [], 0, ""
    for c in parameters + ",":
        if c == "," and depth == 0:
            parts.append(part)
            part = ""
            continue
        depth += {"(": 1, "<": 1, "[": 1, "{": 1, ")": -1, ">": -1, "]": -1, "}": -1}.get(c, 0)
        part += c
    types = []
    for part in parts:
        part = " ".join(part.split("=")[0].split())
        if not part:
            continue
        words = re.sub(r"^const ", "", part)
        named = re.match(rf"^(.*[\w>&*\]])(?:\s+|(?<=[&*]))({NAME})$", words)
        bare = named.group(1) if named and named.group(1).split()[-1] not in ("unsigned", "const") else words
        constant = "const " if part.startswith("const ") and re.search(r"[&*]$", bare.strip()) else ""
        types.append(constant + re.sub(r"\s+", "", bare))
    return ",".join(types)


def definitions_in(file):
    """Yields (kind, qualified name, line) of the definitions with external linkage."""
    with open(file, encoding="utf-8", errors="replace") as source:
        text = blanked(source.read())
    scopes = []  # names of namespaces; None for an unnamed one; False for any other block
    begin, line, counted = 0, 1, 0
    for token in TOKEN.finditer(text):
        head = " ".join(text[begin:token.start()].split())
        depth_of_blocks = sum(scope is False for scope in scopes)
        if depth_of_blocks == 0 and token.group() != "}" and head:
            start = begin + len(text[begin:]) - len(text[begin:].lstrip())
            line += text.count("\n", counted, start)
            counted = start
            if None not in scopes and "" not in scopes:
                prefix = "::".join(scope for scope in scopes if scope)
                found = definition_of(head, token.group())
                if found:
                    yield found[0], (prefix + "::" if prefix else "") + found[1], line
        if token.group() == "{":
            namespace = NAMESPACE.match(head) if depth_of_blocks == 0 else None
            scopes.append((namespace.group(1) or None) if namespace else False)
            if namespace is None and re.match(r'^extern ""$', head):
                scopes[-1] = ""
        elif token.group() == "}" and scopes:
            scopes.pop()
        begin = token.end()


def definition_of(head, end):
    """(kind, name) of what a declaration defines with external linkage; None for any other text."""
    head = without_templates(head)
    first = head.split(" ", 1)[0] if head else ""
    if first in ("using", "typedef", "friend", "static_assert", "namespace", "static", "extern", "TEST", "return"):
        return None
    if end == "{":
        if found := TYPE.match(head):
            return "type", found.group(1)
        split = parameters_of(head)
        if not split or "=" in split[0].replace("operator=", "").replace("operator==", ""):
            inline = re.match(rf"^inline\s.*?({NAME})\s*(?:=|$)", head)
            return ("variable", inline.group(1)) if inline and "(" not in head.split("=")[0] else None
        before, types, after = split
        name = FUNCTION.search(before)
        if not name or name.group(1) in KEYWORDS or before == name.group(1) and "::" not in before:
            return None
        if "<" in before[name.start():]:
            return None
        constant = " const" if re.match(r"^const\b", after) else ""
        return "function", name.group(1).replace(" ", "") + "(" + types + ")" + constant
    if head.startswith("inline ") and "=" in head and "(" not in head.split("=")[0]:
        name = VARIABLE.search(head.split("=")[0].strip())
        return ("variable", name.group(1)) if name else None
    return None


def main(files):
    if not files:
        listed = subprocess.run(["git", "ls-files", "-z", "--", "*.h", "*.cpp"], check=True, capture_output=True)
        files = [file for file in listed.stdout.decode().split("\0") if file]
    places = collections.defaultdict(dict)
    for file in files:
        if not os.path.exists(file):
            continue
        for kind, name, line in definitions_in(file):
            places[kind, name].setdefault(file, line)
    faults = [(key, at) for key, at in sorted(places.items()) if len(at) > 1 and not REPLACEABLE.match(key[1])]
    for (kind, name), at in faults:
        print(f"{name}: one {kind} name with several definitions; rename one of them:")
        for file, line in sorted(at.items()):
            print(f"  {file}:{line}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
