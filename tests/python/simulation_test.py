"""Simulations in Python: steps, arrays, commands, messages, saved states, and misuse."""
import gc
import gzip
import os
import signal
import subprocess
import sys
import tempfile
import threading
import unittest

import numpy as np

import robosim
import scene


def driven(robots=2, **options):
    return robosim.Simulation(scene.world(robots), controller="none", **options)


class InterventionTest(unittest.TestCase):
    def test_places_adds_changes_and_removes_as_the_recording_repeats(self):
        with tempfile.TemporaryDirectory() as folder:
            world = os.path.join(folder, "scene.xml")
            with open(world, "w") as file:
                file.write(scene.text())
            rawlog = os.path.join(folder, "run.rawlog")
            with robosim.Simulation(robosim.World.load(world), controller="wander") as simulation:
                simulation.record(rawlog)
                simulation.step(5)
                simulation.place("R2", 1, 3, heading=1.5)
                self.assertEqual(simulation.poses[1].tolist(), [1, 3, 1.5])
                simulation.place("Gold", 2, -2)
                simulation.add_box("box", 3, 0, 0.5, 1, color=(1, 0, 0))
                simulation.add_cylinder("pillar", -3, 0, 0.3)
                simulation.step(5)
                simulation.change("box", heat_celsius=30, height_m=2)
                simulation.remove("pillar")
                simulation.set_activity("R1", "halted")
                simulation.intervene('<communication><range>5</range></communication>')
                self.assertEqual([body.name for body in simulation.objects], ["Gold", "box"])
                simulation.step(20)
                self.assertIsNone(simulation.outcome)
                simulation.end("done", "all is arranged")
                self.assertEqual(simulation.outcome, "done")
            check = subprocess.run([os.path.join(os.environ["ROBOSIM_PREFIX"], "bin", "robosim"), "replay", "--check", world, rawlog],
                                   capture_output=True, text=True)
            self.assertEqual((check.returncode, check.stdout.split(",")[0]), (0, "The same run: 30 steps"),
                             check.stdout + check.stderr)

    def test_adds_robots_as_the_recording_repeats(self):
        with tempfile.TemporaryDirectory() as folder:
            world = os.path.join(folder, "scene.xml")
            with open(world, "w") as file:
                file.write(scene.text())
            rawlog = os.path.join(folder, "run.rawlog")
            with robosim.Simulation(robosim.World.load(world), controller="wander") as simulation:
                count = len(simulation.robots)
                simulation.record(rawlog)
                simulation.step(5)
                poses = simulation.poses
                before = simulation.save()
                simulation.add_robot("New", "scout", 1, 3, heading=1.5)
                self.assertEqual(len(poses), count)
                self.assertEqual([robot.name for robot in simulation.robots][count:], ["New"])
                self.assertEqual(simulation.poses[count].tolist(), [1, 3, 1.5])
                with self.assertRaises(ValueError) as raised:
                    simulation.add_robot("New", "scout", -1, 3)
                self.assertIn("named 'New' already", str(raised.exception))
                simulation.step(30)
                self.assertNotEqual(simulation.poses[count].tolist(), [1, 3, 1.5])
                saved, digest = simulation.save(), simulation.digest
                simulation.stop_recording()
                simulation.restore(before)
                self.assertEqual(len(simulation.robots), count)
                simulation.step(2)
                simulation.restore(saved)
                self.assertEqual((len(simulation.robots), simulation.digest), (count + 1, digest))
                self.assertEqual(simulation.fork().digest, digest)
            check = subprocess.run([os.path.join(os.environ["ROBOSIM_PREFIX"], "bin", "robosim"), "replay", "--check", world, rawlog],
                                   capture_output=True, text=True)
            self.assertEqual((check.returncode, check.stdout.split(",")[0]), (0, "The same run: 35 steps"),
                             check.stdout + check.stderr)

    def test_says_what_is_wrong(self):
        with driven() as simulation:
            for call, fault in (
                    (lambda: simulation.place("R3", 0, 0), "'R3' is not the name of a robot or an object; did you mean R1?"),
                    (lambda: simulation.place("R1", 4, 0.3), "'R1' would overlap 'Gold'; choose another place"),
                    (lambda: simulation.add_box("soft", 5, 5, 1, 1, friction=0.2),
                     "friction and restitution are of objects that robots push; give mass_kg, too"),
                    (lambda: simulation.add_cylinder("Gold", 5, 5, 1),
                     "there is a robot or an object named 'Gold' already; use another name"),
                    (lambda: simulation.change("Gold"),
                     "<change>: changes nothing; give hot, color, height, reflectivity, light or fiducial")):
                with self.assertRaises(ValueError) as raised:
                    call()
                self.assertEqual(str(raised.exception), fault)

    def test_changes_what_a_fork_and_a_restored_state_continue_with(self):
        with driven() as simulation:
            before = simulation.save()
            simulation.place("Gold", 1, 5)
            fork = simulation.fork()
            saved = simulation.save()
            simulation.restore(before)
            self.assertEqual(simulation.objects[0].pose[0], 4)
            simulation.restore(saved)
            self.assertEqual(simulation.objects[0].pose[0], 1)
            for run in (simulation, fork):
                run.step(10)
            self.assertEqual(simulation.digest, fork.digest)


