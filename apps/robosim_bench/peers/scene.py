"""A scene of robots among boxes, of which each simulator gets a world (worlds.py), and its exact ranges."""
import math
import random
from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class Box:
    """An upright box on the floor, in plan. Angles are in radians, lengths in metres."""
    x: float
    y: float
    heading: float
    length: float
    width: float


@dataclass(frozen=True)
class Pose:
    x: float
    y: float
    heading: float


@dataclass(frozen=True)
class Body:
    """A round robot with two wheels."""
    radius: float
    height: float
    speed_max: float
    accel: float
    decel: float
    turn_max: float
    turn_accel: float
    wheel_track: float


@dataclass(frozen=True)
class Ring:
    """Rays of one height, evenly spaced and directed outwards, counter-clockwise."""
    count: int
    radius: float
    first_angle: float
    height: float
    range_max: float

    def angle(self, i):
        return self.first_angle + 2 * math.pi * i / self.count


@dataclass(frozen=True)
class Scene:
    """A square of side 2 * half, with walls of thickness `wall` around it."""
    half: float
    wall: float
    boxes: tuple
    robots: tuple
    body: Body
    ring: Ring
    height: float = 1.0  # of boxes and walls

    def walls(self):
        middle, side = self.half + self.wall / 2, 2 * (self.half + self.wall)
        return (Box(-middle, 0, 0, self.wall, side), Box(middle, 0, 0, self.wall, side),
                Box(0, -middle, 0, side, self.wall), Box(0, middle, 0, side, self.wall))

    def solids(self):
        return self.walls() + self.boxes


@dataclass(frozen=True)
class Workload:
    name: str
    help: str
    scale: float
    area_per_robot: float
    body: Body
    ring: Ring


WORKLOADS = {workload.name: workload for workload in (
    Workload("sonar", "16 sonars of one ray to 5 m, 16 m² per robot", 1, 16,
             Body(0.25, 0.3, 0.7, 1, 2, math.radians(115), math.radians(286), 0.4), Ring(16, 0.2, 0, 0.2, 5)),
    # Body and ring are those of ARGoS's foot-bot, which cannot be changed.
    Workload("proximity", "24 infrared rays to 10 cm, 1 m² per robot", 0.25, 1,
             Body(0.085036758, 0.146899733, 0.1, 1, 1, math.radians(245), math.radians(800), 0.14),
             Ring(24, 0.085036758, math.pi / 24, 0.06, 0.1)))}


def distance_to_box(box, x, y):
    """Distance of points from a box in plan; 0 within it."""
    dx, dy = x - box.x, y - box.y
    cos, sin = math.cos(box.heading), math.sin(box.heading)
    along, across = abs(dx * cos + dy * sin) - box.length / 2, abs(dy * cos - dx * sin) - box.width / 2
    return math.hypot(max(along, 0), max(across, 0))


def make_scene(workload, robots, seed):
    """One box per robot, a wall per four robots, and a robot in each square of a grid, at a random free place of it."""
    rng = random.Random(seed)
    scale, radius = workload.scale, workload.body.radius
    half = math.sqrt(workload.area_per_robot * robots) / 2
    boxes = []
    for i in range(robots):
        size = [2 * scale * rng.uniform(0.2, 0.6) for _ in range(2)]
        boxes.append(Box(rng.uniform(-half, half), rng.uniform(-half, half), rng.uniform(-math.pi, math.pi), *size))
        if i % 4 == 0:
            boxes.append(Box(rng.uniform(-half, half), rng.uniform(-half, half), rng.uniform(-math.pi, math.pi),
                             4 * scale, 0.1 * scale))
    columns = math.ceil(math.sqrt(robots))
    pitch, margin = 2 * half / columns, 1.2 * radius
    reach = 4 * scale + margin
    cells = {}
    for box in boxes:
        for column in range(*(math.floor((box.x + half + side * reach) / pitch) + end for side, end in ((-1, 0), (1, 1)))):
            for row in range(*(math.floor((box.y + half + side * reach) / pitch) + end for side, end in ((-1, 0), (1, 1)))):
                cells.setdefault((column, row), []).append(box)
    poses = []
    for i in range(robots):
        column, row = i % columns, i // columns
        near = cells.get((column, row), [])
        while True:
            x = -half + pitch * column + rng.uniform(margin, pitch - margin)
            y = -half + pitch * row + rng.uniform(margin, pitch - margin)
            if all(distance_to_box(box, x, y) > margin for box in near):
                break
        poses.append(Pose(x, y, rng.uniform(-math.pi, math.pi)))
    return Scene(half, scale, tuple(boxes), tuple(poses), workload.body, workload.ring)


def exact_ranges(scene, robots=None):
    """Ranges at the start poses by brute force: each ray with every solid and every other robot.

    robots: indices; None for all. Returns an array of shape (robots, rays); range_max without an echo."""
    ring, solids = scene.ring, scene.solids()
    box = np.array([(b.x, b.y, math.cos(b.heading), math.sin(b.heading), b.length / 2, b.width / 2) for b in solids])
    disc = np.array([(pose.x, pose.y) for pose in scene.robots])
    indices = range(len(scene.robots)) if robots is None else robots
    return np.array([[_range(scene, i, ring.angle(ray), box, disc) for ray in range(ring.count)] for i in indices])


def _range(scene, robot, angle, box, disc):
    pose, ring = scene.robots[robot], scene.ring
    heading = pose.heading + angle
    cos, sin = math.cos(heading), math.sin(heading)
    x, y = pose.x + ring.radius * cos, pose.y + ring.radius * sin
    # Boxes: the ray in the frame of each, clipped by both pairs of its faces.
    dx, dy = x - box[:, 0], y - box[:, 1]
    origin = np.stack([dx * box[:, 2] + dy * box[:, 3], dy * box[:, 2] - dx * box[:, 3]])
    along = np.stack([cos * box[:, 2] + sin * box[:, 3], sin * box[:, 2] - cos * box[:, 3]])
    with np.errstate(divide="ignore", invalid="ignore"):
        first, second = (-origin - box[:, 4:6].T) / along, (-origin + box[:, 4:6].T) / along
    enter, leave = np.minimum(first, second).max(0), np.maximum(first, second).min(0)
    nearest = np.where((enter <= leave) & (leave >= 0), np.maximum(enter, 0), np.inf).min()
    # Discs: the solution of |origin + t · direction - centre| = radius.
    to_x, to_y = disc[:, 0] - x, disc[:, 1] - y
    middle, off = to_x * cos + to_y * sin, to_x * sin - to_y * cos
    square = scene.body.radius**2 - off**2
    t = middle - np.sqrt(np.maximum(square, 0))
    hit = (square >= 0) & (t >= 0)
    hit[robot] = False
    if hit.any():
        nearest = min(nearest, t[hit].min())
    return min(nearest, ring.range_max)
