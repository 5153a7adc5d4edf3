"""Recordings and pictures in Python."""
import gzip
import os
import subprocess
import tempfile
import unittest

import numpy as np

import robosim
import scene


class RecordingTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.file = os.path.join(cls.folder.name, "run.rawlog")
        with robosim.Simulation(scene.world(2), controller="none") as simulation:
            simulation.record(cls.file)
            simulation.commands = [[0.5, 0], [0.2, 0.3]]
            cls.poses, cls.sonar = [simulation.poses.copy()], [simulation.readings("sonar")]
            for _ in range(4):
                simulation.step()
                cls.poses.append(simulation.poses.copy())
                cls.sonar.append(simulation.readings("sonar"))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def program(self, *arguments):
        program = os.path.join(os.environ["ROBOSIM_PREFIX"], "bin", "robosim")
        return subprocess.run([program, *arguments], capture_output=True, text=True)

    def test_has_the_poses_and_ranges_of_each_robot(self):
        recording = robosim.read_rawlog(self.file)
        self.assertEqual(recording.robots, ("R1", "R2"))
        self.assertIsNone(recording.damage)
        for i, robot in enumerate(recording.robots):
            np.testing.assert_allclose(recording.poses(robot), [poses[i] for poses in self.poses])
            recorded = recording.sonar(robot)
            np.testing.assert_array_equal(np.where(np.isnan(recorded), 5, recorded), [sonar[i] for sonar in self.sonar])
            np.testing.assert_allclose(recording.times_s(robot), [0, 0.1, 0.2, 0.3, 0.4], atol=1e-6)

    def test_has_the_arrays_of_the_exported_file(self):
        exported = os.path.join(self.folder.name, "run.npz")
        self.assertEqual(self.program("export", self.file, exported).returncode, 0)
        recording = robosim.read_rawlog(self.file)
        with np.load(exported) as arrays:
            self.assertEqual(set(recording), set(arrays))
            for name in arrays:
                np.testing.assert_array_equal(np.asarray(recording[name]), arrays[name], name)

    def test_the_program_repeats_the_recorded_run(self):
        world = os.path.join(self.folder.name, "scene.xml")
        with open(world, "w") as file:
            file.write(scene.text(2))
        checked = self.program("replay", self.file, "--check", world)
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
        self.assertNotIn("changed", checked.stdout + checked.stderr)

    def test_reads_shipped_recordings(self):
        share = os.path.join(os.environ["ROBOSIM_PREFIX"], "share", "robosim")
        recording = robosim.read_rawlog(share + "/rawlogs/slam.rawlog")
        (robot,) = recording.robots
        self.assertEqual(len(recording.scans(robot)), len(recording.times_s(robot, "laser")))
        self.assertEqual(recording.scans(robot).shape[1], 91)
        self.assertEqual(robosim.read_rawlog("slam.rawlog").robots, recording.robots)

    def test_reports_what_is_not_there(self):
        with self.assertRaisesRegex(robosim.ConfigError, "missing.rawlog"):
            robosim.read_rawlog("missing.rawlog")
        with self.assertRaises(robosim.ConfigError):
            robosim.read_rawlog(__file__)
        recording = robosim.read_rawlog(self.file)
        with self.assertRaisesRegex(ValueError, "the recording has no robot 'R9'; it has R1, R2"):
            recording.poses("R9")
        with self.assertRaisesRegex(ValueError, "robot 'R1' has no recorded numbers of 'radar'"):
            recording.scans("R1", "radar")

    def test_a_damaged_recording_is_read_up_to_the_damage(self):
        with open(self.file, "rb") as file:
            whole = file.read()
        damaged = os.path.join(self.folder.name, "damaged.rawlog")
        with open(damaged, "wb") as file:
            file.write(whole[:len(whole) * 2 // 3])
        self.assertIsNotNone(robosim.read_rawlog(damaged).damage)

    def test_a_damaged_recording_raises_and_is_read_on_request(self):
        with gzip.open(self.file) as file:
            whole = bytearray(file.read())
        whole[len(whole) // 2:len(whole) // 2 + 200] = bytes(200)
        damaged = os.path.join(self.folder.name, "damaged.rawlog")
        with open(damaged, "wb") as file:
            file.write(whole)
        with self.assertRaisesRegex(robosim.ConfigError, "damaged.rawlog: ends early, .*allow_damage=True"):
            robosim.read_rawlog(damaged)
        recording = robosim.read_rawlog(damaged, allow_damage=True)
        self.assertIn("ends early", recording.damage)
        self.assertGreater(len(recording.poses("R1")), 0)


class PicturesTest(unittest.TestCase):
    def test_camera_pictures_are_arrays(self):
        share = os.path.join(os.environ["ROBOSIM_PREFIX"], "share", "robosim")
        world = robosim.World.load(share + "/rawlogs/driven.xml")
        with robosim.Simulation(world, controller="none") as simulation:
            image = simulation.robot(world.robots[0].name).image
            self.assertEqual((image.shape, image.dtype), ((120, 160, 3), np.uint8))
            self.assertGreater(image.std(), 5)  # more than the sky
            name = world.robots[0].name
            camera = next(sensor for sensor in world.robots[0].sensors if sensor.kind == "camera")
            self.assertEqual((camera.image_shape, camera.field_of_view_rad > 0), ((120, 160, 3), True))
            for same in (simulation.image(name), simulation.images()[name], simulation.image(name, camera.label),
                         simulation.robot(name).image_of("camera")):
                np.testing.assert_array_equal(same, image)
            with self.assertRaisesRegex(ValueError, "no robot has the camera 'front'"):
                simulation.images("front")
            with self.assertRaisesRegex(ValueError, "takes no pictures; name a camera"):
                simulation.image(name, "odometry")
            simulation.step()  # the camera's rate is lower than that of steps
            self.assertIsNone(simulation.robot(name).image)
            self.assertEqual(simulation.images(), {})

    def test_plans_are_arrays_and_documents_for_notebooks(self):
        world = scene.world(2)
        plan = world.plan()
        self.assertEqual((plan.dtype, plan.ndim, plan.shape[2]), (np.uint8, 3, 3))
        self.assertTrue(((plan[..., 0] > 200) & (plan[..., 2] < 80)).any())  # the gold is yellow
        with robosim.Simulation(world, controller="none") as simulation:
            before, document = simulation.plan(), simulation._repr_svg_()
            self.assertEqual(document, world._repr_svg_())
            simulation.commands = np.ones((2, 2))
            simulation.step(10)
            self.assertEqual(simulation.plan().shape, before.shape)
            self.assertFalse(np.array_equal(simulation.plan(), before))
            self.assertNotEqual(simulation._repr_svg_(), document)
        self.assertTrue(document.startswith("<?xml"))
        self.assertIn("<title>scene</title>", document)


if __name__ == "__main__":
    unittest.main()
