"""What the learning environments have in common."""
import os

import numpy as np

from . import _robosim
from ._farama import Box


SEED_MAX = 2**64 - 1


def _worlds_of(worlds):
    if isinstance(worlds, _robosim.WorldGenerator):
        return worlds
    if isinstance(worlds, (_robosim.World, str, os.PathLike)):
        worlds = [worlds]
    return [world if isinstance(world, _robosim.World) else _robosim.World.load(world) for world in worlds]


def make_batch(worlds, num_envs, robots, observations, reward, period_s, max_steps, random_starts, start_distance_m,
               threads, seed):
    if isinstance(observations, str):
        observations = [observations]
    for name, value, least, most in (("num_envs", num_envs, 1, 2**31 - 1), ("robots", robots, 0, 2**31 - 1),
                                     ("max_steps", max_steps, 1, 2**32 - 1), ("threads", threads, 1, 1024),
                                     ("the seed", seed, 0, SEED_MAX)):
        require_whole(name, value, least, most)
    return _robosim._Batch(_worlds_of(worlds), num_envs, robots, list(observations), dict(reward or {}), period_s,
                           max_steps, random_starts, start_distance_m, threads, seed)


def spaces_of(batch, agents):
    """Spaces of the observation and the action; agents: () of one agent, (n,) of a team."""
    shape = (*agents, batch.size)
    observation = Box(np.broadcast_to(batch.low, shape), np.broadcast_to(batch.high, shape), shape, np.float32)
    return observation, Box(-1, 1, (*agents, 2), np.float32)


def batched(space, count):
    """The space of `count` elements of a space."""
    shape = (count, *space.shape)
    return Box(np.broadcast_to(space.low, shape), np.broadcast_to(space.high, shape), shape, space.dtype)


def require_whole(name, value, least, most):
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)):
        raise TypeError(f"{name} must be a whole number, not {type(value).__name__}")
    if not least <= value <= most:
        raise ValueError(f"{name} is {value}; it must be {least} to {'2^64 - 1' if most == SEED_MAX else most}")


class Results:
    """Arrays of the results of one step."""

    def __init__(self, batch, num_envs):
        self.observations = np.zeros((num_envs, batch.agents, batch.size), np.float32)
        self.rewards = np.zeros((num_envs, batch.agents))
        self.terminated = np.zeros(num_envs, bool)
        self.truncated = np.zeros(num_envs, bool)
