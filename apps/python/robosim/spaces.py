"""Spaces of actions and observations, with the interface of gymnasium.spaces."""
import numpy as np


class Box:
    """Arrays of one shape whose elements lie between bounds, which may be infinite.

    low, high: numbers, or arrays of this shape.
    """

    def __init__(self, low, high, shape=None, dtype=np.float32, seed=None):
        self.dtype = np.dtype(dtype)
        if shape is None:
            shape = np.broadcast(low, high).shape
        self._shape = tuple(int(size) for size in shape)
        self.low = np.broadcast_to(np.asarray(low, self.dtype), self._shape).copy()
        self.high = np.broadcast_to(np.asarray(high, self.dtype), self._shape).copy()
        if not np.all(self.low <= self.high):
            raise ValueError("each low bound must be at most the high bound")
        self._np_random = None
        if seed is not None:
            self.seed(seed)

    @property
    def shape(self):
        return self._shape

    @property
    def np_random(self):
        """Generator of sample()."""
        if self._np_random is None:
            self.seed()
        return self._np_random

    def seed(self, seed=None):
        """Seeds sample(), at random without a seed. Returns the seed."""
        sequence = np.random.SeedSequence(seed)
        self._np_random = np.random.Generator(np.random.PCG64(sequence))
        return sequence.entropy

    @property
    def is_np_flattenable(self):
        return True

    def is_bounded(self, manner="both"):
        below, above = np.all(np.isfinite(self.low)), np.all(np.isfinite(self.high))
        return bool({"both": below and above, "below": below, "above": above}[manner])

    def sample(self, mask=None):
        """A random element: uniform between bounds, exponential beyond one bound, normal without bounds."""
        if mask is not None:
            raise ValueError("a Box has no masks")
        low, high = self.low.astype(np.float64), self.high.astype(np.float64)
        below, above = np.isfinite(low), np.isfinite(high)
        random = self.np_random
        drawn = random.normal(size=self._shape)
        drawn = np.where(below & ~above, np.where(below, low, 0) + random.exponential(size=self._shape), drawn)
        drawn = np.where(~below & above, np.where(above, high, 0) - random.exponential(size=self._shape), drawn)
        both = below & above
        uniform = random.uniform(np.where(both, low, 0), np.where(both, high, 1), size=self._shape)
        return np.clip(np.where(both, uniform, drawn).astype(self.dtype), self.low, self.high)

    def contains(self, x):
        if not isinstance(x, np.ndarray):
            try:
                x = np.asarray(x, self.dtype)
            except (ValueError, TypeError):
                return False
        return bool(np.can_cast(x.dtype, self.dtype) and x.shape == self._shape
                    and np.all(x >= self.low) and np.all(x <= self.high))

    __contains__ = contains

    def __eq__(self, other):
        return (isinstance(other, Box) and self._shape == other._shape and self.dtype == other.dtype
                and np.array_equal(self.low, other.low) and np.array_equal(self.high, other.high))

    def __repr__(self):
        low, high = (self.low.min(), self.high.max()) if self.low.size else (0, 0)
        return f"Box({low}, {high}, {self._shape}, {self.dtype})"


class Dict:
    """Dicts of elements of several spaces, by name."""

    def __init__(self, spaces):
        self.spaces = dict(spaces)

    @property
    def shape(self):
        return None

    def __getitem__(self, name):
        return self.spaces[name]

    def __iter__(self):
        return iter(self.spaces)

    def __len__(self):
        return len(self.spaces)

    def keys(self):
        return self.spaces.keys()

    def values(self):
        return self.spaces.values()

    def items(self):
        return self.spaces.items()

    def seed(self, seed=None):
        """Seeds sample() of each space, at random without a seed. Returns the seeds by name."""
        return {name: space.seed(seed) for name, space in self.spaces.items()}

    def sample(self, mask=None):
        """A random element."""
        if mask is not None:
            raise ValueError("a Dict has no masks")
        return {name: space.sample() for name, space in self.spaces.items()}

    def contains(self, x):
        return isinstance(x, dict) and x.keys() == self.spaces.keys() and all(x[name] in self.spaces[name] for name in x)

    __contains__ = contains

    def __eq__(self, other):
        return isinstance(other, Dict) and self.spaces == other.spaces

    def __repr__(self):
        return f"Dict({self.spaces})"