class SwarmTest(unittest.TestCase):
    def test_robots_sense_floor_lights_and_leds_as_the_recording_repeats(self):
        builder = robosim.WorldBuilder(x_m=(-2, 2), y_m=(-2, 2))
        builder.cylinder("nest", 0, 0, radius_m=0.5, base_m=-0.01, height_m=0.01, color=(0.2, 0.2, 0.2))
        builder.cylinder("lamp", 0, 1.2, radius_m=0.01, base_m=0.19, height_m=0.02, color=(1, 1, 0), light_cd=4, fiducial=7)
        builder.robot("footbot", "A", 0, 0).robot("footbot", "B", 1, 0)
        with tempfile.TemporaryDirectory() as folder:
            world, rawlog = os.path.join(folder, "swarm.xml"), os.path.join(folder, "run.rawlog")
            with open(world, "w", encoding="utf-8") as file:
                file.write(builder.to_xml())
            with robosim.Simulation(robosim.World.load(world), controller="none") as simulation:
                simulation.record(rawlog)
                self.assertEqual((simulation.objects[1].light_cd, simulation.objects[1].fiducial), (4, 7))
                first, second = simulation.robot("A"), simulation.robot("B")
                second.set_leds((1, 0, 0))
                self.assertEqual(second.leds, (1, 0, 0))
                simulation.step()
                self.assertAlmostEqual(first.readings("ground")[0], 0.2, places=6)
                self.assertEqual(second.readings("ground")[0], 1)
                self.assertEqual(first.readings("omni_camera")[:6:3].tolist(), [0xff0000, 0xffff00])
                brightest = first.readings("light").argmax()
                self.assertIn(brightest, (5, 6), "7.5° to either side of straight left")
                simulation.change("lamp", light_cd=0)
                simulation.change("nest", color=(0, 0, 0))
                second.drive(0.1, 0)
                simulation.step(5)
                self.assertEqual(first.readings("light").max(), 0)
                self.assertEqual(first.readings("ground")[0], 0)
                self.assertEqual(first.readings("omni_camera")[0], 0xff0000)
                self.assertEqual(first.readings("omni_camera")[3], -1)
                simulation.stop_recording()
            check = subprocess.run([os.path.join(os.environ["ROBOSIM_PREFIX"], "bin", "robosim"), "replay", "--check", world, rawlog],
                                   capture_output=True, text=True)
            self.assertEqual((check.returncode, check.stdout.split(",")[0]), (0, "The same run: 6 steps"),
                             check.stdout + check.stderr)


