#!/usr/bin/env python3
"""Checks that each function in the unwind tables of shared libraries has a size.

    unwind_tables.py FOLDER

The linker keeps one entry for each address. If that is of an empty part of a function, which g++ makes sometimes, then
exceptions cannot pass the function that follows at the same address, and abort the program."""
import argparse
import struct
import subprocess
import sys
from pathlib import Path


def sections(library):
    """Address and content of each section, by name."""
    content = library.read_bytes()
    found = {}
    for line in subprocess.run(["readelf", "-SW", library], check=True, capture_output=True, text=True).stdout.splitlines():
        words = line.partition("]")[2].split()
        if len(words) > 4 and words[0].startswith("."):
            address, offset, size = (int(word, 16) for word in words[2:5])
            found[words[0]] = (address, content[offset:offset + size])
    return found


def empty_functions(library):
    """Addresses of empty functions in the table by which exceptions find functions (LSB, .eh_frame_hdr), and its size."""
    found = sections(library)
    table_at, table = found[".eh_frame_hdr"]
    frames_at, frames = found[".eh_frame"]
    assert table[:4] == bytes([1, 0x1b, 3, 0x3b]), f"{library}: .eh_frame_hdr has another encoding"
    (count,) = struct.unpack_from("<I", table, 8)
    empty = []
    for function, entry in struct.iter_unpack("<ii", table[12:12 + 8 * count]):
        (size,) = struct.unpack_from("<I", frames, table_at + entry - frames_at + 12)
        if size == 0:
            empty.append(table_at + function)
    return empty, count


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=Path)
    libraries = sorted(file for file in parser.parse_args().folder.glob("*.so*") if not file.is_symlink())
    assert libraries, "there are no shared libraries"
    failed = False
    for library in libraries:
        empty, count = empty_functions(library)
        assert count > 10, f"{library}: {count} functions"
        for address in empty:
            print(f"{library.name}: the function at {address:#x} is empty")
        failed |= bool(empty)
    sys.exit(failed)


if __name__ == "__main__":
    main()
