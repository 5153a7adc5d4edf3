"""formation-v1: a team forms a square by ranges and bearings."""
import numpy as np

from .. import _robosim
from .arena import arena, robot, scatter
from .pursuit import find
from .steering import wrap
from .task import Task

HALF_SIDE_M = 4
# Places of the robots about the centre of the square [m].
PLACES_M = np.array([(-0.75, -0.75), (0.75, -0.75), (0.75, 0.75), (-0.75, 0.75)])
FORMED_M = 0.15
LAST_STEPS = 100
SENSORS = ('<sonar range_min_m="0.15" range_max_m="3" no_echo_m="3" beam_width_deg="25"><ring count="16" radius_m="0.19" '
           'z_m="0.2"/></sonar><range_and_bearing count="3" range_max_m="12"><noise std_m="0.02" bearing_std_deg="2"/>'
           '</range_and_bearing><compass/>')


class Formation(Task):
    name = "formation-v1"
    help = "Four Scouts form a square with sides of 1.5 m to the north and east, anywhere in an arena of 8 m × 8 m."
    agents = 4
    observations = ("sonar", "values", "compass", "stalled")
    max_steps = 400
    metrics = {"formed": "share", "error_m": "mean"}

    def __init__(self):
        self._before_m = self._sum_m = self._greatest_m = None

    @classmethod
    def world(cls, seed):
        text = arena(HALF_SIDE_M, HALF_SIDE_M, scatter(cls.agents, robot("scout", "Robot", SENSORS), gap=0.4))
        return _robosim.World.parse(text, name="formation", seed=seed)

    @classmethod
    def handwritten(cls):
        return Consensus()

    @classmethod
    def features(cls, observations):
        """For each of the three team-mates in cyclic order: where it is beyond its place, seen from the robot [m]."""
        sonar, values, compass, stalled = np.split(observations, [16, 25, 26], axis=-1)
        offsets = place_errors(values, compass[..., 0])
        return np.concatenate([np.exp(-2 * sonar), offsets.reshape(*offsets.shape[:-2], -1), stalled, np.ones_like(stalled)],
                              axis=-1)

    @staticmethod
    def _errors(env):
        """Distance of each robot from its place in the square about the robots' centre [m]."""
        places = env._batch.all_poses[..., :2]
        apart = places - places.mean(axis=1, keepdims=True) - PLACES_M
        return np.sqrt((apart**2).sum(-1))

    def begin(self, env, which):
        errors = self._errors(env)
        self._before_m = errors if self._before_m is None else np.where(which[:, None], errors, self._before_m)
        if self._sum_m is None:
            self._sum_m, self._greatest_m = np.zeros(env.num_envs), np.zeros(env.num_envs)
        self._sum_m[which] = self._greatest_m[which] = 0

    def step(self, env, rewards, terminated):
        """Decrease of the agent's distance from its place [m], minus 0.01 × that distance."""
        errors = self._errors(env)
        rewards = self._before_m - errors - 0.01 * errors
        self._before_m = errors
        is_last = env._batch.steps > self.max_steps - LAST_STEPS
        self._sum_m += np.where(is_last, errors.mean(1), 0)
        self._greatest_m = np.where(is_last, np.maximum(self._greatest_m, errors.max(1)), self._greatest_m)
        return rewards, np.zeros(env.num_envs, bool)

    def results(self, env):
        """Of the last 10 s: whether no robot was farther than 0.15 m from its place; mean distance from it [m]."""
        return {"formed": self._greatest_m <= FORMED_M, "error_m": self._sum_m / LAST_STEPS}


def place_errors(values, compass_rad):
    """Vector to each team-mate in cyclic order minus the one in the square [m], robot frame: shape (…, agents, 3, 2); 0 for
    one that is not seen."""
    agents = np.arange(Formation.agents)
    cos, sin = np.cos(compass_rad), np.sin(compass_rad)
    offsets = []
    for step in (1, 2, 3):
        other = (agents + step) % Formation.agents
        range_m, bearing_rad, is_seen = find(values, other)
        wanted = PLACES_M[other] - PLACES_M
        ahead = range_m * np.cos(bearing_rad) - (wanted[:, 0] * cos + wanted[:, 1] * sin)
        aside = range_m * np.sin(bearing_rad) - (wanted[:, 1] * cos - wanted[:, 0] * sin)
        offsets.append(np.stack([ahead, aside], -1) * is_seen[..., None])
    return np.stack(offsets, -2)


class Consensus:
    """Each robot drives along the mean of the vectors by which its team-mates are beyond their places (Ren and Beard,
    Distributed Consensus in Multi-vehicle Cooperative Control, 2008), and round what is near."""

    name = "handwritten"

    def __call__(self, observations):
        sonar, values, compass = observations[..., :16], observations[..., 16:25], observations[..., 25]
        way = place_errors(values.astype(np.float64), compass.astype(np.float64)).sum(-2) / Formation.agents
        distance = np.hypot(way[..., 0], way[..., 1])
        bearing = np.arctan2(way[..., 1], way[..., 0])
        bearings = (np.arange(16) * np.pi / 8 + np.pi) % (2 * np.pi) - np.pi
        ahead = (sonar < 0.35) & (np.abs(wrap(bearings - bearing[..., None])) < 0.8)
        bearing = wrap(bearing + np.where(ahead.any(-1), 1.0, 0.0))  # all pass each other on the same side
        # In reverse where that is the shorter turn.
        is_back = np.abs(bearing) > np.pi / 2
        turn = np.where(is_back, wrap(bearing + np.pi), bearing)
        speed = np.clip(1.5 * distance, 0, 0.7) * np.maximum(np.cos(turn), 0) ** 3 * np.where(is_back, -1, 1)
        is_there = distance < 0.03
        return np.stack([np.where(is_there, 0, speed), np.where(is_there, 0, np.clip(2 * turn / 1.74, -1, 1))], -1)