class CameraHeadTest(unittest.TestCase):
    def test_moves_with_limited_speed_as_the_recording_repeats(self):
        builder = robosim.WorldBuilder(x_m=(-2, 2), y_m=(-2, 2))
        builder.robot("p3dx_ptz", "A", 0, 0).robot("footbot", "B", 1.5, 0)
        builder.cylinder("post", 0.12, 1.5, radius_m=0.1, height_m=1, color=(1, 0, 0))
        with tempfile.TemporaryDirectory() as folder:
            world, rawlog = os.path.join(folder, "camera.xml"), os.path.join(folder, "run.rawlog")
            with open(world, "w", encoding="utf-8") as file:
                file.write(builder.to_xml())
            with robosim.Simulation(robosim.World.load(world), controller="none") as simulation:
                simulation.record(rawlog)
                robot, other = simulation.robot("A"), simulation.robot("B")
                self.assertEqual(robot.camera_aim, (0, 0, 1))
                self.assertIsNone(other.camera_aim)
                robot.aim_camera(np.pi / 2, -0.1)
                robot.zoom_camera(2)
                robot.limit_camera_speed(1, 0)
                simulation.step(5)
                for value, expected in zip(robot.camera_aim, (0.5, -0.1, 2)):
                    self.assertAlmostEqual(value, expected)
                np.testing.assert_allclose(robot.readings("ptz"), (0.5, -0.1, 2), rtol=1e-6)
                robot.limit_camera_speed(0, 0)
                simulation.step(11)
                self.assertEqual(robot.camera_aim[0], np.pi / 2)
                picture = robot.image.astype(int)
                is_red = (picture[..., 0] > 100) & (picture[..., 1] < 60)
                self.assertTrue(is_red[120, 160], "the red post, which is to the left of the robot")
                self.assertFalse(is_red[120, 40])
                robot.stop_camera()
                self.assertRaises(ValueError, robot.aim_camera, float("nan"), 0)
                simulation.step()
                simulation.stop_recording()
            check = subprocess.run([os.path.join(os.environ["ROBOSIM_PREFIX"], "bin", "robosim"), "replay", "--check", world, rawlog],
                                   capture_output=True, text=True)
            self.assertEqual((check.returncode, check.stdout.split(",")[0]), (0, "The same run: 17 steps"),
                             check.stdout + check.stderr)


class StepTest(unittest.TestCase):
    def test_advances_time(self):
        with driven(period_s=0.5) as simulation:
            simulation.step(3)
            simulation.step()
            self.assertEqual((simulation.step_count, simulation.time_s, simulation.period_s), (4, 2.0, 0.5))

    def test_runs_the_worlds_controllers_for_any_number_of_threads(self):
        world = robosim.World.generate("maze", columns=4, rows=4, robots=4, controller="wander")
        digests = set()
        for threads in (1, 2, 3):
            with robosim.Simulation(world, threads=threads) as simulation:
                simulation.step(50)
                digests.add(simulation.digest)
        self.assertEqual(len(digests), 1)
        with robosim.Simulation(world, controller="wall_follower") as simulation:
            simulation.step(50)
            self.assertNotIn(simulation.digest, digests)

    def test_lets_other_threads_run_refuses_them_and_is_interrupted_by_a_signal(self):
        simulation = driven()
        refusals = []

        def use_and_interrupt():
            while not refusals:
                try:
                    simulation.time_s
                except RuntimeError as error:
                    refusals.append(str(error))
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=use_and_interrupt)
        thread.start()
        with self.assertRaises(KeyboardInterrupt):
            simulation.step(10**12)
        thread.join()
        self.assertIn("another thread is running a step", refusals[0])
        steps = simulation.step_count
        simulation.step()
        self.assertEqual(simulation.step_count, steps + 1)


