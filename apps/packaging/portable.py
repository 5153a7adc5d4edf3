#!/usr/bin/env python3
"""Makes the portable archive: RoboSim for x86-64 Linux with all libraries that it needs, without windows, and a Python wheel.

    portable.py BUILD FOLDER

BUILD is a build tree with the targets robosim_program and robosim_python. FOLDER gets robosim-VERSION-linux-x86_64.tar.xz and the wheel.
SOURCE_DATE_EPOCH is the date of all files. doc/release.md describes the content."""
import base64
import hashlib
import lzma
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tarfile
import time
import zipfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
VERSION = re.search(r"project\(robosim VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8")).group(1)
SIZE_MAX = 60_000_000  # bytes of the archive
# Of every system: the C library, and those of the compiler, which must not be older than those that a system's graphics driver needs.
OF_THE_SYSTEM = re.compile(r"(ld-linux-x86-64|lib(c|m|dl|pthread|rt|resolv|util|mvec|stdc\+\+|gcc_s))\.so\.")
# OpenCV's reader of two formats of satellite pictures, which RoboSim never reads, needs GDAL and with it 80 libraries of 96 MB. In
# the archive it finds functions that return 0, as those of GDAL do for a file that they cannot read.
REPLACED = re.compile(r"libgdal\.so\.")
# Windows, and devices and MPI, which are loaded on demand; RoboSim reports what is missing.
LEFT_OUT = ("libexec/robosim/robosim-view", "lib/librobosim-viewing.so*", "lib/librobosim-devices.so*", "lib/librobosim-mpi.so*",
            "lib/librobosim-dds.so*")
LOADED_BY_PYTHON = f"librobosim-program.so.{'.'.join(VERSION.split('.')[:2])}"
# Packages of files that are copied or embedded besides libraries: the font, and three.js in the page of a run.
EMBEDDED = ["fonts-dejavu-core", "libjs-three"]

FONTS_CONF = """<?xml version="1.0"?>
<!DOCTYPE fontconfig SYSTEM "urn:fontconfig:fonts.dtd">
<fontconfig>
  <include ignore_missing="yes">/etc/fonts/fonts.conf</include>
  <dir prefix="relative">.</dir>
  <cachedir prefix="xdg">fontconfig</cachedir>
</fontconfig>
"""
WHEEL_README = "RoboSim simulates teams of mobile robots. This wheel contains all libraries that it needs besides NumPy.\n"


def run(*command):
    return subprocess.run([str(word) for word in command], check=True, stdout=subprocess.PIPE, encoding="utf-8").stdout


def is_elf(file):
    with open(file, "rb") as stream:
        return stream.read(4) == b"\x7fELF"


def needed_by(file):
    return re.findall(r"NEEDED\s+(\S+)", run("objdump", "-p", file))


def system_libraries():
    """Paths of the system's libraries by the name by which programs need them."""
    paths = {}
    for name, path in re.findall(r"^\s+(\S+) \(libc6,x86-64[^)]*\) => (\S+)$", run("/sbin/ldconfig", "-p"), re.MULTILINE):
        paths.setdefault(name, pathlib.Path(path))
    return paths


def copy_needed(files, source, target):
    """Copies those files that are libraries of the folder source, and all libraries of it that they need, to target."""
    pending = list(files)
    for file in pending:
        if file.parent == source:
            shutil.copy2(file, target / file.name)
        pending += [source / name for name in needed_by(file) if (source / name).exists() and source / name not in pending]


