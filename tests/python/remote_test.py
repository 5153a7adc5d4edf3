"""Robots of a server: the same run as in this process, and errors."""
import json
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import robosim
import scene
from robosim.v1 import robots_pb2 as v1
from serving import Serving

_KINDS = ("sonar", "laser", "heat", "bumper", "odometry", "compass")


class RemoteRobotsTest(unittest.TestCase):
    def test_drive_the_same_run_as_a_simulation(self):
        """R1 drives into the gold, and stalls there."""
        commands = [np.array([[0.7, 0.0], [0.4, 0.1 * (step % 5)]]) for step in range(100)]
        with Serving(scene.text(), "--time", "10") as server, \
                robosim.Simulation(scene.world(), controller="none") as simulation:
            robots = robosim.RemoteRobots(server.address, ["R1", "R2"])
            stalled = 0
            for step, command in enumerate(commands):
                self.assertEqual(robots.step_count, step)
                for kind in _KINDS:
                    np.testing.assert_array_equal(robots.readings(kind).astype(np.float32), simulation.readings(kind), kind)
                np.testing.assert_array_equal(robots.stalled, simulation.stalled)
                stalled += robots.stalled.sum()
                robots.commands = command
                simulation.commands = command
                self.assertTrue(robots.step())
                simulation.step()
            self.assertGreater(stalled, 10)
            self.assertFalse(robots.step())  # the run is over
            self.assertEqual(robots.step_count, 100)
            self.assertEqual(json.loads(server.finish())["digest"], simulation.digest)

    def test_read_the_odometry_of_robots_with_and_without_a_lateral_speed(self):
        drive = '<drive type="tracked" icr_x_m="0.05"/>'
        text = scene.text().replace("</model>", f"</model>{drive}")
        self.assertIn(drive, text)
        with Serving(text) as server, robosim.Simulation(robosim.World.parse(text), controller="none") as simulation, \
                robosim.RemoteRobots(server.address, ["R1", "R2"]) as robots:
            # Only a robot that turns has a lateral speed.
            for command in ([[0.2, 0], [0.2, 0]], [[0.2, 0.5], [0.2, 0]], [[0.2, 0.5], [0.2, 0.5]]):
                robots.commands = simulation.commands = np.array(command)
                robots.step()
                simulation.step()
                np.testing.assert_array_equal(robots.readings("odometry").astype(np.float32), simulation.readings("odometry"))

    def test_readings_are_views_that_keep_their_values(self):
        with Serving(scene.text()) as server, robosim.RemoteRobots(server.address, ["R1", "R2"]) as robots:
            robots.commands = [0.5, 0]
            for _ in range(3):
                robots.step()
            ranges, points = robots.readings("laser"), robots.points("laser")
            self.assertEqual((ranges.shape, points.shape), ((2, 181), (2, 181, 3)))
            self.assertTrue(np.may_share_memory(ranges, points))
            self.assertFalse(ranges.flags.writeable or ranges.flags.owndata)
            before = ranges.copy()
            for _ in range(5):
                robots.step()
            np.testing.assert_array_equal(ranges, before)
            self.assertFalse(np.array_equal(robots.readings("laser"), before))
        np.testing.assert_array_equal(ranges, before)

    def test_of_different_types_have_nan_for_sensors_that_they_lack(self):
        text = scene.text().replace("pioneer3dx</model><name>R2", "scout</model><name>R2")
        with Serving(text) as server, robosim.RemoteRobots(server.address, ["R2", "R1"]) as robots:
            laser = robots.readings("laser")
            self.assertTrue(np.isnan(laser[0]).all())
            self.assertFalse(np.isnan(laser[1]).any())
            self.assertEqual(robots.points("sonar").shape, (2, 16, 3))
            self.assertEqual(robots.readings("heat").shape, (2, 1))

    def test_exchange_messages_win_and_halt(self):
        with Serving(scene.text(), "--time", "60") as server:
            robots = robosim.RemoteRobots(server.address, ["R1", "R2"])
            robots.send("R1", "R2", "grün")
            robots.check_win("R1")
            robots.step()
            self.assertEqual((robots.inbox("R1"), robots.inbox("R2")), ([], [("R1", "grün")]))
            self.assertEqual(robots.is_too_far.tolist(), [True, False])
            self.assertIsNone(robots.winner)
            robots.broadcast("R2", "all")
            robots.step()
            self.assertEqual((robots.inbox("R1"), robots.inbox("R2")), ([("R2", "all")], []))
            robots.halt("R1")
            robots.halt("R2")
            while robots.step():
                pass
            self.assertEqual(json.loads(server.finish())["steps"], 3)

    def test_receive_pictures_of_cameras(self):
        text = scene.text().replace("pioneer3dx</model><name>R2", "pioneer3dx_camera</model><name>R2")
        with Serving(text) as server, robosim.RemoteRobots(server.address, ["R1", "R2"]) as robots:
            while not robots.picture("R2"):
                self.assertTrue(robots.step())
            self.assertEqual(robots.picture("R2")[:3], b"\xff\xd8\xff")  # a JPEG file
            self.assertEqual(robots.readings("camera").shape[0], 2)
            self.assertEqual(robots.readings("sonar").shape, (2, 16))

    def test_one_robot_may_be_given_by_its_name(self):
        with Serving(scene.text(1)) as server, robosim.RemoteRobots(server.address, "R1") as robots:
            self.assertEqual(robots.names, ("R1",))
            self.assertEqual(robots.readings("sonar").shape, (1, 16))
            self.assertTrue(robots.step())
            self.assertAlmostEqual(robots.time_s, 0.1)


