"""coverage-v1: a team covers as much of an unknown office as it can."""
import numpy as np

from .. import _robosim
from .task import Task
from .wall_following import SCOUT_SONARS_RAD, WallFollower

CELL_M = 0.5


class Coverage(Task):
    name = "coverage-v1"
    help = "Four Scouts visit as much as they can of an office of 14 m × 12 m that they do not know, in 120 s."
    agents = 4
    observations = ("sonar", "compass", "odometry", "stalled")
    max_steps = 1200
    metrics = {"covered_m2": "mean"}
    size_m = (14, 12)

    def __init__(self):
        self._visited = self._origin = None

    @classmethod
    def world(cls, seed):
        length, width = cls.size_m
        return _robosim.World.generate("office", seed=seed, width_m=width, length_m=length, robots=cls.agents, types=["scout"],
                                       gold=False)

    @classmethod
    def handwritten(cls):
        """Two robots follow the walls to their right, two those to their left."""
        return WallFollower(SCOUT_SONARS_RAD, radius_m=0.19, decel_mps2=2, turn_max_radps=1.74,
                            is_mirrored=(False, True, False, True))

    @classmethod
    def features(cls, observations):
        sonar, compass, odometry, stalled = np.split(observations, [16, 17, 22], axis=-1)
        agent = np.broadcast_to(np.where(np.arange(cls.agents) % 2 == 0, 1, -1)[:, None], stalled.shape)
        return np.concatenate([np.exp(-sonar), np.sin(compass), np.cos(compass), odometry[..., :2] / 10, odometry[..., 3:],
                               stalled, agent, np.ones_like(stalled)], axis=-1)

    def _cells(self, env):
        """Index of the cell of each robot: shape (num_envs, agents)."""
        rows = 2 * int(max(self.size_m) / CELL_M) + 2  # the world's origin may be a corner or the centre
        cells = np.floor(env._batch.all_poses[..., :2] / CELL_M).astype(int) + rows // 2
        cells = np.clip(cells, 0, rows - 1)
        return cells[..., 0] * rows + cells[..., 1], rows * rows

    def begin(self, env, which):
        cells, count = self._cells(env)
        if self._visited is None:
            self._visited = np.zeros((env.num_envs, count), bool)
        begun = np.flatnonzero(which)
        self._visited[begun] = False
        self._visited[begun[:, None], cells[begun]] = True

    def step(self, env, rewards, terminated):
        """Each agent gets the area [m²] of the cell that it is the first to visit; of several, the first in their order."""
        cells, _ = self._cells(env)
        rewards = np.zeros((env.num_envs, self.agents))
        rows = np.arange(env.num_envs)
        for agent in range(self.agents):
            rewards[:, agent] = ~self._visited[rows, cells[:, agent]] * CELL_M**2
            self._visited[rows, cells[:, agent]] = True
        return rewards, np.zeros(env.num_envs, bool)

    def results(self, env):
        return {"covered_m2": self._visited.sum(1) * CELL_M**2}
