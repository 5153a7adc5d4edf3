#!/usr/bin/python3
"""Compares RoboSim with other simulators of robot teams that are installed: `./dev bench peers`.

Each runs on a world of its own format that is generated from one scene, by turns, one thread each (of MVSim all of its threads).
Robot-steps per second of processor time, of 0.1 s each, net of start-up: a long run less a short one. Accuracy: shares of the ranges at
the start poses that differ by more than 2, 10 and 30 cm (of sensors to 10 cm: 2, 5 and 10 mm) from brute force. Nothing is installed,
and nothing of others is built; for Stage a controller is compiled against its headers."""
import argparse
import datetime
import platform
import statistics
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "peers"))

from programs import STEP_S, Argos, Failed, MVSim, RoboSim, Stage, found  # noqa: E402
from scene import WORKLOADS, exact_ranges, make_scene  # noqa: E402

ERRORS_M = {"sonar": (0.02, 0.1, 0.3), "proximity": (0.002, 0.005, 0.01)}


def parse_arguments(arguments=None):
    parser = argparse.ArgumentParser(prog="./dev bench peers", description=__doc__.splitlines()[0],
                                     epilog="Without --stage, --argos and --mvsim, only RoboSim runs.")
    parser.add_argument("robosim", help=argparse.SUPPRESS)
    parser.add_argument("--stage", metavar="PATH", help="program stage of Stage 4, with its headers in ../include")
    parser.add_argument("--stage-cell", metavar="M", type=float, action="append",
                        help="side of Stage's cells; repeatable; default: 0.02, which is Stage's, and 0.1")
    parser.add_argument("--argos", metavar="PATH", help="program argos3 of ARGoS 3, with Lua and the foot-bot")
    parser.add_argument("--mvsim", metavar="PATH", help="program mvsim")
    parser.add_argument("--robots", metavar="N", type=int, action="append", help="repeatable; default: 100 and 1000")
    parser.add_argument("--rounds", metavar="N", type=int, default=3, help="measurements of each (default: 3)")
    parser.add_argument("--at-least", metavar="SECONDS", type=float, default=2,
                        help="minimum processor time of a measurement (default: 2 s)")
    parser.add_argument("--seed", metavar="N", type=int, default=1, help="of the scenes (default: 1)")
    parsed = parser.parse_args(arguments)
    parsed.robots = parsed.robots or [100, 1000]
    if parsed.rounds < 1 or min(parsed.robots) < 1 or not 0 < parsed.at_least <= 600:
        parser.error("--rounds and --robots must be positive, and --at-least in (0, 600]")
    if any(not 0.001 <= cell <= 1 for cell in parsed.stage_cell or []):
        parser.error("--stage-cell must be in [0.001, 1] m")
    if parsed.stage_cell and not parsed.stage:
        parser.error("--stage-cell needs --stage")
    return parsed


def simulators(arguments):
    """All that run, those of a workload in a row, RoboSim first. Raises Failed for a program that is missing."""
    robosim = str(Path(arguments.robosim).resolve())
    rows = [RoboSim("RoboSim", robosim, "sonar")]
    if arguments.stage:
        path = str(Path(found(arguments.stage, "--stage")).resolve())
        for cell in arguments.stage_cell or [0.02, 0.1]:
            rows.append(Stage(f"Stage, {100 * cell:g} cm cells", path, "sonar", cell))
    if arguments.mvsim:
        path = str(Path(found(arguments.mvsim, "--mvsim")).resolve())
        rows.append(MVSim("MVSim", path, "sonar", "circles; its rays begin at the robot's centre; at most this fast"))
    if arguments.argos or not (arguments.stage or arguments.mvsim):
        rows.append(RoboSim("RoboSim", robosim, "proximity"))
    if arguments.argos:
        path = str(Path(found(arguments.argos, "--argos")).resolve())
        rows.append(Argos("ARGoS, defaults", path, "proximity", 10, "controller in Lua; contact forces"))
        rows.append(Argos("ARGoS, one sub-step", path, "proximity", 1, "controller in Lua; contact forces"))
    return rows


