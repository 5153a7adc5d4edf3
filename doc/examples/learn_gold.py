#!/usr/bin/env python3
"""Learns to find gold in mazes that it has not seen, and compares the result with RoboSim's own controllers.

    learn_gold.py [--minutes 10] [--threads 2] [--policy FILE.npz] [--mazes 100]

The policy is a small recurrent network: 16 sonar ranges, the heat, and whether the robot stalls, to speed and turn rate. It
learns by an evolution strategy (Salimans et al., "Evolution Strategies as a Scalable Alternative to Reinforcement Learning",
2017): in each generation, pairs of opposite random changes of the weights are tried in the same mazes from the same starts,
and the weights move towards those that found more gold. All candidates run in one robosim.VectorEnv, each in 32 mazes.
Requires NumPy."""
import argparse
import time

import numpy as np

import robosim

MAZE = dict(columns=6, rows=6, robots=1, types=["pioneer3dx"])
TRAINING_SEEDS = range(1, 33)
FIRST_TEST_SEED = 100_001  # of mazes that training never uses
OBSERVATIONS = ("sonar", "heat", "stalled")
HIDDEN = 12
PAIRS = 16
STEPS = 400  # of each candidate in each maze, 40 s of simulated time
SIGMA = 0.1
RATE = 0.2
TIME_LIMIT_S = 600  # of a test
WIN_DISTANCE_M = 0.5  # between robot and gold; the default of world files


def features(observations):
    """Numbers of similar size: near obstacles are near 1, far ones near 0."""
    sonar, heat, stalled = np.split(observations, [-2, -1], axis=-1)
    ones = np.ones_like(heat)
    return np.concatenate([np.exp(-sonar), np.log1p(np.maximum(heat, 0)) / 3, stalled, ones], axis=-1)


class Policy:
    """The weights of many networks of one shape: weights of shape (networks, size)."""

    def __init__(self, weights, inputs):
        first = (inputs + HIDDEN) * HIDDEN
        self.into_hidden = weights[:, :first].reshape(-1, inputs + HIDDEN, HIDDEN)
        self.into_action = weights[:, first:].reshape(-1, HIDDEN, 2)

    @staticmethod
    def size(inputs):
        return (inputs + HIDDEN) * HIDDEN + HIDDEN * 2

    def act(self, observations, hidden):
        """Actions and the next hidden state; all of shape (networks, mazes, …)."""
        hidden = np.tanh(np.concatenate([features(observations), hidden], axis=-1) @ self.into_hidden)
        return np.tanh(hidden @ self.into_action), hidden


def train(minutes, threads):
    rng = np.random.default_rng(1)
    mazes = [robosim.World.generate("maze", seed=seed, **MAZE) for seed in TRAINING_SEEDS]
    candidates = 2 * PAIRS
    env = robosim.VectorEnv(mazes, num_envs=candidates * len(mazes), observations=OBSERVATIONS, threads=threads,
                            reward={"win": 1, "heat": 0.02, "forward": 0.01, "stall": -0.002}, max_steps=STEPS)
    inputs = env.single_observation_space.shape[0] + 1
    mean = rng.normal(0, 0.1, Policy.size(inputs)).astype(np.float32)
    momentum = np.zeros_like(mean)
    shape = (candidates, len(mazes))
    end = time.monotonic() + 60 * minutes
    generation, steps = 0, 0
    while time.monotonic() < end:
        half = rng.normal(0, 1, (PAIRS, mean.size)).astype(np.float32)
        changes = np.concatenate([half, -half])
        policy = Policy(mean + SIGMA * changes, inputs)
        starts = rng.integers(2**31, size=len(mazes))  # the same for all candidates
        observations, _ = env.reset(seed=[int(seed) for seed in np.tile(starts, candidates)])
        hidden = np.zeros((*shape, HIDDEN), np.float32)
        returns = np.zeros(shape)
        found = 0
        for _ in range(STEPS):
            actions, hidden = policy.act(observations.reshape(*shape, -1), hidden)
            observations, rewards, terminated, truncated, _ = env.step(actions.reshape(-1, 2))
            returns += rewards.reshape(shape)
            found += terminated.sum()
            hidden[(terminated | truncated).reshape(shape)] = 0
        steps += STEPS * env.num_envs
        fitness = returns.mean(axis=1)
        ranks = fitness.argsort().argsort() / (candidates - 1) - 0.5  # robust against outliers
        momentum = 0.9 * momentum + 0.1 * (ranks @ changes) / (candidates * SIGMA)
        mean += RATE * momentum
        generation += 1
        if generation % 10 == 0:
            print(f"generation {generation}: gold per robot and minute {found / env.num_envs:.2f}, "
                  f"mean return {fitness.mean():.3f}, {steps:,} steps", flush=True)
    env.close()
    return mean, inputs


