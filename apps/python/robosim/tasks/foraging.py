"""foraging-v1: a team pushes pucks into a nest."""
import numpy as np

from .. import _robosim
from .arena import arena, beacons, robot, scatter
from .steering import free_direction, nearest_low, position_of, push, ring_bearings, sectors, steer, wrap
from .task import Task

HALF_SIDE_M = 3.5
NEST_RADIUS_M = 1.0
PUCK_RADIUS_M = 0.1
PUCKS = 12
BEAMS = 90
FIELD_RAD = np.radians(356)
ROBOT_RADIUS_M = 0.15
TURN_MAX_RADPS = np.pi
SENSORS = "".join(f'<laser label="laser_{name}" z_m="{z_m}" beams="{BEAMS}" field_of_view_deg="356" range_max_m="2.5"/>'
                  for name, z_m in (("low", 0.04), ("high", 0.25))) + beacons(HALF_SIDE_M, HALF_SIDE_M) + "<compass/>"


class Foraging(Task):
    name = "foraging-v1"
    help = "Three pushers bring twelve pucks into the nest, a disc with a radius of 1 m in an arena of 7 m × 7 m, in 120 s."
    agents = 3
    observations = ("laser_low", "laser_high", "beacons", "compass", "stalled")
    max_steps = 1200
    metrics = {"collected": "mean"}

    def __init__(self):
        self._inside = self._left_m = None

    @classmethod
    def world(cls, seed):
        def pucks(name, **area):
            return scatter(PUCKS // 2, f"<primitive><cylinder><name>{name}</name><z>0.04</z><radius>{PUCK_RADIUS_M}</radius>"
                           '<height>0.08</height><movable mass_kg="0.5" friction="0.3"/></cylinder></primitive>',
                           ymin=-2.9, ymax=2.9, gap=0.1, **area)
        text = arena(HALF_SIDE_M, HALF_SIDE_M, pucks("West", xmin=-2.9, xmax=-1.2) + pucks("East", xmin=1.2, xmax=2.9)
                     + scatter(cls.agents, robot("pusher", "Robot", SENSORS), pattern="ring", radius=0.6))
        return _robosim.World.parse(text, name="foraging", seed=seed)

    @classmethod
    def handwritten(cls):
        return Foragers()

    @classmethod
    def features(cls, observations):
        """The nearest puck outside the nest and its place about the robot and the nest, as perceived() computes them."""
        seen = perceived(observations)
        scan = np.exp(-2 * sectors(observations[..., BEAMS:2 * BEAMS], 10))
        columns = [seen.has_puck, seen.has_puck * np.exp(-seen.distance_m), seen.has_puck * np.sin(seen.bearing_rad),
                   seen.has_puck * np.cos(seen.bearing_rad), seen.has_puck * np.sin(seen.error_rad),
                   seen.has_puck * np.cos(seen.error_rad), seen.nest_m / 3, np.sin(seen.nest_bearing_rad),
                   np.cos(seen.nest_bearing_rad), observations[..., -1], np.ones_like(seen.nest_m)]
        return np.concatenate([np.stack(columns, -1), scan], axis=-1)

    def _measure(self, env):
        """Whether each puck is in the nest, and the sum of the distances of the others from its edge [m]."""
        places = env._batch.movable_positions
        from_edge = np.sqrt((places**2).sum(-1)) - NEST_RADIUS_M
        return (from_edge <= 0).sum(1), np.maximum(from_edge, 0).sum(1)

    def begin(self, env, which):
        inside, left_m = self._measure(env)
        if self._inside is None:
            self._inside, self._left_m = inside, left_m
        self._inside, self._left_m = np.where(which, inside, self._inside), np.where(which, left_m, self._left_m)

    def step(self, env, rewards, terminated):
        """For each agent alike: pucks that have come into the nest minus those that have left it, and 0.1 × the decrease of
        the sum of the distances of the others from it [m]. The end: all pucks are in the nest."""
        inside, left_m = self._measure(env)
        shared = inside - self._inside + 0.1 * (self._left_m - left_m)
        self._inside, self._left_m = inside, left_m
        return np.repeat(shared[:, None], self.agents, 1), inside == PUCKS

    def results(self, env):
        return {"collected": self._inside}


