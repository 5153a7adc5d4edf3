#!/usr/bin/env python3
"""Learns to drive to gold by what a camera sees, and compares the result with others in rooms that it has not seen.

    learn_gold_pixels.py [--starts 3] [--minutes 15] [--threads 2] [--policy FILE.npz] [--rooms 200]

A robot with a ray-cast camera of 64 × 64 pixels stands somewhere in a room with boxes and a golden cylinder. The policy is a
network of 133 weights from the picture and the last turn rate to speed and turn rate. It learns by the evolution strategy of
learn_gold.py, which must lie in the same folder, several times from other random weights, since some lead to a poor policy. The
policy that is kept is the one that finds the gold in most rooms of a second set, where it is tried after every ten generations.
Requires NumPy."""
import argparse
import itertools
import time

import numpy as np

import robosim
from learn_gold import seconds_to_gold

HALF_M = 4  # half of the room's side
BOXES = 6
PERIOD_S = 0.2  # between two pictures
CAMERA = f"""<sensors> <odometry/> <heat/>
  <camera model="raycast" width_px="64" height_px="64" field_of_view_deg="90" z_m="0.35" range_max_m="12"
    rate_hz="{1 / PERIOD_S}"/> </sensors>"""
TRAINING_SEEDS = range(1, 17)
VALIDATION_SEEDS = range(50_001, 50_101)  # of rooms that decide which policy is kept
FIRST_TEST_SEED = 100_001  # of rooms that training never uses
ROWS, COLUMNS = 8, 16  # of blocks in a picture
CHANNELS = 2
HIDDEN = 3
PAIRS = 12
GENERATIONS = 40  # of each start
STEPS = 125  # of each candidate in each room, 25 s of simulated time
SIGMA = 0.3
RATE = 1.0
INITIAL_STD = 0.3  # standard deviation of the weights before training
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
    """Mean colours of the blocks of pictures of shape (…, 64, 64, 3), each in [-3, 3]: shape (…, ROWS, COLUMNS, 3)."""
    *shape, height, width, _ = pictures.shape
    # Sums of rows of bytes, and then of slices, take a tenth of the time of mean() over both axes of the blocks.
    sums = pictures.reshape(*shape, ROWS, height // ROWS, width * 3).sum(axis=-2, dtype=np.uint16)
    sums = sums.reshape(*shape, ROWS, COLUMNS, width // COLUMNS, 3)
    sums = sum(sums[..., i, :] for i in range(width // COLUMNS))
    return sums * np.float32(6 / 255 * ROWS * COLUMNS / (height * width)) - 3


class Policy:
    """The weights of many networks: weights of shape (networks, size()).

    One filter of colours, the same for all blocks, turns red, green and blue into CHANNELS numbers. The rows of blocks are
    added with a weight each. Hidden units have the columns and the last turn rate as inputs, and mirrored units with the same
    weights have their mirror image. Speed is a weighted sum of both, turn rate a weighted difference: a mirrored picture
    results in the same speed and the opposite turn rate. By the last turn rate, a robot can continue to turn in one direction
    while no gold is in the picture."""

    SHAPES = {"color": (3 + 1, CHANNELS), "row": (ROWS, CHANNELS), "hidden": (COLUMNS * CHANNELS + 2, HIDDEN),
              "speed": (HIDDEN, 1), "turn": (HIDDEN, 1), "speed_bias": (1, 1)}

    def __init__(self, weights):
        ends = np.cumsum([np.prod(shape) for shape in self.SHAPES.values()])
        for (name, shape), part in zip(self.SHAPES.items(), np.split(weights, ends[:-1], axis=1)):
            setattr(self, name, part.reshape(-1, *shape))

    @classmethod
    def size(cls):
        return sum(int(np.prod(shape)) for shape in cls.SHAPES.values())

    def act(self, blocks, turned):
        """Actions of shape (networks, rooms, 2) for blocks of shape (networks, rooms, ROWS, COLUMNS, 3) and the last turn
        rates, of shape (networks, rooms, 1)."""
        channels = np.tanh(blocks.reshape(len(blocks), -1, 3) @ self.color[:, :3] + self.color[:, 3:])
        columns = np.einsum("nmrck,nrk->nmck", channels.reshape(*blocks.shape[:-1], CHANNELS), self.row / 4)

        def activations(columns, turned):
            inputs = np.concatenate([columns.reshape(*turned.shape[:2], -1), turned, np.ones_like(turned)], axis=-1)
            return np.tanh(inputs @ self.hidden)

        units, mirrored = activations(columns, turned), activations(columns[:, :, ::-1], -turned)
        return np.tanh(np.concatenate([(units + mirrored) @ self.speed + self.speed_bias, (units - mirrored) @ self.turn], axis=-1))


def attempt(env, weights, seeds, steps):
    """Drives each network, one row of weights, in each room, from the same starts for all networks. Returns the rewards and
    the numbers of times that gold was found, of shape (networks, rooms)."""
    shape = (len(weights), len(seeds))
    policy = Policy(weights)
    observations, _ = env.reset(seed=[int(seed) for seed in np.tile(seeds, len(weights))])
    turned = np.ones((*shape, 1), np.float32)
    returns, found = np.zeros(shape), np.zeros(shape)
    for _ in range(steps):
        pictures = observations["camera"].reshape(*shape, *observations["camera"].shape[1:])
        actions = policy.act(features(pictures), turned)
        observations, rewards, terminated, truncated, _ = env.step(actions.reshape(-1, 2))
        returns += rewards.reshape(shape)
        found += terminated.reshape(shape)
        turned = np.where((terminated | truncated).reshape(*shape, 1), np.float32(1), actions[..., 1:])
    return returns, found


def environments(rooms, networks, steps, threads):
    return robosim.VectorEnv(rooms, num_envs=networks * len(rooms), observations=("camera",), threads=threads, period_s=PERIOD_S,
                             reward={"win": 1, "heat": 0.01, "stall": -0.002}, max_steps=steps)


def train(starts, minutes, threads, file):
    """Stores the policy in the file whenever it is better than the stored one. Returns the last stored one."""
    candidates = 2 * PAIRS
    test_steps = round(TIME_LIMIT_S / PERIOD_S)
    env = environments([room(seed) for seed in TRAINING_SEEDS], candidates, STEPS, threads)
    validation = environments([room(seed) for seed in VALIDATION_SEEDS], 1, test_steps, threads)
    best, best_share = None, -1
    end = time.monotonic() + 60 * minutes
    for start, generation in itertools.product(range(1, starts + 1), range(1, GENERATIONS + 1)):
        if generation == 1:
            rng = np.random.default_rng(start)
            mean = rng.normal(0, INITIAL_STD, Policy.size()).astype(np.float32)
            momentum = np.zeros_like(mean)
        half = rng.normal(0, 1, (PAIRS, mean.size)).astype(np.float32)
        changes = np.concatenate([half, -half])
        returns, found = attempt(env, mean + SIGMA * changes, rng.integers(2**31, size=len(TRAINING_SEEDS)), STEPS)
        ranks = returns.mean(axis=1).argsort().argsort() - (candidates - 1) / 2  # robust against outliers
        momentum = 0.8 * momentum + 0.2 * (ranks / np.linalg.norm(ranks)).astype(np.float32) @ changes
        mean = mean + RATE * SIGMA * momentum
        is_over = time.monotonic() > end
        if generation % 10 == 0 or is_over:
            share = (attempt(validation, mean[None], VALIDATION_SEEDS, test_steps)[1] > 0).mean()
            if share > best_share:
                best, best_share = mean, share
                np.savez(file, weights=best)
            rate = found.mean() * 60 / (STEPS * PERIOD_S)
            print(f"start {start}, generation {generation}: gold per robot and minute {rate:.2f}, found in {share:.0%} of the rooms "
                  f"for validation, at best {best_share:.0%}, {time.process_time():.0f} s of processor time", flush=True)
        if is_over:
            break
    env.close()
    validation.close()
    return best


class Learned(robosim.Controller):
    """Drives one robot by a policy."""

    def __init__(self, weights):
        self.policy = Policy(weights[None])
        self.action = np.array([0, 1], np.float32)

    def step(self, robot):
        if robot.image is not None:
            self.action = self.policy.act(features(robot.image[None, None]), self.action[None, None, 1:])[0, 0]
        robot.drive(float(self.action[0]) * robot.speed_max_mps, float(self.action[1]) * robot.turn_max_radps)


def evaluate(weights, rooms):
    seeds = range(FIRST_TEST_SEED, FIRST_TEST_SEED + rooms)
    untrained = np.random.default_rng(1).normal(0, INITIAL_STD, Policy.size()).astype(np.float32)
    controllers = {"untrained": lambda: Learned(untrained), "gold_finder, with the heat only": "gold_finder", "learned": lambda: Learned(weights)}
    print(f"\n{rooms} other rooms, {TIME_LIMIT_S} s:\n\n| controller | found | median time to the gold [s] |\n|---|---|---|")
    for label, controller in controllers.items():
        times = np.sort([seconds_to_gold(room(seed), seed, controller, TIME_LIMIT_S) for seed in seeds])
        print(f"| {label} | {np.isfinite(times).mean():.0%} | {times[(len(times) - 1) // 2]:.1f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--starts", type=int, default=3, help="number of trainings from other random weights (default 3)")
    parser.add_argument("--minutes", type=float, default=15, help="time limit of training (default 15)")
    parser.add_argument("--threads", type=int, default=2, help="threads of the engine (default 2)")
    parser.add_argument("--policy", default="gold_pixels_policy.npz", help="file for the learned policy")
    parser.add_argument("--evaluate", metavar="FILE", help="only evaluate the policy of this file")
    parser.add_argument("--rooms", type=int, default=200, help="number of rooms for the comparison (default 200)")
    arguments = parser.parse_args()
    if arguments.evaluate:
        evaluate(np.load(arguments.evaluate)["weights"], arguments.rooms)
        return
    weights = train(arguments.starts, arguments.minutes, arguments.threads, arguments.policy)
    evaluate(weights, arguments.rooms)


if __name__ == "__main__":
    main()
