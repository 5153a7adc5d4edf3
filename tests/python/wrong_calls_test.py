"""Errors of wrong calls name the argument, what it must be, and an example."""
import unittest

import numpy as np

import robosim
import scene


class WrongCallsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.world = scene.world(2)
        cls.simulation = robosim.Simulation(cls.world, controller="none")
        cls.env = robosim.VectorEnv(cls.world, 3)
        cls.team = robosim.ParallelEnv(cls.world)
        cls.env.reset()
        cls.team.reset()

    def assert_refuses(self, error, text, call, *arguments, **keywords):
        with self.subTest(text):
            with self.assertRaises(error) as raised:  # ConfigError is a ValueError
                call(*arguments, **keywords)
            self.assertEqual(str(raised.exception), text)

    def test_of_types(self):
        robot = self.simulation.robot("R1")
        for text, call, *arguments in (
                ('load(): file must be a str or a path, not int; for example file="small_maze"', robosim.World.load, 5),
                ('generate(): kind must be "maze", "cave", "office" or "open", not int; for example kind="maze"',
                 robosim.World.generate, 3),
                ('Simulation(): world must be a World, not str; for example world=robosim.World.load("small_maze")',
                 robosim.Simulation, "small_maze"),
                ("Simulation(): period_s must be a number of seconds in (0, 1], not str; for example period_s=0.1",
                 robosim.Simulation, self.world, 1, "a"),
                ('readings(): kind must be a str, not int; for example kind="sonar"', self.simulation.readings, 5),
                ("place(): x must be a number, not str; for example x=0.5", self.simulation.place, "R1", "a", 0),
                ("drive() requires the argument turn_radps: a number, for example turn_radps=0.5", robot.drive, 1),
                ("drive() takes 3 positional arguments, not 4; its arguments are speed_mps, turn_radps, lateral_mps",
                 robot.drive, 1, 2, 3, 4),
                ('record(): file must be a str or a path, not int; for example file="run.rawlog"', self.simulation.record, 5),
                ('worlds must be a World, a file, a list of them, or a WorldGenerator, not int; for example "small_maze"',
                 robosim.VectorEnv, 5),
                ("num_envs must be a whole number, not float; it must be 1 to 2147483647, for example 8",
                 robosim.VectorEnv, self.world, 2.0),
                ("actions must be an array of numbers of shape (3, 2), not of object; for example np.zeros((3, 2))",
                 self.env.step, None),
                ('actions must be a dict of an action for each agent, not int; for example {"R1": [0.5, 0]}',
                 self.team.step, 5),
                ("x_m must be 2 numbers, not int; for example x_m=(-10, 10)", robosim.WorldBuilder, 5)):
            self.assert_refuses(TypeError, text, call, *arguments)

    def test_of_named_arguments(self):
        self.assert_refuses(TypeError, "Simulation() has no argument 'steps'; its arguments are world, seed, period_s, threads, "
                            "controller, controllers", robosim.Simulation, self.world, steps=4)
        self.assert_refuses(TypeError, 'generate(): types must be a list of str, not list of int, str; for example '
                            'types=["pioneer3dx"]', robosim.World.generate, "maze", types=[3, "scout"])
        self.assert_refuses(TypeError, "columns must be a whole number, not float; for example columns=6",
                            robosim.World.generate, "maze", columns=2.5)
        self.assert_refuses(TypeError, "the weight of the reward 'win' must be a number, not str; for example {\"win\": 0.5}",
                            robosim.VectorEnv, self.world, reward={"win": "a"})

    def test_of_values(self):
        for text, call, arguments in (
                ("the seed is -1; it must be 0 to 2^64 - 1, for example 1", robosim.World.load,
                 {"file": "small_maze", "seed": -1}),
                ("robots is -1; it must be 0 to 1000000, for example 2", robosim.World.generate,
                 {"kind": "maze", "robots": -1}),
                ("threads is 0; it must be 1 to 1024, for example 2", robosim.Simulation,
                 {"world": self.world, "threads": 0}),
                ("the time step is 2.000000 s; it must lie in (0, 1] seconds, for example 0.1", robosim.VectorEnv,
                 {"worlds": self.world, "period_s": 2}),
                ("there are 2 seeds; 3 are required, one for each environment, for example seed=list(range(3))",
                 self.env.reset, {"seed": [1, 2]}),
                ("actions have the shape (2,); it must be (3, 2), for example np.zeros((3, 2))", self.env.step,
                 {"actions": [1, 2]}),
                ("the action of agent 'R1' is not finite; it must be in [-1, 1], for example [0.5, 0]", self.team.step,
                 {"actions": {"R1": [0, np.nan], "R2": [0, 0]}})):
            self.assert_refuses(ValueError, text, call, **arguments)

    def test_leave_other_errors_of_type_alone(self):
        class Broken(robosim.Controller):
            def step(self, robot):
                raise TypeError("own error")

        with self.assertRaisesRegex(robosim.ControllerError, "Broken raised TypeError: own error"):
            robosim.Simulation(self.world, controllers={"R1": Broken()}).step()


if __name__ == "__main__":
    unittest.main()