class Learned(robosim.Controller):
    """Drives one robot by a policy."""

    def __init__(self, weights, inputs):
        self.policy = Policy(weights[None], inputs)
        self.hidden = np.zeros((1, 1, HIDDEN), np.float32)

    def step(self, robot):
        observation = np.concatenate([robot.sonar, [robot.heat, float(robot.stalled)]]).astype(np.float32)
        actions, self.hidden = self.policy.act(observation[None, None], self.hidden)
        speed, turn = actions[0, 0]
        robot.drive(float(speed) * robot.speed_max_mps, float(turn) * robot.turn_max_radps)


def seconds_to_gold(world, seed, controller, limit_s):
    """Simulated time until the robot's edge is as near to the gold's as winning requires; infinite after the time limit.
    `controller` is the name of one, or a function that makes one."""
    gold = next(one for one in world.objects if one.heat_celsius > 0)
    robot = world.robots[0]
    reach_m = WIN_DISTANCE_M + gold.size_m[0] / 2 + robot.radius_m
    chosen = dict(controller=controller) if isinstance(controller, str) else dict(controllers={robot.name: controller()})
    with robosim.Simulation(world, seed=seed, **chosen) as simulation:
        while simulation.time_s < limit_s:
            simulation.step()
            if np.hypot(*(simulation.poses[0, :2] - gold.pose[:2])) <= reach_m:
                return simulation.time_s
    return np.inf


def evaluate(weights, inputs, mazes):
    seeds = range(FIRST_TEST_SEED, FIRST_TEST_SEED + mazes)
    controllers = {"wander": "wander", "wall_follower": "wall_follower", "gold_finder": "gold_finder",
                   "learned": lambda: Learned(weights, inputs)}
    print(f"\n{mazes} other mazes, one robot, {TIME_LIMIT_S} s:\n\n"
          "| controller | found | median time to the gold [s] | 90 % [s] |\n|---|---|---|---|")
    for label, controller in controllers.items():
        times = np.sort([seconds_to_gold(robosim.World.generate("maze", seed=seed, **MAZE), seed, controller, TIME_LIMIT_S)
                         for seed in seeds])
        median, most = (f"{times[int(np.ceil(share * len(times))) - 1]:.1f}" for share in (0.5, 0.9))
        print(f"| {label} | {np.isfinite(times).mean():.0%} | {median} | {most} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--minutes", type=float, default=10, help="time for training (default 10)")
    parser.add_argument("--threads", type=int, default=2, help="threads of the engine (default 2)")
    parser.add_argument("--policy", default="gold_policy.npz", help="file for the learned policy")
    parser.add_argument("--evaluate", metavar="FILE", help="only evaluate the policy of this file")
    parser.add_argument("--mazes", type=int, default=100, help="number of mazes for the comparison (default 100)")
    arguments = parser.parse_args()
    if arguments.evaluate:
        stored = np.load(arguments.evaluate)
        evaluate(stored["weights"], int(stored["inputs"]), arguments.mazes)
        return
    weights, inputs = train(arguments.minutes, arguments.threads)
    np.savez(arguments.policy, weights=weights, inputs=inputs)
    evaluate(weights, inputs, arguments.mazes)


if __name__ == "__main__":
    main()
