"""pursuit-v1: a team catches a robot that flees."""
import numpy as np

from .. import _robosim
from .arena import arena, robot, scatter
from .steering import wrap
from .task import Task

HALF_SIDE_M = 5
CAUGHT_M = 0.45
HUNTER_SPEED = 0.5  # of the evader's
EVADER = 3  # its index among the robots
SENSORS = ('<sonar range_min_m="0.15" range_max_m="3" no_echo_m="3" beam_width_deg="25"><ring count="16" radius_m="0.19" '
           'z_m="0.2"/></sonar><range_and_bearing count="3" range_max_m="8"><noise std_m="0.02" bearing_std_deg="2"/>'
           '</range_and_bearing><compass/>')


class Pursuit(Task):
    name = "pursuit-v1"
    help = "Three Scouts catch a fourth one, which flees twice as fast, in an arena of 10 m × 10 m with six pillars, within 60 s."
    agents = 3
    robots = 4
    observations = ("sonar", "values", "compass", "stalled")
    max_steps = 600
    metrics = {"caught": "share", "duration_s": "mean"}

    def __init__(self):
        self._gap_m = self._caught = None

    @classmethod
    def world(cls, seed):
        pillar = ('<primitive><cylinder><name>Pillar</name><z>0.5</z><radius>0.25</radius><height>1</height></cylinder>'
                  '</primitive>')
        team = scatter(3, robot("scout", "Hunter", SENSORS), xmin=-4.8, xmax=-2.5, gap=0.3)
        evader = scatter(1, robot("scout", "Evader", SENSORS), xmin=0, xmax=4.5, gap=0.3)
        text = arena(HALF_SIDE_M, HALF_SIDE_M, scatter(6, pillar, xmin=-2.5, xmax=4.5, gap=1) + team + evader)
        return _robosim.World.parse(text, name="pursuit", seed=seed)

    @classmethod
    def handwritten(cls):
        return Hunters()

    @classmethod
    def features(cls, observations):
        """The evader and both team-mates in fixed places, from the list of neighbours by distance."""
        sonar, values, compass, stalled = np.split(observations, [16, 25, 26], axis=-1)
        seen = [np.exp(-sonar)]
        agents = np.arange(cls.agents)
        for other in (np.full(3, EVADER), (agents + 1) % 3, (agents + 2) % 3):
            range_m, bearing_rad, is_seen = find(values, other)
            seen.append(np.stack([is_seen, is_seen * np.exp(-range_m / 3), is_seen * np.sin(bearing_rad),
                                  is_seen * np.cos(bearing_rad)], -1))
        return np.concatenate([*seen, np.sin(compass), np.cos(compass), stalled, np.ones_like(stalled)], axis=-1)

    def complete(self, actions, env):
        hunters = np.clip(actions, -1, 1) * np.array([HUNTER_SPEED, 1])
        return np.concatenate([hunters, flee(env._batch.all_poses)[:, None]], axis=1)

    @staticmethod
    def _gaps(env):
        """Distance of each hunter from the evader [m]."""
        places = env._batch.all_poses[..., :2]
        apart = places[:, :EVADER] - places[:, EVADER:]
        return np.sqrt((apart**2).sum(-1))

    def begin(self, env, which):
        gaps = self._gaps(env)
        self._gap_m = gaps if self._gap_m is None else np.where(which[:, None], gaps, self._gap_m)

    def step(self, env, rewards, terminated):
        """Decrease of the agent's distance from the evader [m] × 0.1, and 1 for all when it is caught."""
        gaps = self._gaps(env)
        self._caught = gaps.min(1) <= CAUGHT_M
        rewards = 0.1 * (self._gap_m - gaps) + self._caught[:, None]
        self._gap_m = gaps
        return rewards, self._caught

    def results(self, env):
        """duration_s: of an episode without success, its length."""
        return {"caught": self._caught, "duration_s": env._batch.steps * 0.1}


def find(values, robot_index):
    """Range [m], bearing [rad] and whether it is seen, of a robot of each agent in readings of <range_and_bearing>."""
    records = values.reshape(*values.shape[:-1], -1, 3)
    is_it = np.abs(records[..., 0] - np.asarray(robot_index)[:, None]) < 0.5
    return (is_it * records[..., 1]).sum(-1), (is_it * records[..., 2]).sum(-1), is_it.any(-1).astype(np.float32)


def flee(poses):
    """The evader's action: away from the hunters and from the walls, by true poses. In steps of
    1/64, so that rounding of other processors' functions has no effect."""
    own = poses[:, EVADER]
    away = own[:, None, :2] - poses[:, :EVADER, :2]
    squares = np.maximum((away**2).sum(-1, keepdims=True), 0.01)
    push = (away / squares).sum(1)
    for axis in (0, 1):
        push[:, axis] += 0.5 / np.maximum(own[:, axis] + HALF_SIDE_M - 0.3, 0.1) ** 2
        push[:, axis] -= 0.5 / np.maximum(HALF_SIDE_M - 0.3 - own[:, axis], 0.1) ** 2
    cos, sin = np.cos(own[:, 2]), np.sin(own[:, 2])
    length = np.maximum(np.sqrt((push**2).sum(-1)), 1e-6)
    ahead = (push[:, 0] * cos + push[:, 1] * sin) / length  # cosine and sine of the bearing of its course
    aside = (push[:, 1] * cos - push[:, 0] * sin) / length
    turn = np.where(ahead > 0, np.clip(2 * aside, -1, 1), np.where(aside >= 0, 1.0, -1.0))
    speed = np.maximum(ahead, 0)
    return np.round(np.stack([speed, turn], -1) * 64) / 64


class Hunters:
    """Each drives towards the evader, or a point beside it that its place in the team determines; without the evader in view
    it drives ahead, and turns away from what is near."""

    name = "handwritten"

    def __init__(self):
        self._last_rad = None

    def reset(self, num_envs):
        self._last_rad = np.zeros((num_envs, Pursuit.agents))

    def __call__(self, observations):
        sonar, values = observations[..., :16], observations[..., 16:25]
        range_m, bearing_rad, is_seen = find(values, np.full(3, EVADER))
        # The first goes straight, the others to both sides of the evader as long as it is far.
        beside = np.array([0, 0.6, -0.6]) * np.clip((range_m - 1) / 3, 0, 1)
        wanted = np.where(is_seen > 0, bearing_rad + beside, 0.3 * self._last_rad)
        self._last_rad = np.where(is_seen > 0, bearing_rad, self._last_rad)
        bearings = (np.arange(16) * np.pi / 8 + np.pi) % (2 * np.pi) - np.pi
        near = sonar < np.where(is_seen > 0, np.minimum(0.45, np.maximum(range_m - 0.6, 0)), 0.6)[..., None]
        # Away from the nearest echoes ahead.
        ahead = near & (np.abs(bearings) < 1.2)
        shift = -(ahead * np.sign(bearings + 1e-3) * (1.2 - np.abs(bearings))).sum(-1)
        wanted = wrap(wanted + np.clip(shift, -1.5, 1.5))
        return np.stack([np.clip(np.cos(wanted), 0, 1), np.clip(2 * wanted / 1.74, -1, 1)], -1)
