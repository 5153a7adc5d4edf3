"""What the learning environments have in common."""
import os

import numpy as np

from . import _robosim
from .spaces import Box


def _worlds_of(worlds):
    if isinstance(worlds, _robosim.WorldGenerator):
        return worlds
    if isinstance(worlds, (_robosim.World, str, os.PathLike)):
        worlds = [worlds]
    return [world if isinstance(world, _robosim.World) else _robosim.World.load(world) for world in worlds]


def make_batch(worlds, num_envs, robots, observations, reward, period_s, max_steps, random_starts, threads, seed):
    if isinstance(observations, str):
        observations = [observations]
    for name, value, least in (("num_envs", num_envs, 1), ("robots", robots, 0), ("max_steps", max_steps, 1),
                               ("threads", threads, 1), ("seed", seed, 0)):
        if isinstance(value, bool) or not isinstance(value, (int, np.integer)):
            raise TypeError(f"{name} must be a whole number, not {type(value).__name__}")
        if value < least:
            raise ValueError(f"{name} is {value}; it must be at least {least}")
    return _robosim._Batch(_worlds_of(worlds), num_envs, robots, list(observations), dict(reward or {}), period_s,
                           max_steps, random_starts, threads, seed)


def spaces_of(batch, agents):
    """Spaces of the observation and the action; agents: () of one agent, (n,) of a team."""
    shape = (*agents, batch.size)
    observation = Box(np.broadcast_to(batch.low, shape), np.broadcast_to(batch.high, shape), shape)
    return observation, Box(-1, 1, (*agents, 2))


class Results:
    """Arrays of the results of one step."""

    def __init__(self, batch, num_envs):
        self.observations = np.zeros((num_envs, batch.agents, batch.size), np.float32)
        self.rewards = np.zeros((num_envs, batch.agents))
        self.terminated = np.zeros(num_envs, bool)
        self.truncated = np.zeros(num_envs, bool)