class Seen:
    """What a forager perceives: fields of shape (…, agents)."""


def perceived(observations):
    """Its own place by the beacons, the nest (the world's origin), and the nearest puck in view outside the nest."""
    seen = Seen()
    low, high = observations[..., :BEAMS].astype(np.float64), observations[..., BEAMS:2 * BEAMS].astype(np.float64)
    x, y = position_of(observations[..., 2 * BEAMS:2 * BEAMS + 4], HALF_SIDE_M, HALF_SIDE_M)
    heading = observations[..., 2 * BEAMS + 4].astype(np.float64)
    bearings = ring_bearings(BEAMS, FIELD_RAD)
    courses = heading[..., None] + bearings
    puck_x, puck_y = (x[..., None] + (low + PUCK_RADIUS_M) * np.cos(courses),
                      y[..., None] + (low + PUCK_RADIUS_M) * np.sin(courses))
    is_outside = np.hypot(puck_x, puck_y) > NEST_RADIUS_M - 0.12
    seen.distance_m, seen.bearing_rad = nearest_low(low, high, bearings, PUCK_RADIUS_M, is_outside)
    seen.has_puck = np.isfinite(seen.distance_m)
    seen.distance_m = np.where(seen.has_puck, seen.distance_m, 0)
    seen.is_delivering = (nearest_low(low, high, bearings, PUCK_RADIUS_M, ~is_outside & (np.abs(bearings) < 0.5))[0]
                          < ROBOT_RADIUS_M + PUCK_RADIUS_M + 0.06)
    seen.high, seen.heading_rad, seen.x, seen.y = high, heading, x, y
    course = heading + seen.bearing_rad
    to_nest = np.arctan2(-(y + seen.distance_m * np.sin(course)), -(x + seen.distance_m * np.cos(course)))
    seen.error_rad = wrap(course - to_nest)
    seen.nest_m, seen.nest_bearing_rad = np.hypot(x, y), wrap(np.arctan2(-y, -x) - heading)
    seen.bearings = bearings
    return seen


class Foragers:
    """Each pushes the nearest puck in view into the nest, backs off, and searches along courses that change."""

    name = "handwritten"

    def __init__(self):
        self._back = self._step = self._held = None

    def reset(self, num_envs):
        self._back, self._held = (np.zeros((num_envs, Foraging.agents), int) for _ in range(2))
        self._step = 0

    def __call__(self, observations):
        seen = perceived(observations)
        stalled = observations[..., -1] > 0

        def free(bearing_rad):
            return free_direction(seen.high, seen.bearings, bearing_rad, ROBOT_RADIUS_M)

        pushing = push(seen.distance_m, seen.bearing_rad, seen.error_rad, ROBOT_RADIUS_M + PUCK_RADIUS_M, 0.5, TURN_MAX_RADPS,
                       free)
        # A course for each agent, another one every six seconds; out of the nest first.
        turns = (self._step // 60 * 7 + np.arange(Foraging.agents) * 5) % 12
        course = np.where(seen.nest_m < NEST_RADIUS_M + 0.6, seen.nest_bearing_rad + np.pi, turns * np.pi / 6 - seen.heading_rad)
        searching = steer(free(wrap(course)), 0.5, TURN_MAX_RADPS)
        self._held = np.where(stalled, self._held + 1, 0)
        begins = (seen.is_delivering | (self._held > 8)) & (self._back == 0)
        self._back = np.where(begins, 14, np.maximum(self._back - 1, 0))
        self._step += 1
        action = np.where(seen.has_puck[..., None], pushing, searching)
        return np.where((self._back > 0)[..., None], np.array([-0.3, 0.15]), action)
