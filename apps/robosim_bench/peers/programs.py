"""How each simulator is started, and what it prints."""
import csv
import os
import re
import shutil
import subprocess
from pathlib import Path

import worlds

STEP_S = 0.1


class Failed(Exception):
    """A program that is missing or ends with an error; the text states which, and how to fix it."""


def found(program, option):
    """The path of a program, of which a name is searched in $PATH. Raises Failed."""
    path = shutil.which(program)
    if not path:
        raise Failed(f"{option} {program}: is no executable program; name the installed one, or leave out the option")
    return path


def environment(program):
    """That of a program whose libraries may be in ../lib or, of ARGoS, in ../lib/argos3, where no system looks."""
    below = Path(program).resolve().parent.parent / "lib"
    libraries = [str(below), str(below / "argos3"), *filter(None, [os.environ.get("LD_LIBRARY_PATH")])]
    return {**os.environ, "LD_LIBRARY_PATH": ":".join(libraries)}


def wait_for(command, folder, program):
    """Runs a command to its end. Returns its exit code, its output and its processor time [s], of all its threads and processes.

    program: that the command starts, beside whose folder libraries may be."""
    with open(Path(folder) / "out.txt", "w+b") as out:
        process = subprocess.Popen(command, cwd=folder, env=environment(program), stdin=subprocess.DEVNULL, stdout=out,
                                   stderr=subprocess.STDOUT)
        try:
            _, status, used = os.wait4(process.pid, 0)
        except BaseException:
            process.terminate()  # `timeout` passes it on to its program, in a process group that Ctrl-C does not reach
            process.wait()
            raise
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        return process.returncode, out.read().decode(errors="replace"), used.ru_utime + used.ru_stime


def run(command, folder):
    """Runs a command to its end. Returns its output and its processor time [s]. Raises Failed if it ends with an error."""
    code, text, used_s = wait_for(command, folder, command[0])
    if code != 0:
        lines = [line for line in text.splitlines() if line.strip()][-3:]
        raise Failed(f"{' '.join(map(str, command))}: ended with {code}: {' / '.join(lines)}")
    return text, used_s


def first_readings(text, robots, rays):
    """The lines "READINGS r3 0.5 inf …" of an output, by robot. Raises Failed when a robot has none, or not one for each ray."""
    by_name = {}
    for match in re.finditer(r"READINGS (\S+)((?: (?:[-+]?(?:inf|nan)|[-+.0-9eE]+)\b)+)", text):
        by_name.setdefault(match[1], [float(number) for number in match[2].split()])
    for name in (f"r{i}" for i in range(robots)):
        if name not in by_name:
            raise Failed(f"it has printed no readings of {name}")
        if len(by_name[name]) != rays:
            raise Failed(f"it has printed {len(by_name[name])} readings of {name} in place of {rays}")
    return [by_name[f"r{i}"] for i in range(robots)]


class Simulator:
    """A simulator in one setting.

    name: of the row. note: what the table says about it. workload: of scene.WORKLOADS. long_max_s: of a run, simulated."""

    long_max_s = 1e7

    def __init__(self, name, program, workload, note=""):
        self.name, self.program, self.workload, self.note = name, program, workload, note

    def prepare(self, scene, folder):
        """Writes what does not depend on the length of a run."""

    def command(self, scene, folder, seconds):
        """Writes the world for a run of so many simulated seconds, and returns the command."""
        raise NotImplementedError

    def processor_s(self, scene, folder, seconds):
        return run(self.command(scene, folder, seconds), folder)[1]

    def check_speed(self, used_s, seconds, robots):
        """Raises Failed if the processor time of so many simulated seconds, net of the start, shows that fewer were simulated."""

    def readings(self, scene, folder):
        """Ranges at the start poses, by robot and ray; None if the simulator does not report them."""
        return first_readings(run(self.command(scene, folder, 1), folder)[0], len(scene.robots), scene.ring.count)