class Elf:
    """A file of 64-bit little-endian ELF, whose dynamic section is edited in place: no byte moves."""

    RPATH, RUNPATH, STRTAB, STRSZ = 15, 29, 5, 10

    def __init__(self, file):
        self._file = file
        self.data = bytearray(file.read_bytes())
        header, = struct.unpack_from("<Q", self.data, 32)
        size, count = struct.unpack_from("<HH", self.data, 54)
        segments = [struct.unpack_from("<IIQQQQ", self.data, header + i * size) for i in range(count)]
        self._loads = [(address, offset, length) for kind, _, offset, address, _, length in segments if kind == 1]
        self._dynamic = next(offset for kind, _, offset, _, _, _ in segments if kind == 2)
        self._begin = self._offset_of(self._value(self.STRTAB))
        self._end = self._begin + self._value(self.STRSZ)

    def _offset_of(self, address):
        return next(offset + address - begin for begin, offset, length in self._loads if begin <= address < begin + length)

    def _entry(self, wanted):
        for position in range(self._dynamic, len(self.data), 16):
            tag, = struct.unpack_from("<Q", self.data, position)
            if tag in (wanted, 0):
                return position if tag else None
        return None

    def _value(self, tag):
        return struct.unpack_from("<Q", self.data, self._entry(tag) + 8)[0]

    def rename(self, names):
        """Replaces names of libraries by others of the same length: its own, those that it needs, and those of their versions."""
        strings = bytes(self.data[self._begin:self._end])
        for old, new in names.items():
            assert len(old) == len(new)
            strings = strings.replace(b"\0" + old.encode() + b"\0", b"\0" + new.encode() + b"\0")
        self.data[self._begin:self._end] = strings

    def pass_on_rpath(self, rpath=None):
        """Makes the search path hold also for libraries that the file needs indirectly: these then need none of their own.

        @param rpath another search path, not longer than the present one"""
        entry = self._entry(self.RUNPATH)
        struct.pack_into("<Q", self.data, entry, self.RPATH)
        if rpath:
            begin = self._begin + struct.unpack_from("<Q", self.data, entry + 8)[0]
            end = self.data.index(b"\0", begin)
            assert len(rpath) <= end - begin, (self._file, rpath)
            self.data[begin:end] = rpath.encode().ljust(end - begin, b"\0")

    def write(self):
        self._file.write_bytes(self.data)


class Libraries:
    """The libraries of others that files need, copied to a folder.

    They are renamed, libz.so.1 to rs-z.so.1: a process that also loads the system's library of that name, as Python's ssl or a
    graphics driver does, then has both, and each finds its own. Search paths are those of RoboSim's programs, passed on."""

    def __init__(self, roots):
        system = system_libraries()
        own = {root.name for root in roots}
        self._paths = {}
        self._users = {}  # of replaced libraries
        pending = list(roots)
        while pending:
            file = pending.pop()
            for name in needed_by(file):
                if OF_THE_SYSTEM.match(name) or name in self._paths or name in own:
                    continue
                if REPLACED.match(name):
                    self._users.setdefault(name, []).append(file)
                    continue
                if name not in system:
                    raise SystemExit(f"portable.py: {file} needs {name}, which is not installed")
                self._paths[name] = system[name]
                pending.append(system[name])
        self.names = {name: re.sub("^lib", "rs-", name) for name in [*self._paths, *self._users]}

    def copy_to(self, folder):
        for name, path in self._paths.items():
            shutil.copyfile(path, folder / self.names[name])
        for name, users in self._users.items():
            self._write_replacement(name, folder / self.names[name], users)
        copies = [folder / name for name in sorted(self.names.values())]
        run("strip", "--strip-unneeded", *copies)
        for copy in copies:
            self.redirect(copy)
            copy.chmod(0o755)

    def redirect(self, file):
        """Makes a file load the copies."""
        elf = Elf(file)
        elf.rename(self.names)
        elf.write()

    def _write_replacement(self, name, copy, users):
        real = system_libraries()[name]
        defined = set(re.findall(r" [TWi] (\w+)$", run("nm", "-D", "--defined-only", real), re.MULTILINE))
        undefined = set(re.findall(r" U (\w+)$", run("nm", "-D", "--undefined-only", *users), re.MULTILINE))
        code = "".join(f"long {function}(void) {{ return 0; }}\n" for function in sorted(defined & undefined))
        subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-w", "-fno-builtin", f"-Wl,-soname,{name}", "-x", "c", "-", "-o", copy],
                       input=code, encoding="utf-8", check=True)

    def packages(self, files):
        """The Debian packages of some of the copies, for their licences."""
        wanted = {file.name for file in files}
        candidates = {}  # package files of one library, as a system whose /lib is a link to /usr/lib has them
        for name, path in self._paths.items():
            if self.names[name] in wanted:
                real = str(path.resolve())
                candidates[name] = {str(path), real, real.removeprefix("/usr")}
        found = subprocess.run(["dpkg-query", "-S", *sorted(set().union(*candidates.values()))], check=False,
                               stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, encoding="utf-8").stdout
        package_of = {path: package for package, path in re.findall(r"^([^:,\n]+)[^/\n]*: (/.+)$", found, re.MULTILINE)}
        packages = set()
        for name, paths in candidates.items():
            owners = {package_of[path] for path in paths if path in package_of}
            if not owners:
                raise SystemExit(f"portable.py: {name} belongs to no package, so that its licence is unknown")
            packages |= owners
        return sorted(packages)


