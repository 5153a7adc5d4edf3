"""soccer-v1: three players against three of RoboSim's own."""
import numpy as np

from .. import _robosim
from .steering import free_direction, nearest_low, position_of, push, ring_bearings, sectors, steer, wrap
from .task import Task

GOAL_LINE_M = 4.5
HALF_WIDTH_M = 3
BALL_RADIUS_M = 0.11
BEAMS = 180
FIELD_RAD = np.radians(358)
ROBOT_RADIUS_M = 0.2
TURN_MAX_RADPS = np.radians(270)


class Soccer(Task):
    name = "soccer-v1"
    help = "The blue team of the world soccer scores against three robots with the controller soccer, within 60 s."
    agents = 3
    observations = ("laser_low", "laser_high", "beacons", "compass", "stalled")
    max_steps = 600
    metrics = {"won": "share", "lost": "share", "goals": "mean"}

    def __init__(self):
        self._ball_x_m = self._goal = None

    @classmethod
    def world(cls, seed):
        return _robosim.World.load("soccer", seed=seed)

    @classmethod
    def changes(cls, seed):
        """The ball lies up to 1 m ahead of or behind the centre, and up to 1.5 m beside it (multiples of golden ratios)."""
        x_m = 2 * (seed * 0.6180339887498949 % 1) - 1
        y_m = 3 * (seed * 0.7548776662466927 % 1) - 1.5
        return [f'<place name="Ball" x="{x_m:.3f}" y="{y_m:.3f}"/>']

    @classmethod
    def handwritten(cls):
        return Players()

    @classmethod
    def features(cls, observations):
        """The ball in view, the goals and the scan, as perceived() computes them."""
        seen = perceived(observations)
        scan = np.exp(-sectors(observations[..., BEAMS:2 * BEAMS], 10))
        one = np.ones_like(seen.x)
        agent = np.broadcast_to(np.eye(Soccer.agents), (*seen.x.shape, Soccer.agents))
        columns = [seen.has_ball, seen.has_ball * np.exp(-seen.distance_m), seen.has_ball * np.sin(seen.bearing_rad),
                   seen.has_ball * np.cos(seen.bearing_rad), seen.has_ball * np.sin(seen.error_rad),
                   seen.has_ball * np.cos(seen.error_rad), seen.x / GOAL_LINE_M, seen.y / HALF_WIDTH_M,
                   np.sin(seen.heading_rad), np.cos(seen.heading_rad), observations[..., -1], one]
        return np.concatenate([np.stack(columns, -1), agent, scan], axis=-1)

    @staticmethod
    def _ball(env):
        return env._batch.movable_positions[:, 0, 0]

    def begin(self, env, which):
        ball = self._ball(env)
        self._ball_x_m = ball if self._ball_x_m is None else np.where(which, ball, self._ball_x_m)

    def step(self, env, rewards, terminated):
        """For each agent alike: 1 for a goal in the east, -1 for one in the west, and 0.02 × the way of the ball to the east
        [m]. The end: a goal."""
        ball = self._ball(env)
        beyond = np.abs(ball) > GOAL_LINE_M + BALL_RADIUS_M
        self._goal = np.where(beyond, np.sign(ball), 0)
        shared = self._goal + 0.02 * (ball - self._ball_x_m)
        self._ball_x_m = ball
        return np.repeat(shared[:, None], self.agents, 1), beyond

    def results(self, env):
        return {"won": self._goal > 0, "lost": self._goal < 0, "goals": self._goal}


class Seen:
    """What a player perceives: fields of shape (…, agents)."""