class ArraysTest(unittest.TestCase):
    def test_poses_are_a_view_that_follows_the_steps(self):
        simulation = driven()
        poses = simulation.poses
        self.assertEqual((poses.shape, poses.dtype), ((2, 3), np.float64))
        np.testing.assert_array_equal(poses, [[0, 0, 0], [0, 1, 0]])
        simulation.commands = [[0.5, 0], [0, 0]]
        simulation.step(20)
        self.assertGreater(poses[0, 0], 0.5)
        self.assertEqual(poses[1, 0], 0)
        self.assertTrue(np.shares_memory(poses, simulation.poses))
        with self.assertRaisesRegex(ValueError, "read-only"):
            poses[0, 0] = 1

    def test_arrays_remain_valid_without_their_simulation(self):
        simulation = driven()
        poses = simulation.poses
        simulation.close()
        del simulation
        gc.collect()
        np.testing.assert_array_equal(poses, [[0, 0, 0], [0, 1, 0]])

    def test_reads_ranges_of_all_robots(self):
        simulation = driven()
        sonar = simulation.readings("sonar")
        self.assertEqual((sonar.shape, sonar.dtype), ((2, 16), np.float32))
        self.assertAlmostEqual(np.nanmin(sonar[0]), np.min(simulation.robot("R1").sonar), places=6)
        into = np.empty((2, 16), np.float32)
        self.assertIs(simulation.readings("sonar", out=into), into)
        np.testing.assert_array_equal(into, sonar)

    def test_rows_of_robots_without_the_sensor_are_nan(self):
        share = os.path.join(os.environ["ROBOSIM_PREFIX"], "share", "robosim")
        world = robosim.World.load(share + "/worlds/opho2_1.xml")
        with robosim.Simulation(world, controller="none") as simulation:
            sensors = [{sensor.kind for sensor in robot.sensors} for robot in world.robots]
            laser = simulation.readings("laser")
            for row, kinds in zip(laser, sensors):
                self.assertEqual(np.isnan(row).all(), "laser" not in kinds)

    def test_reports_unknown_kinds_and_unsuitable_arrays(self):
        simulation = driven()
        with self.assertRaisesRegex(ValueError, "robot 'R1' cannot observe 'radar'; observations may be "):
            simulation.readings("radar")
        with self.assertRaisesRegex(ValueError, r"readings have the shape \(2, 3\); it must be \(2, 16\)"):
            simulation.readings("sonar", out=np.empty((2, 3), np.float32))
        with self.assertRaisesRegex(TypeError, "readings are of type float64; it must be float32"):
            simulation.readings("sonar", out=np.empty((2, 16)))
        with self.assertRaisesRegex(ValueError, "contiguous array that can be written"):
            simulation.readings("sonar", out=np.empty((2, 32), np.float32)[:, ::2])