def install(build, component, prefix):
    run("cmake", "--install", build, "--component", component, "--prefix", prefix, "--strip")


def remove(prefix, patterns):
    for pattern in patterns:
        for path in prefix.glob(pattern):
            path.unlink()


def elf_files(folder):
    return [path for path in sorted(folder.rglob("*")) if path.is_file() and not path.is_symlink() and is_elf(path)]


def flatten_links(folder):
    """Keeps of each library the name by which others load it: wheels have no links."""
    for path in sorted(folder.glob("*.so*")):
        if path.is_symlink():
            target = path.resolve()
            path.unlink()
            target.rename(path)


def pass_on_rpath(file, rpath=None):
    elf = Elf(file)
    elf.pass_on_rpath(rpath)
    elf.write()


def add_fonts(share):
    fonts = share / "fonts"
    fonts.mkdir()
    shutil.copyfile("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", fonts / "DejaVuSans.ttf")
    (fonts / "fonts.conf").write_text(FONTS_CONF, encoding="utf-8")


def add_licences(packages, folder):
    folder.mkdir(parents=True)
    for package in packages:
        shutil.copyfile(f"/usr/share/doc/{package}/copyright", folder / package)


def glibc_of(files):
    """The oldest version of the C library with which files run."""
    versions = re.findall(r"GLIBC_2\.(\d+)", "".join(run("objdump", "-T", file) for file in files))
    return max(int(version) for version in versions)


def write_wheel(package_folder, file, tag, epoch, compression):
    """Packs a folder as a wheel: robosim/ and robosim.libs/, with metadata from pyproject.toml's facts."""
    info = f"robosim-{VERSION}.dist-info"
    entries = {}
    for path in sorted(package_folder.rglob("*")):
        if path.is_file():
            entries[path.relative_to(package_folder).as_posix()] = (path.read_bytes(), path.stat().st_mode & 0o111)
    project = (SOURCE / "pyproject.toml").read_text(encoding="utf-8")
    fields = {name: re.search(rf"^{name} = (.*)$", project, re.MULTILINE).group(1) for name in
              ("description", "requires-python", "dependencies", "optional-dependencies")}
    metadata = ["Metadata-Version: 2.1", "Name: robosim", f"Version: {VERSION}", f"Summary: {fields['description'].strip(chr(34))}",
                "License: BSD-3-Clause", f"Requires-Python: {fields['requires-python'].strip(chr(34))}"]
    metadata += [f"Requires-Dist: {text}" for text in re.findall(r'"([^"]+)"', fields["dependencies"])]
    metadata += ["Provides-Extra: remote"]
    metadata += [f'Requires-Dist: {text}; extra == "remote"' for text in re.findall(r'"([^"]+)"', fields["optional-dependencies"])]
    entries[f"{info}/METADATA"] = (("\n".join(metadata) + "\n\n" + WHEEL_README).encode(), 0)
    entries[f"{info}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: robosim {VERSION}\nRoot-Is-Purelib: false\nTag: {tag}\n".encode(), 0)
    entries[f"{info}/LICENSE"] = ((SOURCE / "LICENSE").read_bytes(), 0)
    record = ""
    for name, (content, _) in entries.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        record += f"{name},sha256={digest},{len(content)}\n"
    entries[f"{info}/RECORD"] = (f"{record}{info}/RECORD,,\n".encode(), 0)
    date = time.gmtime(max(epoch, 315532800))[:6]  # the format begins in 1980
    with zipfile.ZipFile(file, "w", compression) as archive:
        for name, (content, is_executable) in entries.items():
            entry = zipfile.ZipInfo(name, date)
            entry.external_attr = (0o100755 if is_executable else 0o100644) << 16
            entry.compress_type = compression
            archive.writestr(entry, content)


