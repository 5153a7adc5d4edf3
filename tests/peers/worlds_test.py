"""Worlds for other simulators: their texts, and that RoboSim reads those of Stage and its own as the same scene."""
import math
import os
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np

import worlds
from programs import RoboSim, run
from scene import WORKLOADS, Body, Box, Pose, Ring, Scene, exact_ranges, make_scene

SMALL = Scene(2, 0.5, (Box(1, -0.5, math.pi / 2, 1.5, 0.25),), (Pose(-1, 0.5, -math.pi / 4),),
              Body(0.25, 0.3, 0.7, 1, 2, math.pi / 2, math.pi, 0.4), Ring(2, 0.2, 0, 0.2, 5))


class Reading(RoboSim):
    """RoboSim with a world file of another format."""

    def __init__(self, workload, name, text):
        super().__init__("RoboSim", os.environ["ROBOSIM_PROGRAM"], workload)
        self.file, self.text = name, text

    def prepare(self, scene, folder):
        (folder / self.file).write_text(self.text)

    def command(self, scene, folder, seconds, controller="wander"):
        return [*super().command(scene, folder, seconds, controller)[:2], self.file, "--controller", controller, "--time", f"{seconds:g}"]


def readings(simulator, scene):
    with tempfile.TemporaryDirectory() as folder:
        simulator.prepare(scene, Path(folder))
        return np.minimum(simulator.readings(scene, Path(folder)), scene.ring.range_max)


class RoboSimWorlds(unittest.TestCase):
    def test_have_the_ranges_of_the_scene(self):
        for name in WORKLOADS:
            for seed in (1, 2):
                scene = make_scene(WORKLOADS[name], 30, seed)
                simulator = RoboSim("RoboSim", os.environ["ROBOSIM_PROGRAM"], name)
                np.testing.assert_allclose(readings(simulator, scene), exact_ranges(scene), atol=1e-6)


class StageWorlds(unittest.TestCase):
    def test_have_the_ranges_of_the_scene_when_RoboSim_reads_them(self):
        for seed in (1, 2):
            scene = make_scene(WORKLOADS["sonar"], 30, seed)
            simulator = Reading("sonar", "peer.world", worlds.stage_world(scene, 1, 0.02, ""))
            np.testing.assert_allclose(readings(simulator, scene), exact_ranges(scene), atol=1e-6)

    def test_state_time_cells_controller_boxes_and_robots(self):
        lines = worlds.stage_world(SMALL, 30, 0.1, "/tmp/walk").splitlines()
        self.assertEqual(lines[:4], ["interval_sim 100", "quit_time 30", "speedup -1", "resolution 0.1"])
        self.assertIn('  ctrl "/tmp/walk"', lines)
        self.assertIn("    pose [ 0 0 -0.11 0 ]", lines)  # rays at 0.2 m: 0.3 - 0.11 + half of a sensor's 0.02
        self.assertIn("    sensor ( pose [ -0.2 0 0 180 ] size [ 0.02 0.02 0.02 ] range [ 0 5 ] fov 0 samples 1 )", lines)
        self.assertIn("  velocity_bounds [ -0.7 0.7 0 0 0 0 -90 90 ]", lines)
        self.assertEqual(lines[-6:], ['box ( name "box0" pose [ -2.25 0 0 0 ] size [ 0.5 5 1 ] )',
                                      'box ( name "box1" pose [ 2.25 0 0 0 ] size [ 0.5 5 1 ] )',
                                      'box ( name "box2" pose [ 0 -2.25 0 0 ] size [ 5 0.5 1 ] )',
                                      'box ( name "box3" pose [ 0 2.25 0 0 ] size [ 5 0.5 1 ] )',
                                      'box ( name "box4" pose [ 1 -0.5 0 90 ] size [ 1.5 0.25 1 ] )',
                                      'bot ( name "r0" pose [ -1 0.5 0 -45 ] )'])

    def test_have_no_note_but_about_the_controller(self):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "peer.world").write_text(worlds.stage_world(SMALL, 30, 0.1, ""))
            text, _ = run([os.environ["ROBOSIM_PROGRAM"], "check", "peer.world"], folder)
            self.assertNotIn("left out", text)


class ArgosExperiments(unittest.TestCase):
    def test_state_time_controller_boxes_and_robots(self):
        root = ElementTree.fromstring(worlds.argos_experiment(SMALL, 30, "walk.lua", 1))
        self.assertEqual(root.find("framework/experiment").attrib, {"length": "30", "ticks_per_second": "10", "random_seed": "1"})
        self.assertEqual(root.find("framework/system").attrib, {"threads": "0"})
        self.assertEqual(root.find("controllers/lua_controller/params").attrib, {"script": "walk.lua"})
        self.assertEqual(root.find("arena").attrib, {"size": "5,5,2", "center": "0,0,1"})
        box = root.findall("arena/box")[4]
        self.assertEqual(box.attrib, {"id": "box4", "size": "1.5,0.25,1", "movable": "false"})
        self.assertEqual(box.find("body").attrib, {"position": "1,-0.5,0", "orientation": "90,0,0"})
        robot = root.find("arena/foot-bot")
        self.assertEqual(robot.find("body").attrib, {"position": "-1,0.5,0", "orientation": "-45,0,0"})
        self.assertEqual(robot.find("controller").attrib, {"config": root.find("controllers/lua_controller").get("id")})
        self.assertEqual(root.find("physics_engines/dynamics2d").get("iterations"), "1")

    def test_drive_at_the_scenes_speed_in_centimetres_per_second(self):
        self.assertIn("robot.wheels.set_velocity(70, 70)", worlds.argos_script(SMALL))

    def test_report_distances_as_readings_that_are_inverted(self):
        self.assertEqual(worlds.argos_distance(0, 0.1), 0.1)
        self.assertEqual(worlds.argos_distance(1, 0.1), worlds.ARGOS_NEAR)
        # ARGoS: 0.0100527 / (0.05 + 0.000163144)
        self.assertAlmostEqual(worlds.argos_distance(0.200400117, 0.1), 0.05, places=8)


class MVSimWorlds(unittest.TestCase):
    def test_state_boxes_robots_and_rays(self):
        root = ElementTree.fromstring(worlds.mvsim_world(SMALL).replace("vehicle:class", "vehicle_class"))
        box = root.findall("block")[4]
        self.assertEqual([point.text for point in box.findall("shape/pt")], ["-0.75 -0.125", "-0.75 0.125", "0.75 0.125", "0.75 -0.125"])
        self.assertEqual(box.find("init_pose").text, "1 -0.5 90")
        self.assertEqual(root.find("vehicle/init_pose").text, "-1 0.5 -45")
        sensor = root.find("vehicle_class/sensor")
        # Two rays 180° apart, the first one ahead: the field of view of 180° begins at 0°.
        self.assertEqual((sensor.find("nrays").text, sensor.find("fov_degrees").text), ("2", "180"))
        self.assertEqual(sensor.find("pose_3d").text, "0 0 0.2 90 0 0")


class Numbers(unittest.TestCase):
    def test_have_no_exponent(self):
        self.assertEqual(worlds.numbers(1e-7, -0.0, 12345678.5, 1e-13), "0.0000001 0 12345678.5 0")


if __name__ == "__main__":
    unittest.main()
