#!/usr/bin/env python3
"""Learns to drive to gold by what a camera sees, and compares the result with others in rooms that it has not seen.

    learn_gold_pixels.py [--minutes 15] [--threads 2] [--policy FILE.npz] [--rooms 200]

A robot with a ray-cast camera of 64 × 64 pixels stands somewhere in a room with boxes and a golden cylinder. The policy is a
small network: the colours of the picture, averaged over blocks of pixels, to speed and turn rate. It learns by the evolution
strategy of learn_gold.py, which must lie in the same folder. Requires NumPy."""
import argparse
import time

import numpy as np

import robosim
from learn_gold import seconds_to_gold

HALF_M = 4  # half of the room's side
BOXES = 6
CAMERA = """<sensors> <odometry/> <heat/>
  <camera model="raycast" width_px="64" height_px="64" field_of_view_deg="90" z_m="0.35" range_max_m="12"/> </sensors>"""
TRAINING_SEEDS = range(1, 25)
FIRST_TEST_SEED = 100_001  # of rooms that training never uses
ROWS, COLUMNS = 4, 16  # of blocks in a picture
INPUTS = 3 * ROWS * COLUMNS + 1
HIDDEN = 8
PAIRS = 10
STEPS = 250  # of each candidate in each room, 25 s of simulated time
SIGMA = 0.05
RATE = 0.2
TIME_LIMIT_S = 60  # of a test


def room(seed):
    """A room with boxes, gold and a robot, at random places clear of each other."""
    rng = np.random.default_rng(seed)
    builder = robosim.WorldBuilder(x_m=(-HALF_M, HALF_M), y_m=(-HALF_M, HALF_M))
    for name, x_m, y_m, heading_rad in [("east", 1, 0, np.pi / 2), ("west", -1, 0, np.pi / 2), ("north", 0, 1, 0), ("south", 0, -1, 0)]:
        builder.box(name, x_m * (HALF_M - 0.05), y_m * (HALF_M - 0.05), length_m=2 * HALF_M, width_m=0.1, heading_rad=heading_rad,
                    color=(0.35, 0.45, 0.6))
    taken = []

    def place(radius_m):
        while True:
            at = rng.uniform(-HALF_M + 0.3 + radius_m, HALF_M - 0.3 - radius_m, 2)
            if all(np.hypot(*(at - other)) > radius_m + other_radius_m + 0.6 for other, other_radius_m in taken):
                taken.append((at, radius_m))
                return at

    builder.cylinder("gold", *place(0.2), radius_m=0.2, color=(1, 0.8, 0.1), heat_celsius=20)
    for i in range(BOXES):
        length_m = rng.uniform(0.3, 1)
        builder.box(f"box{i}", *place(length_m / 2), length_m=length_m, width_m=0.3, heading_rad=rng.uniform(0, np.pi),
                    color=tuple(rng.uniform(0.1, 0.7) * np.ones(3)))
    builder.robot("pioneer3dx", "R", *place(0.3), rng.uniform(-np.pi, np.pi))
    text = builder.to_xml().replace("<model>pioneer3dx</model>", "<model>pioneer3dx</model>" + CAMERA)
    return robosim.World.parse(text, name=f"room{seed}")


