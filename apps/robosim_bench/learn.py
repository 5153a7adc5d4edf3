#!/usr/bin/python3
"""Measures robosim.VectorEnv with the batches of `robosim_bench learn`, and compares it with that.

learn.py ROBOSIM_BENCH [SECONDS]; the package robosim must be on Python's path. Prints agent-steps per second of
processor time, one thread, including resets, and Python's share of the speed of C++.
"""
import json
import os
import subprocess
import sys
import tempfile
import time

import numpy as np

import robosim

ROBOTS = 1000  # agents of a batch
ROUNDS = 9


def environments(folder, workload, team):
    worlds = [os.path.join(folder, str(team), str(seed), workload + ".xml") for seed in range(1, 9)]
    return robosim.VectorEnv(worlds, ROBOTS // team, robots=team, max_steps=500,
                             observations=("laser" if workload == "laser" else "sonar", "odometry"))


def measure(env, min_s):
    """Agent-steps per second: median of the rounds."""
    random = np.random.default_rng(1)
    shape = env.action_space.shape
    actions = [np.stack([random.uniform(0.2, 1, shape[:-1]), random.uniform(-0.5, 0.5, shape[:-1])], -1)
               .astype(np.float32) for _ in range(16)]
    env.reset()
    steps, speeds = 0, []
    for _ in range(20):
        env.step(actions[0])
    for _ in range(ROUNDS):
        done, begin = 0, time.process_time()
        while (used_s := time.process_time() - begin) < min_s / ROUNDS:
            env.step(actions[steps // 8 % len(actions)])
            steps += 1
            done += ROBOTS
        speeds.append(done / used_s)
    return sorted(speeds)[ROUNDS // 2]


def main():
    bench, min_s = sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 3.0
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([bench, "learn", "--write-worlds", folder], check=True)
        figures = json.loads(subprocess.check_output([bench, "learn", "--json", "--min-time", str(min_s)]))
        print("workload  robots per world       C++    Python  share")
        for of in figures["speed"]:
            env = environments(folder, of["workload"], of["robots_per_world"])
            python, cpp = measure(env, min_s), of["agent_steps_per_s"]
            print(f"{of['workload']:<8}  {of['robots_per_world']:>16} {cpp:>9,.0f} {python:>9,.0f}  {python / cpp:.2f}")


if __name__ == "__main__":
    main()
