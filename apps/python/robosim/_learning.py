"""What the learning environments have in common."""
import copy
import os

import numpy as np

from . import _robosim
from ._arguments import SEED_MAX, refuse, require_number, require_whole
from ._farama import Box, Dict


def worlds_of(worlds, name="worlds"):
    """A WorldGenerator, or a list of World."""
    if isinstance(worlds, _robosim.WorldGenerator):
        return worlds
    if isinstance(worlds, (_robosim.World, str, os.PathLike)):
        worlds = [worlds]
    what = "a World, a file, a list of them, or a WorldGenerator"
    if not np.iterable(worlds):
        refuse(name, worlds, what, '"small_maze"')
    worlds = list(worlds)
    if not worlds:
        raise ValueError(f"{name} is an empty list; it must be {what}, for example \"small_maze\"")
    for world in worlds:
        if not isinstance(world, (_robosim.World, str, os.PathLike)):
            refuse(f"an element of {name}", world, "a World or a file", '"small_maze"')
    return [world if isinstance(world, _robosim.World) else _robosim.World.load(world) for world in worlds]


def _names_of(observations):
    what, example = "a list of kinds or labels of sensors, \"stalled\", \"pose\"", '("sonar", "heat")'
    if isinstance(observations, str):
        observations = [observations]
    if not np.iterable(observations):
        refuse("observations", observations, what, example)
    names = list(observations)
    for name in names:
        if not isinstance(name, str):
            refuse("an element of observations", name, "a str", example)
    if not names:
        raise ValueError(f"observations is empty; it must be {what}, for example {example}")
    return names


def make_batch(worlds, num_envs, robots, observations, reward, period_s, max_steps, random_starts, start_distance_m,
               threads, seed, others):
    for name, value, least, most, example in (("num_envs", num_envs, 1, 2**31 - 1, 8), ("robots", robots, 0, 2**31 - 1, 1),
                                              ("max_steps", max_steps, 1, 2**32 - 1, 1000), ("threads", threads, 1, 1024, 2),
                                              ("the seed", seed, 0, SEED_MAX, 1)):
        require_whole(name, value, least, most, example)
    require_number("period_s", period_s, "a number of seconds in (0, 1]", 0.1)
    if start_distance_m is not None:
        require_number("start_distance_m", start_distance_m, "a number of metres, at least 0, or None", 1.5)
    if not isinstance(random_starts, (bool, np.bool_)):
        refuse("random_starts", random_starts, "True or False", "random_starts=True")
    if others not in ("controllers", "still"):
        raise ValueError(f"others is {others!r}; it must be 'controllers' or 'still'")
    if reward is not None and not hasattr(reward, "keys"):
        refuse("reward", reward, "a dict of weights of win, forward, heat, stall and step", '{"win": 1}')
    return _robosim._Batch(worlds_of(worlds), num_envs, robots, _names_of(observations), dict(reward or {}), period_s,
                           max_steps, bool(random_starts), start_distance_m, threads, seed, others == "controllers")


def numbers_of(actions, name, shape):
    """An array of numbers of a shape."""
    example = f"np.zeros({shape})"
    try:
        array = np.asarray(actions)
    except ValueError:
        refuse(name, actions, f"an array of numbers of shape {shape}", example)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name} must be an array of numbers of shape {shape}, not of {array.dtype}; for example {example}")
    if array.shape != shape:
        raise ValueError(f"{name} have the shape {array.shape}; it must be {shape}, for example {example}")
    return array


class Copyable:
    """Pickles and deep copies of an environment, which continue bit for bit: they keep the worlds (the texts of their
    files), all arguments, the state of each environment and its seed and number of the episode, interventions, the
    results of the last two steps, and the random numbers of spaces. Controllers of other robots are copied by
    copy.deepcopy() only.

    An environment has _batch (None after close()) and _made_of, the arguments of make_batch().
    """

    def __getstate__(self):
        state = self.__dict__.copy()
        batch = state.pop("_batch")
        state["_saved"] = None if batch is None else batch.save()
        return state

    def __setstate__(self, state):
        state = dict(state)
        saved = state.pop("_saved")
        self.__dict__.update(state)
        self._batch = None
        if saved is not None:
            self._batch = make_batch(*self._made_of)
            self._batch.restore(saved)

    def __deepcopy__(self, memo):
        other = memo[id(self)] = type(self).__new__(type(self))
        other.__dict__.update((name, copy.deepcopy(value, memo)) for name, value in self.__dict__.items()
                              if name != "_batch")
        other._batch = None
        if self._batch is not None:
            other._batch = make_batch(*self._made_of)
            other._batch.restore(self._batch.save(with_others=True), self._batch)
        return other