class RoboSim(Simulator):
    SENSORS = {"sonar": 'sonar model="rays" rays="1"', "proximity": 'infrared range_min_m="0"'}

    def prepare(self, scene, folder):
        (folder / "robots").mkdir(exist_ok=True)
        (folder / "robots" / "peer.xml").write_text(worlds.robosim_type(scene, self.SENSORS[self.workload]))
        (folder / "peer.xml").write_text(worlds.robosim_world(scene))

    def command(self, scene, folder, seconds, controller="wander"):
        return [self.program, "run", "peer.xml", "--controller", controller, "--threads", "1", "--time", f"{seconds:g}"]

    def readings(self, scene, folder):
        run([*self.command(scene, folder, STEP_S, "still"), "--csv", "first.csv"], folder)
        with open(folder / "first.csv", newline="") as file:
            rows = csv.reader(file)
            header = next(rows)
            sensor = self.SENSORS[self.workload].split()[0]
            columns = [header.index(f"{sensor}/range_{i}_m") for i in range(scene.ring.count)]
            first = {row[header.index("robot")]: row for row in rows if row[header.index("step")] == "0"}
        return [[float(first[f"r{i}"][column] or "inf") for column in columns] for i in range(len(scene.robots))]


class Stage(Simulator):
    """cell: side of the cells of its raster [m]."""

    def __init__(self, name, program, workload, cell, note=""):
        super().__init__(name, program, workload, note)
        self.cell = cell

    def prepare(self, scene, folder):
        """Compiles the controller against the headers beside the program."""
        prefix = Path(self.program).resolve().parent.parent
        headers = sorted(prefix.glob("include/Stage-*/stage.hh"))
        if not headers:
            raise Failed(f"{self.program}: has no headers in {prefix}/include/Stage-*, with which its robots' controller is compiled; "
                         "name the program of a complete installation of Stage 4")
        source = Path(__file__).with_name("stage_walk.cc")
        run(["g++", "-O2", "-shared", "-fPIC", "-std=c++17", "-w", f"-I{headers[-1].parent}", str(source), "-o",
             str(folder / "stage_walk.so")], folder)

    def command(self, scene, folder, seconds):
        (folder / "peer.world").write_text(worlds.stage_world(scene, seconds, self.cell, folder / "stage_walk"))
        return [self.program, "-g", "peer.world"]


class Argos(Simulator):
    """iterations: sub-steps of the physics engine."""

    def __init__(self, name, program, workload, iterations, note=""):
        super().__init__(name, program, workload, note)
        self.iterations = iterations

    def prepare(self, scene, folder):
        (folder / "walk.lua").write_text(worlds.argos_script(scene))

    def command(self, scene, folder, seconds):
        (folder / "peer.argos").write_text(worlds.argos_experiment(scene, seconds, "walk.lua", self.iterations))
        return [self.program, "--no-color", "-z", "-c", "peer.argos"]

    def readings(self, scene, folder):
        return [[worlds.argos_distance(reading, scene.ring.range_max) for reading in robot]
                for robot in super().readings(scene, folder)]


class MVSim(Simulator):
    """Runs in real time, until it is interrupted. Its speed is at most the measured one, because steps that it takes late or leaves
    out are counted; with several threads, it is known to keep up only while all of them together use less than one processor."""

    long_max_s = 600

    def command(self, scene, folder, seconds):
        (folder / "peer.world.xml").write_text(worlds.mvsim_world(scene))
        return ["timeout", "--signal=INT", "--kill-after=10", f"{seconds:g}", self.program, "launch", "peer.world.xml", "--headless"]

    def processor_s(self, scene, folder, seconds):
        command = self.command(scene, folder, seconds)
        code, _, used_s = wait_for(command, folder, self.program)
        if code != 124:  # of timeout, which has ended it
            raise Failed(f"{' '.join(command)}: ended by itself, with {code}")
        return used_s

    def check_speed(self, used_s, seconds, robots):
        if used_s > 0.9 * seconds:
            raise Failed(f"it does not keep up with real time with {robots} robots, so that its speed is unknown")

    def readings(self, scene, folder):
        return None