class CommandsTest(unittest.TestCase):
    def test_refuses_other_shapes_types_and_values(self):
        simulation = driven()
        with self.assertRaisesRegex(ValueError, r"commands have the shape \(2,\); it must be \(2, 2\)"):
            simulation.commands = [1, 2]
        with self.assertRaisesRegex(TypeError, "commands must be an array of numbers, not of <U1"):
            simulation.commands = [["a", "b"], ["c", "d"]]
        with self.assertRaisesRegex(ValueError, r"the command of robot 'R2' \(row 1\) is not finite"):
            simulation.commands = [[0.1, 0], [0, np.nan]]
        np.testing.assert_array_equal(simulation.commands, np.zeros((2, 2)))

    def test_are_for_robots_without_controller(self):
        world = scene.world(2)
        with robosim.Simulation(world, controller="wander", controllers={"R2": "none"}) as simulation:
            simulation.commands = [[9, 9], [0.25, 0.125]]
            simulation.step()
            np.testing.assert_array_equal(simulation.commands[1], [0.25, 0.125])
        with robosim.Simulation(world, controller="wander") as simulation:
            with self.assertRaisesRegex(ValueError, "every robot has a controller"):
                simulation.commands = np.zeros((2, 2))
            with self.assertRaisesRegex(ValueError, "robot 'R1' has a controller, which commands it"):
                simulation.robot("R1").drive(1, 0)

    def test_messages_arrive_in_the_next_step(self):
        simulation = driven()
        simulation.send("R1", "R2", "grüße")
        simulation.step()
        self.assertEqual(simulation.inbox("R2"), [robosim.Message("R1", "grüße")])
        self.assertEqual(simulation.inbox("R1"), [])
        simulation.step()
        self.assertEqual(simulation.inbox("R2"), [])
        simulation.broadcast("R2", "all")
        simulation.step()
        self.assertEqual(simulation.inbox("R1"), [robosim.Message("R2", "all")])
        self.assertEqual(simulation.inbox("R2"), [])
        with self.assertRaisesRegex(ValueError, "R9"):
            simulation.send("R1", "R9", "")
        with self.assertRaisesRegex(ValueError, "there is no robot 'R8'; the world has R1, R2"):
            simulation.inbox("R8")


class SavedStateTest(unittest.TestCase):
    def test_a_restored_run_continues_bit_for_bit(self):
        simulation = driven()
        simulation.commands = [[0.5, 0.3], [0.4, -0.2]]
        simulation.step(10)
        state = simulation.save()
        simulation.step(10)
        digest = simulation.digest
        simulation.restore(state)
        self.assertEqual(simulation.step_count, 10)
        simulation.step(10)
        self.assertEqual(simulation.digest, digest)

    def test_a_robot_that_has_halted_meanwhile_obeys_again(self):
        simulation = driven()
        robot = simulation.robot("R1")
        robot.drive(0.3, 0.1)
        simulation.step(5)
        state = simulation.save()
        simulation.step(5)
        digest = simulation.digest
        simulation.restore(state)
        robot.halt()
        simulation.step(5)
        self.assertNotEqual(simulation.digest, digest)
        simulation.restore(state)
        simulation.step(5)
        self.assertEqual(simulation.digest, digest)
        robot.drive(0, 0.5)
        self.assertEqual(simulation.commands[0].tolist(), [0, 0.5])

    def test_a_recording_after_it_has_the_outcome_of_the_restored_run(self):
        simulation = driven()
        state = simulation.save()
        for name in ("R1", "R2"):
            simulation.robot(name).halt(found=True)
        simulation.step()
        self.assertTrue(simulation.all_halted)
        simulation.restore(state)
        self.assertFalse(simulation.all_halted)
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "run.rawlog")
            simulation.record(file)
            simulation.step(5)
            simulation.stop_recording()
            with gzip.open(file) as packed:
                recording = packed.read()
        for unset in (rb"gold_found_by", rb"all_halted_time_s"):
            self.assertRegex(recording, unset + rb'": *null')

    def test_refuses_other_bytes_and_changes_nothing(self):
        simulation = driven()
        state = simulation.save()
        other = driven(3)
        for bad in (b"", state[:-1], other.save()):
            with self.assertRaises(robosim.ConfigError):
                simulation.restore(bad)
        self.assertEqual(simulation.save(), state)

    def test_a_fork_is_independent_and_equal(self):
        world = robosim.World.generate("maze", columns=4, rows=4, robots=3, controller="wander")
        simulation = robosim.Simulation(world, controllers={world.robots[1].name: "none"})
        simulation.step(20)
        fork = simulation.fork()
        fork.step(20)
        self.assertEqual(simulation.step_count, 20)
        simulation.step(20)
        self.assertEqual(fork.digest, simulation.digest)


