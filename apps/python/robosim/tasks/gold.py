"""gold-v1: one robot finds the gold in a maze that it does not know."""
import numpy as np

from .. import _robosim
from .task import Task
from .wall_following import SCOUT_SONARS_RAD, WallFollower


class Gold(Task):
    name = "gold-v1"
    help = "A Scout finds the gold in a maze of 6 × 6 cells that it does not know, within 200 s."
    observations = ("sonar", "heat", "stalled")
    max_steps = 2000
    metrics = {"found": "share", "duration_s": "mean"}
    options = {"reward": {"win": 1, "heat": 0.02, "forward": 0.01, "stall": -0.002}}

    def __init__(self):
        self._found = None

    @classmethod
    def world(cls, seed):
        return _robosim.World.generate("maze", seed=seed, columns=6, rows=6, robots=1, types=["scout"])

    @classmethod
    def handwritten(cls):
        return WallFollower(SCOUT_SONARS_RAD, radius_m=0.19, decel_mps2=2, turn_max_radps=1.74)

    @classmethod
    def features(cls, observations):
        sonar, heat, stalled = np.split(observations, [16, 17], axis=-1)
        return np.concatenate([np.exp(-sonar), np.log1p(np.maximum(heat, 0)) / 3, stalled, np.ones_like(heat)], axis=-1)

    def step(self, env, rewards, terminated):
        self._found = terminated.copy()
        return rewards, terminated

    def results(self, env):
        """duration_s: of an episode without success, its length."""
        return {"found": self._found, "duration_s": env._batch.steps * 0.1}
