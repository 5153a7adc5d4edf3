"""Scenes and their exact ranges."""
import math
import unittest

import numpy as np

from scene import WORKLOADS, Body, Box, Pose, Ring, Scene, distance_to_box, exact_ranges, make_scene

BODY = Body(radius=0.25, height=0.3, speed_max=1, accel=1, decel=1, turn_max=1, turn_accel=1, wheel_track=0.4)
CROSS = Ring(count=4, radius=0.2, first_angle=0, height=0.2, range_max=5)


def scene_of(robots, boxes=(), half=10):
    return Scene(half, 1, tuple(boxes), tuple(robots), BODY, CROSS)


class Ranges(unittest.TestCase):
    def test_begin_on_the_ring_and_end_at_the_nearest_solid(self):
        scene = scene_of([Pose(0, 0, 0)], [Box(3, 0, 0, 2, 1), Box(0, -2, math.pi / 2, 1, 4)])
        # Ahead the face at x = 2; to the left the wall at 10 m is too far; behind nothing; to the right the face at y = -1.5.
        np.testing.assert_allclose(exact_ranges(scene), [[1.8, 5, 5, 1.3]], atol=1e-12)

    def test_meet_turned_boxes(self):
        scene = scene_of([Pose(1, 1, math.pi / 4)], [Box(1 + 2 * math.sqrt(0.5), 1 + 2 * math.sqrt(0.5), math.pi / 4, 1, 1)])
        self.assertAlmostEqual(exact_ranges(scene)[0][0], 2 - 0.5 - 0.2, places=12)

    def test_see_other_robots_as_discs_and_not_the_robot_itself(self):
        scene = scene_of([Pose(0, 0, 0), Pose(2, 0.15, 0)])
        first, second = exact_ranges(scene)
        self.assertAlmostEqual(first[0], 2 - math.sqrt(0.25**2 - 0.15**2) - 0.2, places=12)
        self.assertEqual(first[2], 5)
        self.assertAlmostEqual(second[2], first[0], places=12)

    def test_end_at_the_walls(self):
        scene = scene_of([Pose(8, 0, 0)])
        self.assertAlmostEqual(exact_ranges(scene)[0][0], 1.8, places=12)


class Scenes(unittest.TestCase):
    def test_are_equal_for_equal_seeds(self):
        workload = WORKLOADS["sonar"]
        self.assertEqual(make_scene(workload, 20, 3), make_scene(workload, 20, 3))
        self.assertNotEqual(make_scene(workload, 20, 3), make_scene(workload, 20, 4))

    def test_have_robots_at_free_places(self):
        for name, workload in WORKLOADS.items():
            for seed in range(5):
                scene = make_scene(workload, 30, seed)
                self.assertEqual(len(scene.robots), 30)
                radius = scene.body.radius
                for i, robot in enumerate(scene.robots):
                    nearest = min(distance_to_box(box, robot.x, robot.y) for box in scene.solids())
                    self.assertGreater(nearest, radius, (name, seed, i))
                    for other in scene.robots[:i]:
                        self.assertGreater(math.hypot(robot.x - other.x, robot.y - other.y), 2 * radius, (name, seed, i))


if __name__ == "__main__":
    unittest.main()
