"""A wall follower by sonars, as hand-written policy for unknown rooms."""
import numpy as np

SCOUT_SONARS_RAD = (np.arange(16) * np.pi / 8 + np.pi) % (2 * np.pi) - np.pi


class WallFollower:
    """Follows the wall to its right (or left) at a distance of its radius and a half, and turns away on contact.

    sonars_rad: bearings of the 16 sonars, which are the first numbers of an observation; the last one is "stalled".
    is_mirrored: by agent, whether it follows the wall to its left.
    """

    name = "handwritten"

    def __init__(self, sonars_rad, radius_m, decel_mps2, turn_max_radps, is_mirrored=(False,)):
        self._sonars_rad = np.asarray(sonars_rad)
        self._radius_m, self._decel_mps2, self._turn_max_radps = radius_m, decel_mps2, turn_max_radps
        self._is_mirrored = np.asarray(is_mirrored)
        self._has_wall = self._turns = None

    def reset(self, num_envs):
        shape = (num_envs, len(self._is_mirrored))
        self._has_wall, self._turns = np.zeros(shape, bool), np.zeros(shape, int)

    def __call__(self, observations):
        team = observations.reshape(*self._has_wall.shape, -1)
        actions = self._act(team[..., :16].astype(np.float64), team[..., -1] > 0)
        return actions if observations.ndim == 3 else actions[:, 0]

    def _act(self, ranges, stalled):
        side = np.where(self._is_mirrored, -1.0, 1.0)
        bearings = side[:, None] * self._sonars_rad  # a mirrored robot sees the mirrored room
        distance_m = 1.5 * self._radius_m
        cone = np.radians(1)
        ahead = np.where(np.abs(bearings) <= np.radians(35) + cone, ranges, np.inf).min(-1)
        to_the_right = np.where((bearings <= np.radians(-20)) & (bearings >= np.radians(-150) - cone), ranges, np.inf)
        right, nearest = to_the_right.min(-1), to_the_right.argmin(-1)
        right_bearing = np.take_along_axis(np.broadcast_to(bearings, ranges.shape), nearest[..., None], -1)[..., 0]
        cruise = np.minimum(0.6, np.sqrt(2 * self._decel_mps2 * np.maximum(0, ahead - 0.8 * distance_m)))
        self._turns = np.where(stalled, 10, np.maximum(self._turns - 1, 0))
        is_turning = (ahead < distance_m) | (self._turns > 0)
        is_lost = ~is_turning & (right > 3 * distance_m)
        # Round the corner at which the wall has ended.
        corner = np.where(self._has_wall, -cruise / (distance_m + self._radius_m), 0) / self._turn_max_radps
        along = right_bearing + np.pi / 2
        follow = np.clip(1.5 * along + 0.8 * np.clip((distance_m - right) / distance_m, -1, 1), -0.8, 0.8)
        self._has_wall = self._has_wall & is_lost | ~is_lost
        speed = np.where(is_turning, 0, np.where(is_lost, cruise, cruise * (1 - 0.7 * np.abs(follow))))
        turn = np.where(is_turning, 0.6, np.where(is_lost, corner, follow / self._turn_max_radps))
        return np.stack([speed, side * np.clip(turn, -1, 1)], -1)