def spaces_of(batch, agent=None):
    """Spaces of the observation and the action of an agent, of its own size; None: of all agents together."""
    if agent is None:
        low, high = batch.low, batch.high
    else:
        size = size_of(batch, agent)
        low, high = batch.low[agent, :size], batch.high[agent, :size]
    numbers = Box(low, high, low.shape, np.float32)
    action = Box(-1, 1, (*low.shape[:-1], batch.action_size), np.float32)
    if not batch.pictures:
        return numbers, action
    _require_one_picture_by_name(batch)
    spaces = {}
    for name, height, width, layers, range_max_m in batch.pictures:
        if agent is not None and name not in parts_of(batch, agent):
            continue
        for layer, suffix, dtype, high, depth in _LAYERS:
            if layer in layers:
                shape = (*low.shape[:-1], height, width, *depth)
                spaces[name + suffix] = Box(0, range_max_m if high is None else high, shape, dtype)
    if low.shape[-1] > 0:
        spaces["numbers"] = numbers
    return Dict(spaces), action


def _require_one_picture_by_name(batch):
    """Raises ValueError when labels of cameras lead to an observation with two parts of one name."""
    taken = {"numbers"} if batch.size > 0 else set()
    for label, _, _, layers, _ in batch.pictures:
        for layer, suffix, *_ in _LAYERS:
            if layer not in layers:
                continue
            if label + suffix in taken:
                raise ValueError(f"two parts of observations have the name {label + suffix!r}; give the camera "
                                 f"{label!r} another label in its robot type, for example label=\"front\"")
            taken.add(label + suffix)


# Layers of pictures: their name, the end of the observation's name, type, largest value (None: the range), last dimension.
_LAYERS = (("rgb", "", np.uint8, 255, (3,)), ("depth", "_depth", np.float32, None, ()),
           ("identity", "_identity", np.uint32, 2**32 - 1, ()))


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
    if isinstance(space, Dict):
        return Dict({name: batched(one, count) for name, one in space.items()})
    shape = (count, *space.shape)
    return Box(np.broadcast_to(space.low, shape), np.broadcast_to(space.high, shape), shape, space.dtype)


class Results:
    """Arrays of the results of one step."""

    def __init__(self, batch, num_envs):
        self.observations = np.zeros((num_envs, batch.agents, batch.size), np.float32)
        self.rewards = np.zeros((num_envs, batch.agents))
        self.terminated = np.zeros(num_envs, bool)
        self.truncated = np.zeros(num_envs, bool)
        self.pictures = []  # by picture: its arrays by layer
        for _, height, width, layers, _ in batch.pictures:
            shape = (num_envs, batch.agents, height, width)
            self.pictures.append({layer: np.zeros((*shape, *depth), dtype)
                                  for layer, _, dtype, _, depth in _LAYERS if layer in layers})

    def take_pictures(self, batch):
        """Writes those of the last step or reset."""
        for index, arrays in enumerate(self.pictures):
            batch.write_pictures(index, *(arrays.get(layer) for layer, *_ in _LAYERS))

    def observed(self, batch, select):
        """The observation, of which select() takes a part of each array: an array, or with pictures a dict of arrays."""
        numbers = select(self.observations)
        if not self.pictures:
            return numbers
        observed = {}
        for (name, *_), arrays in zip(batch.pictures, self.pictures):
            observed.update((name + suffix, select(arrays[layer])) for layer, suffix, *_ in _LAYERS if layer in arrays)
        if batch.size > 0:
            observed["numbers"] = numbers
        return observed