class Runner:
    """Measurements of a simulator on a scene, in a folder."""

    SHORT_S = 2  # simulated

    def __init__(self, simulator, scene, folder):
        self.simulator, self.scene, self.folder = simulator, scene, folder
        folder.mkdir()
        simulator.prepare(scene, folder)
        self.long_s = 4 * self.SHORT_S
        self.rates = []

    def used_s(self):
        """Processor time of the long run less that of the short one. Raises Failed for a run that does not count."""
        short_s = self.simulator.processor_s(self.scene, self.folder, self.SHORT_S)
        used_s = self.simulator.processor_s(self.scene, self.folder, self.long_s) - short_s
        self.simulator.check_speed(used_s, self.long_s - self.SHORT_S, len(self.scene.robots))
        return used_s

    def calibrate(self, at_least_s):
        """Makes the long run long enough. Half of the time suffices, because it is measured, not assumed."""
        while (used_s := self.used_s()) < at_least_s / 2:
            if self.long_s >= self.simulator.long_max_s:
                raise Failed(f"uses {max(used_s, 0):.2g} s of processor time for {self.long_s:,g} simulated seconds, "
                             "too little to be measured; use more --robots or a smaller --at-least")
            factor = 1.2 * at_least_s / max(used_s, at_least_s / 50)
            long_s = self.SHORT_S + (self.long_s - self.SHORT_S) * max(2, factor)
            self.long_s = min(round(long_s, 1), self.simulator.long_max_s)

    def measure(self):
        used_s = self.used_s()
        if used_s <= 0:
            raise Failed(f"has used less processor time for {self.long_s:,g} simulated seconds than for {self.SHORT_S}; "
                         "use a larger --at-least")
        self.rates.append(len(self.scene.robots) * (self.long_s - self.SHORT_S) / STEP_S / used_s)

    def errors(self, exact):
        """Shares of the rays with errors above ERRORS_M, or with NaN; None if the simulator reports no readings."""
        readings = self.simulator.readings(self.scene, self.folder)
        if readings is None:
            return None
        range_max = self.scene.ring.range_max
        errors = [abs(min(a, range_max) - b) for one, other in zip(readings, exact, strict=True)
                  for a, b in zip(one, other, strict=True)]
        return [sum(not error <= limit for error in errors) / len(errors) for limit in ERRORS_M[self.simulator.workload]]


def report(simulator, robots, failure):
    print(f"{simulator.name}, {robots} robots: {failure}", file=sys.stderr)


def measure(rows, robots, arguments, folder):
    """Prints a line of the table for each simulator that runs with so many robots."""
    for workload in dict.fromkeys(row.workload for row in rows):
        scene = make_scene(WORKLOADS[workload], robots, arguments.seed)
        exact = exact_ranges(scene)
        runners = {}
        for number, row in enumerate(rows):
            if row.workload != workload:
                continue
            try:
                runner = Runner(row, scene, folder / f"{robots}_{number}")
                errors = runner.errors(exact)
                runner.calibrate(arguments.at_least)
                runners[runner] = errors
            except Failed as failure:
                report(row, robots, failure)
        for i in range(arguments.rounds):
            for runner in list(runners)[::1 if i % 2 == 0 else -1]:  # a machine that becomes slower favours none
                try:
                    runner.measure()
                except Failed as failure:
                    report(runner.simulator, robots, failure)
                    del runners[runner]
        first = None
        for runner, errors in runners.items():
            rate = statistics.median(runner.rates)
            first = first or (rate if isinstance(runner.simulator, RoboSim) else None)
            ratio = "" if isinstance(runner.simulator, RoboSim) or not first else f"{first / rate:,.1f}"
            shares = "–" if errors is None else " / ".join(f"{100 * share:.1f}" for share in errors) + " %"
            print(f"| {WORKLOADS[workload].help} | {runner.simulator.name} | {robots:,} | {rate:,.0f} | {ratio} | {shares} "
                  f"| {runner.simulator.note} |", flush=True)


def machine():
    """The processor's name."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        return next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or "unknown processor"


def main():
    arguments = parse_arguments()
    try:
        rows = simulators(arguments)
    except Failed as failure:
        sys.exit(f"./dev bench peers: {failure}")
    absent = [name for name in ("stage", "argos", "mvsim") if not getattr(arguments, name)]
    print(f"{datetime.date.today():%-d %B %Y}, {machine()}, one thread each"
          + (" (MVSim: all of its threads)" if arguments.mvsim else "") + f", by turns, medians of {arguments.rounds}"
          + (f"; not measured: {', '.join(absent)}" if absent else "") + "\n")
    print("| workload | simulator | robots | robot-steps/s | RoboSim is faster by | wrong ranges | |")
    print("|---|---|---|---|---|---|---|", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        for robots in arguments.robots:
            measure(rows, robots, arguments, Path(folder))


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        sys.exit(130)
