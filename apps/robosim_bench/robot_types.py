#!/usr/bin/python3
"""Measures the speed of each robot type in C++ and in Python, and prints the table of doc/performance.md.

robot_types.py ROBOSIM_BENCH [SECONDS] [ROUNDS]; the package robosim must be on Python's path. Also replaces the rows of README.md and
doc/performance.md, whose date is then to be changed. Columns, as steps of a robot per second of
processor time, one thread, the best of the rounds, in which all alternate: other programs only slow it down.
  C++         robosim_bench speed --robot-type TYPE --robots 100: controller wander, with the digest
  Simulation  the same world in robosim.Simulation: each step assigns the commands of all robots and reads their ranges
  VectorEnv   1,000 environments of 8 worlds of one robot: observations of the ranges and of the odometry, resets included
Cameras take no pictures in C++, and their types are left out in Python. Each figure comes from a process of its own.
"""
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import robosim
from learn import measure

ROBOTS = 100  # of the world of C++ and Simulation
WORLDS = 8  # of VectorEnv
ENVIRONMENTS = 1000


def range_sensor(world):
    """Label of the sensor that is read: the laser of a robot that has one, otherwise the sonar."""
    kinds = {sensor.kind for sensor in world.robots[0].sensors}
    return "laser" if "laser" in kinds else "sonar"


def of_simulation(folder, robot_type, min_s):
    world = robosim.World.load(world_of(folder, robot_type, ROBOTS, 1))
    sensor = range_sensor(world)
    random = np.random.default_rng(1)
    commands = [np.stack([random.uniform(0.2, 1, ROBOTS), random.uniform(-0.5, 0.5, ROBOTS)], -1) for _ in range(16)]
    with robosim.Simulation(world, controller="none") as simulation:
        ranges = simulation.readings(sensor)
        speeds, steps = [], 0
        for _ in range(9):
            done, begin = 0, time.process_time()
            while (used_s := time.process_time() - begin) < min_s / 9:
                simulation.commands = commands[steps // 8 % len(commands)]
                simulation.step()
                simulation.readings(sensor, out=ranges)
                steps += 1
                done += ROBOTS
            speeds.append(done / used_s)
    return statistics.median(speeds)


def of_vector_env(folder, robot_type, min_s):
    worlds = [world_of(folder, robot_type, 1, seed) for seed in range(1, WORLDS + 1)]
    sensor = range_sensor(robosim.World.load(worlds[0]))
    return measure(robosim.VectorEnv(worlds, ENVIRONMENTS, max_steps=500, observations=(sensor, "odometry")), min_s)


def world_of(folder, robot_type, robots, seed):
    return os.path.join(folder, robot_type, str(robots), str(seed), robot_type + ".xml")


def replace_rows(page, rows):
    """Replaces the rows of a page's table that has this script's name in a comment before it."""
    before, comment, after = page.read_text(encoding="utf-8").partition("<!-- Rows by apps/robosim_bench/robot_types.py -->")
    table, blank, rest = after.partition("\n\n")
    lines = [rows.get((re.match(r"\| `([^`]+)` \|", line) or [None, None])[1], line) for line in table.split("\n")]
    page.write_text(before + comment + "\n".join(lines) + blank + rest, encoding="utf-8")


def in_process(what, *arguments):
    """A figure, measured in a process of its own."""
    output = subprocess.check_output([sys.executable, "-B", __file__, "--measure", what, *arguments], text=True)
    return float(output)


def main():
    if sys.argv[1] == "--measure":
        what, folder, robot_type, min_s = sys.argv[2:]
        print({"simulation": of_simulation, "vector_env": of_vector_env}[what](folder, robot_type, float(min_s)))
        return
    bench = sys.argv[1]
    min_s = sys.argv[2] if len(sys.argv) > 2 else "1"
    rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 5
    speed = [bench, "speed", "--robots", str(ROBOTS), "--json", "--min-time"]
    with tempfile.TemporaryDirectory() as folder:
        lines = subprocess.check_output([*speed, "1e-6", "--robot-type", "all"], text=True).splitlines()
        types = [json.loads(line)["workload"] for line in lines]
        figures = {(of, column): [] for of in types for column in range(3)}
        without_camera = []
        for of in types:
            for robots, seeds in ((ROBOTS, [1]), (1, range(1, WORLDS + 1))):
                for seed in seeds:
                    subprocess.run([bench, "speed", "--robot-type", of, "--robots", str(robots), "--seed", str(seed), "--write-world",
                                    os.path.dirname(world_of(folder, of, robots, seed))], check=True, stdout=subprocess.DEVNULL)
            sensors = robosim.World.load(world_of(folder, of, 1, 1)).robots[0].sensors
            if not any(sensor.kind == "camera" for sensor in sensors):
                without_camera.append(of)
        for _ in range(rounds):
            for of in types:
                line = subprocess.check_output([*speed, min_s, "--robot-type", of], text=True)
                figures[of, 0].append(1 / json.loads(line)["cpu_s_per_robot_step"])
                if of in without_camera:
                    figures[of, 1].append(in_process("simulation", folder, of, min_s))
                    figures[of, 2].append(in_process("vector_env", folder, of, min_s))
    rows = {}
    for of in types:
        cells = [f"{float(f'{max(of_column):.3g}'):,.0f}" if (of_column := figures[of, column]) else "–" for column in range(3)]
        rows[of] = f"| `{of}` | {' | '.join(cells)} |"
    print("| robot type | C++ | Python, `Simulation` | Python, `VectorEnv` |\n|---|---|---|---|", *rows.values(), sep="\n")
    for page in ("README.md", "doc/performance.md"):
        replace_rows(Path(__file__).parents[2] / page, rows)


if __name__ == "__main__":
    main()