def write_archive(folder, file, epoch):
    """The folder as .tar.xz. Equal content gives equal bytes. The dictionary spans the archive, so that libraries that are in both the
    program and the wheel, which is stored without compression, take space once."""
    def plain(member):
        member.uid = member.gid = 0
        member.uname = member.gname = ""
        member.mtime = epoch
        member.mode = 0o755 if member.isdir() or member.mode & 0o111 else 0o644
        return member

    # Without the filter for x86, which makes equal code at different places differ.
    filters = [{"id": lzma.FILTER_LZMA2, "preset": 9, "dict_size": 256 << 20}]
    with lzma.open(file, "wb", check=lzma.CHECK_CRC64, filters=filters) as stream, tarfile.open(fileobj=stream, mode="w") as archive:
        archive.add(folder, folder.name, recursive=False, filter=plain)
        for path in sorted(folder.rglob("*")):
            archive.add(path, path.relative_to(folder.parent).as_posix(), recursive=False, filter=plain)


def main(build, output):
    epoch = int(os.environ.get("SOURCE_DATE_EPOCH") or time.time())
    shutil.rmtree(output, ignore_errors=True)
    name = f"robosim-{VERSION}-linux-x86_64"
    root = output / name
    install(build, "robosim", root)
    remove(root, LEFT_OUT)
    shutil.rmtree(root / "lib/robosim", ignore_errors=True)  # codecs that forward to a library of the system's name
    flatten_links(root / "lib")
    staged = output / "python"
    install(build, "python3-robosim", staged)
    package, = staged.glob("lib/python3*/*-packages/robosim")
    wheel_root = output / "wheel"
    wheel_root.mkdir()
    package.rename(wheel_root / "robosim")
    shutil.rmtree(staged)
    package = wheel_root / "robosim"

    # The wheel's part of RoboSim's libraries, and the data with them (base/data_folders.h).
    libs = wheel_root / "robosim.libs"
    libs.mkdir()
    extension = package / "_robosim.so"
    own = sorted((root / "lib").glob("librobosim*"))
    libraries = Libraries(elf_files(root) + [extension])
    libraries.copy_to(root / "lib")
    for file in own + elf_files(root / "bin") + elf_files(root / "libexec") + [extension]:
        libraries.redirect(file)
    for file in elf_files(root / "bin") + elf_files(root / "libexec"):
        pass_on_rpath(file)
    pass_on_rpath(extension, "$ORIGIN/../robosim.libs")
    # The extension does not need the second one, but loads it for maps, recordings and pictures (apps/python/file_functions.h).
    copy_needed([extension, root / "lib" / LOADED_BY_PYTHON], root / "lib", libs)

    add_fonts(root / "share/robosim")
    shutil.copytree(root / "share/robosim", libs / "share/robosim")
    for files, folder in ((root / "lib", root / "share/doc/robosim/licences"), (libs, libs / "licences")):
        add_licences(libraries.packages(list(files.iterdir())) + EMBEDDED, folder)
    shutil.copyfile(SOURCE / "apps/packaging/portable.txt", root / "README.txt")

    abi = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag = f"{abi}-{abi}-manylinux_2_{glibc_of(elf_files(wheel_root))}_x86_64"
    wheel = f"robosim-{VERSION}-{tag}.whl"
    write_wheel(wheel_root, root / wheel, tag, epoch, zipfile.ZIP_STORED)
    write_wheel(wheel_root, output / wheel, tag, epoch, zipfile.ZIP_DEFLATED)
    archive = output / f"{name}.tar.xz"
    write_archive(root, archive, epoch)
    print(f"The archive runs with glibc 2.{glibc_of(elf_files(root))} or newer")
    for file in (archive, output / wheel):
        print(f"{file}: {file.stat().st_size / 1e6:.1f} MB")
    if archive.stat().st_size > SIZE_MAX:
        raise SystemExit(f"portable.py: the archive is larger than {SIZE_MAX / 1e6:.0f} MB; see which libraries are new in {root}/lib")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve())