def perceived(observations):
    """Its own place by the beacons and the compass, and the ball in view about itself and the goal in the east."""
    seen = Seen()
    low, seen.high = (observations[..., i * BEAMS:(i + 1) * BEAMS].astype(np.float64) for i in range(2))
    seen.x, seen.y = position_of(observations[..., 2 * BEAMS:2 * BEAMS + 4], GOAL_LINE_M, HALF_WIDTH_M)
    seen.heading_rad = observations[..., 2 * BEAMS + 4].astype(np.float64)
    seen.bearings = ring_bearings(BEAMS, FIELD_RAD)
    seen.distance_m, seen.bearing_rad = nearest_low(low, seen.high, seen.bearings, BALL_RADIUS_M)
    seen.has_ball = np.isfinite(seen.distance_m)
    seen.distance_m = np.where(seen.has_ball, seen.distance_m, 0)
    course = seen.heading_rad + seen.bearing_rad
    seen.ball_x, seen.ball_y = seen.x + seen.distance_m * np.cos(course), seen.y + seen.distance_m * np.sin(course)
    seen.error_rad = wrap(course - np.arctan2(-seen.ball_y, GOAL_LINE_M + 0.3 - seen.ball_x))
    return seen


class Players:
    """The first player keeps the goal. Of the others the one that sees the ball nearer pushes it to the goal, as the team
    shares what it sees; the other one stays behind the ball. They back off when they stall."""

    name = "handwritten"

    def __init__(self):
        self._back = self._held = None

    def reset(self, num_envs):
        self._back, self._held = (np.zeros((num_envs, Soccer.agents), int) for _ in range(2))

    def __call__(self, observations):
        seen = perceived(observations)

        def free(bearing_rad):
            return free_direction(seen.high, seen.bearings, bearing_rad, ROBOT_RADIUS_M)

        def drive_to(x_m, y_m, speed):
            way_x, way_y = x_m - seen.x, y_m - seen.y
            distance = np.hypot(way_x, way_y)
            action = steer(free(wrap(np.arctan2(way_y, way_x) - seen.heading_rad)), speed * np.clip(2 * distance, 0, 1),
                           TURN_MAX_RADPS)
            return np.where((distance < 0.15)[..., None], 0, action)

        chasing = push(seen.distance_m, seen.bearing_rad, seen.error_rad, ROBOT_RADIUS_M + BALL_RADIUS_M,
                       np.where(np.abs(seen.error_rad) < 0.25, 0.95, 0.7), TURN_MAX_RADPS, free)
        # The ball that the team sees from the nearest.
        cost = np.where(seen.has_ball, seen.distance_m + 0.4 * np.abs(seen.error_rad), np.inf)
        best = cost.argmin(-1)[:, None]
        ball_x, ball_y = (np.take_along_axis(of, best, 1) for of in (seen.ball_x, seen.ball_y))
        is_known = np.isfinite(cost.min(-1))[:, None]
        keeper_y = np.clip(ball_y * np.clip(0.8 / np.maximum(0.8, ball_x + GOAL_LINE_M), 0, 1), -0.6, 0.6)
        keeping = drive_to(np.full_like(seen.x, 0.35 - GOAL_LINE_M), np.broadcast_to(keeper_y, seen.x.shape), 0.7)
        supporting = drive_to(np.clip(ball_x - 1.6, -3.3, 3.3) + 0 * seen.x, np.clip(0.5 * ball_y - 0.8, -2.4, 2.4) + 0 * seen.y,
                              0.5)
        agent = np.arange(Soccer.agents)
        field_cost = np.where(agent == 0, np.inf, cost)
        is_chaser = (field_cost.argmin(-1)[:, None] == agent) & np.isfinite(field_cost)
        is_keeper = agent == 0
        is_keeper_busy = is_keeper & seen.has_ball & (seen.distance_m < 0.9) & (seen.ball_x < -GOAL_LINE_M + 1.3)
        action = np.where(is_keeper[:, None], keeping, supporting)
        action = np.where((is_chaser | is_keeper_busy)[..., None], chasing, action)
        action = np.where(is_known[..., None], action, np.where(is_keeper[:, None], [0.0, 0.0], [0.0, 0.1]))
        stalled = observations[..., -1] > 0
        self._held = np.where(stalled, self._held + 1, 0)
        self._back = np.where((self._held > 7) & (self._back == 0), 7, np.maximum(self._back - 1, 0))
        side = np.where(agent % 2 == 0, 0.17, -0.17)
        backing = np.stack([np.full_like(seen.x, -0.3), np.broadcast_to(side, seen.x.shape)], -1)
        return np.where((self._back > 0)[..., None], backing, action)
