"""Worlds built object by object in Python."""
import math
import unittest

import robosim


def room():
    return robosim.WorldBuilder(x_m=(0, 10), y_m=(0, 6))


class WorldBuilderTest(unittest.TestCase):
    def test_places_objects_and_robots_as_given(self):
        world = (room().box("wall", 5, 3, length_m=4, width_m=0.1, heading_rad=math.pi / 2)
                 .cylinder("gold", 9, 5, radius_m=0.2, heat_celsius=20)
                 .robot("pioneer3dx", "R1", 1, 2, 0.5, controller="wall_follower", distance_radii=2.5).build(name="room"))
        self.assertEqual((world.name, world.bounds), ("room", (0, 10, 0, 6)))
        wall, gold = world.objects
        self.assertEqual((wall.name, wall.shape, wall.size_m, wall.heat_celsius), ("wall", "cube", (4, 0.1), 0))
        self.assertAlmostEqual(wall.pose[2], math.pi / 2)
        self.assertEqual((gold.shape, gold.pose[:2], gold.size_m, gold.heat_celsius), ("cylinder", (9, 5), (0.4, 0.4), 20))
        (robot,) = world.robots
        self.assertEqual((robot.name, robot.type, robot.start), ("R1", "pioneer3dx", (1, 2, 0.5)))
        self.assertEqual(robot.controller, "wall_follower distance_radii=2.5")

    def test_scatters_robots_by_the_seed(self):
        builder = room().scatter_robots(5, "scout", "S", area=(0, 5, 0, 6), gap_m=0.2)
        starts = [[robot.start for robot in builder.build(seed=seed).robots] for seed in (1, 1, 2)]
        self.assertEqual(starts[0], starts[1])
        self.assertNotEqual(starts[0], starts[2])
        self.assertEqual([robot.name for robot in builder.build().robots], ["S1", "S2", "S3", "S4", "S5"])
        self.assertTrue(all(x < 5 for x, _, _ in starts[0]))

    def test_escapes_names_and_reports_faults(self):
        world = room().robot("pioneer3dx", "R<1>&\"", 1, 1).build()
        self.assertEqual(world.robots[0].name, "R<1>&\"")
        with self.assertRaisesRegex(robosim.ConfigError, "tortoise"):
            room().robot("tortoise", "R1", 1, 1).build()
        with self.assertRaises(robosim.ConfigError):
            room().cylinder("flat", 1, 1, radius_m=-1).build()
        with self.assertRaisesRegex(ValueError, "without a controller"):
            room().robot("pioneer3dx", "R1", 1, 1, distance_radii=2)

    def test_runs(self):
        world = room().robot("pioneer3dx", "R1", 1, 1, controller="wander").build()
        with robosim.Simulation(world) as simulation:
            simulation.step(50)
            self.assertEqual(simulation.step_count, 50)


if __name__ == "__main__":
    unittest.main()
