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
               threads, seed, others):
    if isinstance(observations, str):
        observations = [observations]
    for name, value, least, most in (("num_envs", num_envs, 1, 2**31 - 1), ("robots", robots, 0, 2**31 - 1),
                                     ("max_steps", max_steps, 1, 2**32 - 1), ("threads", threads, 1, 1024),
                                     ("the seed", seed, 0, SEED_MAX)):
        require_whole(name, value, least, most)
    if others not in ("controllers", "still"):
        raise ValueError(f"others is {others!r}; it must be 'controllers' or 'still'")
    return _robosim._Batch(_worlds_of(worlds), num_envs, robots, list(observations), dict(reward or {}), period_s,
                           max_steps, random_starts, start_distance_m, threads, seed, others == "controllers")


def spaces_of(batch, agent=None):
    """Spaces of the observation and the action of an agent, of its own size; None: of all agents together."""
    if agent is None:
        low, high = batch.low, batch.high
    else:
        size = size_of(batch, agent)
        low, high = batch.low[agent, :size], batch.high[agent, :size]
    return Box(low, high, low.shape, np.float32), Box(-1, 1, (*low.shape[:-1], 2), np.float32)


def size_of(batch, agent):
    """Size of an agent's own observation."""
    return max((end for _, _, end in batch.parts[agent]), default=0)


def parts_of(batch, agent):
    """Slice of an agent's observation by the name of its part."""
    return {name: slice(begin, end) for name, begin, end in batch.parts[agent]}


def end_reason(terminated, truncated):
    """How an episode has ended: "win", "max_steps"; None: it has not."""
    return "win" if terminated else "max_steps" if truncated else None


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
