"""Recordings: MRPT rawlogs as arrays."""
from collections.abc import Mapping

from . import _robosim
from ._errors import ConfigError


class Recording(Mapping):
    """All observations of a rawlog as arrays, by the names of `robosim export RUN.rawlog run.npz` (doc/rawlog.md).

    recording["R1/sonar"] is float64 of shape (rows, columns); "R1/sonar/columns" names the columns with their units,
    "R1/sonar/step" and "R1/sonar/time_s" have a number for each row. Columns of texts are lists of str.

    damage: what was not read, and why: the end of a file that is cut off, or damaged parts; None for a complete file.
    """

    def __init__(self, arrays, sensors, damage):
        self._arrays = arrays
        self._sensors = {robot: tuple(of_robot) for robot, of_robot in sensors.items()}
        self.damage = damage

    @property
    def robots(self):
        """Names of the robots, in the recording's order; '' of observations without one."""
        return tuple(self._sensors)

    def sensors(self, robot):
        """Labels of the observations of a robot: 'sonar', 'GROUND_TRUTH', 'STATUS', ..."""
        if robot not in self._sensors:
            raise ValueError(f"the recording has no robot '{robot}'; it has {', '.join(self._sensors)}")
        return self._sensors[robot]

    def readings(self, robot, sensor):
        """Values of a sensor: float64, shape (rows, columns)."""
        if sensor not in self.sensors(robot) or self._label(robot, sensor) not in self._arrays:
            raise ValueError(f"robot '{robot}' has no recorded numbers of '{sensor}'; it has "
                             f"{', '.join(self.sensors(robot))}")
        return self._arrays[self._label(robot, sensor)]

    def times_s(self, robot, sensor="GROUND_TRUTH"):
        """Time of each row of a sensor [s]: float64, shape (rows,)."""
        self.readings(robot, sensor)
        return self._arrays[self._label(robot, sensor) + "/time_s"]

    def poses(self, robot):
        """True poses: float64, shape (rows, 3): x, y [m], heading [rad], world frame."""
        return self._columns(robot, "GROUND_TRUTH", ("x_m", "y_m", "heading_rad"))

    def odometry(self, robot):
        """Poses by odometry since the start: float64, shape (rows, 3): x, y [m], heading [rad]."""
        return self._columns(robot, "odometry", ("x_m", "y_m", "heading_rad"))

    def scans(self, robot, sensor="laser"):
        """Range of each beam of a laser scanner [m]: float64, shape (rows, beams); NaN without an echo."""
        return self._ranges(robot, sensor)

    def sonar(self, robot, sensor="sonar"):
        """Range of each sonar [m]: float64, shape (rows, beams); NaN without an echo."""
        return self._ranges(robot, sensor)

    def heat(self, robot, sensor="heat"):
        """Readings of a heat sensor [°C]: float64, shape (rows,)."""
        return self.readings(robot, sensor)[:, 0]

    def __getitem__(self, name):
        return self._arrays[name]

    def __iter__(self):
        return iter(self._arrays)

    def __len__(self):
        return len(self._arrays)

    def __repr__(self):
        return f"<Recording of {len(self.robots)} robots, {len(self)} arrays>"

    @staticmethod
    def _label(robot, sensor):
        return f"{robot}/{sensor}" if robot else sensor

    def _columns(self, robot, sensor, names):
        values = self.readings(robot, sensor)
        columns = self._arrays[self._label(robot, sensor) + "/columns"]
        return values[:, [columns.index(name) for name in names]]

    def _ranges(self, robot, sensor):
        values = self.readings(robot, sensor)
        columns = self._arrays[self._label(robot, sensor) + "/columns"]
        return values[:, [i for i, name in enumerate(columns) if name.startswith("range_")]]


def read_rawlog(file, allow_damage=False):
    """Reads a rawlog recorded by RoboSim or another program, and returns a Recording.

    Raises ConfigError for a file that is no rawlog, and for a damaged one, unless allow_damage is set: then its readable
    entries are returned. A file that is only cut off, as by a killed program, is read up to its end (Recording.damage).
    """
    arrays, sensors, damage, is_damaged = _robosim._read_rawlog(file)
    if is_damaged and not allow_damage:
        raise ConfigError(f"{damage}; allow_damage=True returns the readable entries")
    return Recording(arrays, sensors, damage)
