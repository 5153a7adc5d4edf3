"""Controllers written in Python."""
import unittest

import numpy as np

import robosim
import scene


class Forward(robosim.Controller):
    def __init__(self):
        self.steps = 0

    def step(self, robot):
        self.steps += 1
        robot.drive(0.2, 0.1)


class ControllerTest(unittest.TestCase):
    def test_drives_its_robot(self):
        controller = Forward()
        with robosim.Simulation(scene.world(2), controller="none", controllers={"R1": controller}) as simulation:
            simulation.step(5)
            self.assertEqual(controller.steps, 5)
            np.testing.assert_array_equal(simulation.commands, [[0.2, 0.1], [0, 0]])

    def test_reads_what_its_robot_measures(self):
        seen = {}

        class Reader(robosim.Controller):
            def step(self, robot):
                seen.update(name=robot.name, time_s=robot.time_s, sonar=robot.sonar, robots=robot.robots(),
                            odometry=robot.odometry, points=robot.points("sonar"), image=robot.image)

        with robosim.Simulation(scene.world(2), controller="none", controllers={"R1": Reader()}) as simulation:
            simulation.step(3)
        self.assertEqual((seen["name"], seen["robots"]), ("R1", ["R1", "R2"]))
        self.assertAlmostEqual(seen["time_s"], 0.2)
        self.assertEqual((seen["sonar"].dtype, seen["sonar"].shape), (np.float32, (16,)))
        self.assertEqual(seen["points"].shape, (16, 3))
        self.assertEqual(seen["odometry"], (0, 0, 0, 0, 0))
        self.assertIsNone(seen["image"])

    def test_exchanges_messages(self):
        received = []

        class Sender(robosim.Controller):
            def step(self, robot):
                if robot.step_count == 0:
                    robot.broadcast("all")
                    robot.send("R2", "you")

        class Receiver(robosim.Controller):
            def step(self, robot):
                received.extend(robot.inbox)

        controllers = {"R1": Sender(), "R2": Receiver()}
        with robosim.Simulation(scene.world(3), controller="none", controllers=controllers) as simulation:
            simulation.step(3)
        self.assertEqual(received, [("R1", "all"), ("R1", "you")])

    def test_wins_at_the_gold(self):
        class Winner(robosim.Controller):
            def step(self, robot):
                robot.drive(1, 0)
                robot.check_win()

        with robosim.Simulation(scene.world(1), controllers={"R1": Winner()}) as simulation:
            while not simulation.all_halted:
                simulation.step()
            self.assertEqual(simulation.winner, "R1")
            self.assertLess(simulation.time_s, 30)

    def test_an_exception_names_robot_and_controller_and_leaves_the_simulation_usable(self):
        class Faulty(robosim.Controller):
            def step(self, robot):
                if robot.step_count == 2:
                    raise KeyError("lost")

        controller = Faulty()
        with robosim.Simulation(scene.world(2), controller="none", controllers={"R2": controller}) as simulation:
            with self.assertRaisesRegex(robosim.ControllerError,
                                        "robot 'R2': its controller Faulty raised KeyError: 'lost'") as raised:
                simulation.step(10)
            self.assertIsInstance(raised.exception.__cause__, KeyError)
            self.assertEqual(simulation.step_count, 2)
            controller.step = lambda robot: None
            simulation.step(3)
            self.assertEqual(simulation.step_count, 5)

    def test_interruption_is_not_a_fault_of_the_controller(self):
        class Interrupting(robosim.Controller):
            def step(self, robot):
                raise KeyboardInterrupt

        with robosim.Simulation(scene.world(1), controllers={"R1": Interrupting()}) as simulation:
            with self.assertRaises(KeyboardInterrupt):
                simulation.step()

    def test_refuses_commands_that_are_not_finite_and_changes_of_the_simulation(self):
        for fault in (lambda simulation, robot: robot.drive(float("nan"), 0),
                      lambda simulation, robot: simulation.step(),
                      lambda simulation, robot: simulation.close(),
                      lambda simulation, robot: simulation.fork()):
            class Faulty(robosim.Controller):
                def step(self, robot):
                    fault(simulation, robot)

            with robosim.Simulation(scene.world(1), controllers={"R1": Faulty()}) as simulation:
                with self.assertRaisesRegex(robosim.ControllerError, "is not finite|within a step"):
                    simulation.step()
                self.assertEqual(simulation.step_count, 0)

    def test_a_fork_has_copies_of_the_controllers(self):
        controller = Forward()
        with robosim.Simulation(scene.world(1), controllers={"R1": controller}) as simulation:
            simulation.step(2)
            with simulation.fork() as fork:
                fork.step(3)
                self.assertEqual(controller.steps, 2)
                simulation.step(3)
                self.assertEqual(fork.digest, simulation.digest)

    def test_a_controller_without_step_is_reported(self):
        class Empty(robosim.Controller):
            pass

        with robosim.Simulation(scene.world(1), controllers={"R1": Empty()}) as simulation:
            with self.assertRaisesRegex(robosim.ControllerError, "Empty needs a method step"):
                simulation.step()


if __name__ == "__main__":
    unittest.main()