class RecordingTest(unittest.TestCase):
    def test_a_recording_appears_when_it_is_complete(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "run.rawlog")
            with driven() as simulation:
                simulation.record(file)
                simulation.step(5)
                self.assertTrue(simulation.is_recording)
                self.assertFalse(os.path.exists(file))
                with self.assertRaisesRegex(ValueError, "is being recorded"):
                    simulation.record(file)
            self.assertTrue(os.path.exists(file))

    def test_reports_a_file_that_cannot_be_written(self):
        with self.assertRaises(robosim.ConfigError):
            driven().record("/missing/run.rawlog")


class MisuseTest(unittest.TestCase):
    def test_use_after_close_is_an_error(self):
        simulation = driven()
        robot = simulation.robot("R1")
        simulation.close()
        simulation.close()
        self.assertTrue(simulation.closed)
        for use in (simulation.step, simulation.save, simulation.fork, lambda: simulation.poses,
                    lambda: simulation.readings("sonar"), lambda: robot.sonar):
            with self.assertRaisesRegex(ValueError, "the simulation is closed"):
                use()

    def test_reports_invalid_arguments(self):
        world = scene.world()
        with self.assertRaisesRegex(robosim.ConfigError, "wonder"):
            robosim.Simulation(world, controller="wonder")
        with self.assertRaisesRegex(ValueError, "there is no robot 'R7'; the world has R1, R2"):
            robosim.Simulation(world, controllers={"R7": "wander"})
        with self.assertRaisesRegex(TypeError, "the controller of robot 'R1' must be the name of a controller"):
            robosim.Simulation(world, controllers={"R1": 5})
        with self.assertRaisesRegex(ValueError, r"period_s is 0.*; it must be a number of seconds in \(0, 1\]"):
            robosim.Simulation(world, period_s=0)
        with self.assertRaisesRegex(ValueError, "the number of steps is -1; it must be at least 0"):
            driven().step(-1)
        with self.assertRaisesRegex(robosim.ConfigError, "has no robots; add at least one"):
            robosim.Simulation(scene.world(0))


class ArgumentTest(unittest.TestCase):
    def test_errors_of_whole_numbers_name_argument_and_range(self):
        world = scene.world(1)
        simulation = robosim.Simulation(world, controller="none")
        for call, error, text in (
                (lambda: robosim.World.generate("maze", seed=-1), ValueError,
                 r"the seed is -1; it must be 0 to 2\^64 - 1"),
                (lambda: robosim.Simulation(world, seed=2**64), ValueError, r"it must be 0 to 2\^64 - 1"),
                (lambda: robosim.World.parse("", seed=1.5), TypeError, "the seed must be a whole number, not float"),
                (lambda: simulation.step(1.0), TypeError, "the number of steps must be a whole number, not float")):
            with self.assertRaisesRegex(error, text):
                call()

    def test_objects_without_constructor_raise(self):
        for of in (robosim.Simulation, robosim.World, robosim.Robot, robosim.WorldGenerator, robosim.RobotInfo,
                   robosim.SensorInfo, robosim.WorldObject):
            empty = of.__new__(of)
            for name in (name for name, value in vars(of).items() if isinstance(value, property)):
                with self.subTest(of.__name__ + "." + name), self.assertRaises((TypeError, RuntimeError)):
                    getattr(empty, name)


class ExitTest(unittest.TestCase):
    def test_a_daemon_thread_in_a_step_does_not_abort_the_interpreter(self):
        program = """
import threading
import robosim
world = robosim.World.generate("maze", robots=4)
simulation = robosim.Simulation(world, controller="wander")
env = robosim.VectorEnv(world)
env.reset()
begun = threading.Semaphore(0)
def drive():
    for _ in range(10):
        env.step(env.action_space.sample())
    begun.release()
    while True:
        env.step(env.action_space.sample())
def simulate():
    begun.release()
    simulation.step(10**9)
for target in (drive, simulate):
    threading.Thread(target=target, daemon=True).start()
    begun.acquire()
"""
        for _ in range(3):
            ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
            self.assertEqual((ended.returncode, ended.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