class ErrorsTest(unittest.TestCase):
    def expect(self, status, text, address, names, **options):
        with self.assertRaisesRegex(robosim.RemoteError, text) as caught:
            robosim.RemoteRobots(address, names, **options)
        self.assertEqual(caught.exception.status, status)
        self.assertIsInstance(caught.exception, ConnectionError)

    def test_wrong_address(self):
        self.expect("UNAVAILABLE", "^127.0.0.1:1: .*start robosim serve there, or correct the address$", "127.0.0.1:1", "R1")

    def test_robot_of_another_world(self):
        with Serving(scene.text()) as server:
            self.expect("NOT_FOUND", "the world 'scene' has no robot 'Bogus'", server.address, ["R1", "Bogus"])

    def test_wrong_token(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "tokens")
            with open(os.open(file, os.O_CREAT | os.O_WRONLY, 0o600), "w", encoding="utf-8") as tokens:
                tokens.write("0123456789abcdef0123456789abcdef robot R1\n")
            with Serving(scene.text(1), "--tokens", file) as server:
                self.expect("UNAUTHENTICATED", "token", server.address, "R1")
                self.expect("UNAUTHENTICATED", "token", server.address, "R1", token="f" * 32)
                token = "0123456789abcdef0123456789abcdef"
                with robosim.RemoteRobots(server.address, "R1", token=token) as robots:
                    self.assertTrue(robots.step())

    def test_server_that_ends(self):
        with Serving(scene.text(1)) as server:
            robots = robosim.RemoteRobots(server.address, "R1")
            robots.step()
            server.kill()
            with self.assertRaises(robosim.RemoteError) as caught:
                while robots.step():
                    pass
            self.assertEqual(caught.exception.status, "UNAVAILABLE")
            with self.assertRaisesRegex(ValueError, "the connection is closed; make another one"):
                robots.step()

    def test_misuse(self):
        with Serving(scene.text()) as server, robosim.RemoteRobots(server.address, ["R1", "R2"]) as robots:
            robots.commands[1, 1] = np.nan
            with self.assertRaisesRegex(ValueError, r"the command of robot 'R2' \(row 1\) is not finite"):
                robots.step()
            robots.commands = 0
            with self.assertRaisesRegex(ValueError, "no robot has a sensor 'radar'; the sensors are bumper, compass"):
                robots.readings("radar")
            with self.assertRaisesRegex(ValueError, "'heat' measures no points"):
                robots.points("heat")
            with self.assertRaisesRegex(ValueError, "there is no robot 'R3'; this connection drives R1, R2"):
                robots.halt("R3")
            with self.assertRaisesRegex(ValueError, "robot 'R1' has no camera"):
                robots.picture("R1")
            self.assertTrue(robots.step())

    def test_missing_package(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "grpc.py"), "w", encoding="utf-8") as file:
                file.write("raise ImportError('no gRPC here')")
            program = "import robosim\ntry:\n  robosim.RemoteRobots('x', 'y')\nexcept ImportError as error:\n  print(error)"
            path = folder + os.pathsep + os.environ["PYTHONPATH"]
            ended = subprocess.run([sys.executable, "-c", program], env={**os.environ, "PYTHONPATH": path}, text=True,
                                   capture_output=True)
        self.assertEqual(ended.stdout, "robosim.RemoteRobots requires gRPC and protobuf; install the packages python3-grpcio "
                                       "and python3-protobuf, or grpcio and protobuf with pip (no gRPC here)\n")


class ExampleTest(unittest.TestCase):
    def test_drives_both_robots_to_the_end_of_the_run(self):
        example = os.path.join(os.path.dirname(os.environ["ROBOSIM_PAGE"]), "examples", "remote_robots.py")
        with Serving(scene.text(), "--time", "30") as server:
            ended = subprocess.run([sys.executable, example, server.address, "R1", "R2"], text=True, capture_output=True)
            self.assertEqual((ended.stdout, ended.stderr), ("the run is over after step 300\n", ""))
            self.assertGreater(json.loads(server.finish())["driven_m"], 2)


class GeneratedModulesTest(unittest.TestCase):
    def test_are_installed_for_every_service(self):
        from robosim.v1 import control_panel_pb2_grpc, remote_control_pb2_grpc, robots_pb2_grpc, viewing_pb2_grpc
        self.assertTrue(robots_pb2_grpc.RobotsStub and viewing_pb2_grpc.ViewingStub)
        self.assertTrue(control_panel_pb2_grpc.ControlPanelStub and remote_control_pb2_grpc.RemoteControlStub)
        self.assertEqual(v1.RobotsHello.DESCRIPTOR.full_name, "robosim.v1.RobotsHello")


if __name__ == "__main__":
    unittest.main()
