"""Controllers written in Python."""
from collections import namedtuple

Message = namedtuple("Message", "sender text")
Message.__doc__ = "A message that a robot has received: names of robots and texts are str."


class Controller:
    """Control program of one robot, for Simulation(world, controllers={"R1": MyController()}).

    Simulation.fork() copies it by copy.deepcopy(): keep no reference to the robot.
    """

    def step(self, robot):
        """Reads the robot's sensors and commands it; called once per time step.

        robot: robosim.Robot, the same object in each step.
        """
        raise NotImplementedError(f"{type(self).__name__} needs a method step(robot)")