def features(pictures):
    """Mean colours of the blocks of pictures of shape (…, 64, 64, 3), each in [-1, 1], and a constant."""
    *shape, rows, columns, _ = pictures.shape
    blocks = pictures.reshape(*shape, ROWS, rows // ROWS, COLUMNS, columns // COLUMNS, 3).mean(axis=(-4, -2), dtype=np.float32)
    return np.concatenate([blocks.reshape(*shape, -1) / 127.5 - 1, np.ones((*shape, 1), np.float32)], axis=-1)


class Policy:
    """The weights of many networks: weights of shape (networks, size())."""

    def __init__(self, weights):
        first = INPUTS * HIDDEN
        self.into_hidden = weights[:, :first].reshape(-1, INPUTS, HIDDEN)
        self.into_action = weights[:, first:].reshape(-1, HIDDEN + 1, 2)

    @staticmethod
    def size():
        return INPUTS * HIDDEN + (HIDDEN + 1) * 2

    def act(self, inputs):
        """Actions of shape (networks, rooms, 2) for inputs of shape (networks, rooms, INPUTS)."""
        hidden = np.tanh(inputs @ self.into_hidden)
        return np.tanh(hidden @ self.into_action[:, :-1] + self.into_action[:, -1:])


def train(minutes, threads):
    rng = np.random.default_rng(1)
    rooms = [room(seed) for seed in TRAINING_SEEDS]
    candidates = 2 * PAIRS
    env = robosim.VectorEnv(rooms, num_envs=candidates * len(rooms), observations=("camera",), threads=threads,
                            reward={"win": 1, "heat": 0.01, "stall": -0.002}, max_steps=STEPS)
    mean = rng.normal(0, 0.05, Policy.size()).astype(np.float32)
    momentum = np.zeros_like(mean)
    shape = (candidates, len(rooms))
    end = time.monotonic() + 60 * minutes
    generation, steps = 0, 0
    while time.monotonic() < end:
        half = rng.normal(0, 1, (PAIRS, mean.size)).astype(np.float32)
        changes = np.concatenate([half, -half])
        policy = Policy(mean + SIGMA * changes)
        starts = rng.integers(2**31, size=len(rooms))  # the same for all candidates
        observations, _ = env.reset(seed=[int(seed) for seed in np.tile(starts, candidates)])
        returns = np.zeros(shape)
        found = 0
        for _ in range(STEPS):
            pictures = observations["camera"].reshape(*shape, *observations["camera"].shape[1:])
            observations, rewards, terminated, _, _ = env.step(policy.act(features(pictures)).reshape(-1, 2))
            returns += rewards.reshape(shape)
            found += terminated.sum()
        steps += STEPS * env.num_envs
        fitness = returns.mean(axis=1)
        ranks = fitness.argsort().argsort() / (candidates - 1) - 0.5  # robust against outliers
        momentum = 0.9 * momentum + 0.1 * (ranks @ changes) / (candidates * SIGMA)
        mean += RATE * momentum
        generation += 1
        if generation % 5 == 0:
            print(f"generation {generation}: gold per robot and minute {found / env.num_envs * 600 / STEPS:.2f}, "
                  f"mean return {fitness.mean():.3f}, {steps:,} pictures", flush=True)
    env.close()
    return mean


class Learned(robosim.Controller):
    """Drives one robot by a policy."""

    def __init__(self, weights):
        self.policy = Policy(weights[None])
        self.action = np.zeros(2)

    def step(self, robot):
        if robot.image is not None:
            self.action = self.policy.act(features(robot.image[None, None]))[0, 0]
        robot.drive(float(self.action[0]) * robot.speed_max_mps, float(self.action[1]) * robot.turn_max_radps)


def evaluate(weights, rooms):
    seeds = range(FIRST_TEST_SEED, FIRST_TEST_SEED + rooms)
    untrained = np.random.default_rng(1).normal(0, 0.05, Policy.size()).astype(np.float32)
    controllers = {"untrained": lambda: Learned(untrained), "gold_finder, with the heat only": "gold_finder", "learned": lambda: Learned(weights)}
    print(f"\n{rooms} other rooms, {TIME_LIMIT_S} s:\n\n| controller | found | median time to the gold [s] |\n|---|---|---|")
    for label, controller in controllers.items():
        times = np.sort([seconds_to_gold(room(seed), seed, controller, TIME_LIMIT_S) for seed in seeds])
        print(f"| {label} | {np.isfinite(times).mean():.0%} | {times[(len(times) - 1) // 2]:.1f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--minutes", type=float, default=15, help="time for training (default 15)")
    parser.add_argument("--threads", type=int, default=2, help="threads of the engine (default 2)")
    parser.add_argument("--policy", default="gold_pixels_policy.npz", help="file for the learned policy")
    parser.add_argument("--evaluate", metavar="FILE", help="only evaluate the policy of this file")
    parser.add_argument("--rooms", type=int, default=200, help="number of rooms for the comparison (default 200)")
    arguments = parser.parse_args()
    if arguments.evaluate:
        evaluate(np.load(arguments.evaluate)["weights"], arguments.rooms)
        return
    weights = train(arguments.minutes, arguments.threads)
    np.savez(arguments.policy, weights=weights)
    evaluate(weights, arguments.rooms)


if __name__ == "__main__":
    main()
