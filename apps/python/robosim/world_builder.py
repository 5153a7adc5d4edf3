"""Worlds built object by object."""
import xml.etree.ElementTree as ET

from ._arguments import refuse, require_whole
from ._robosim import World


def _numbers(name, values, count, example):
    """A sequence of so many numbers."""
    try:
        numbers = [float(value) for value in values]
    except (TypeError, ValueError):
        refuse(name, values, f"{count} numbers", f"{name}={example}")
    if len(numbers) != count:
        raise ValueError(f"{name} has {len(numbers)} numbers; it must have {count}, for example {name}={example}")
    return numbers


def _add(parent, tag, value=None):
    element = ET.SubElement(parent, tag)
    if value is not None:
        element.text = repr(float(value)) if isinstance(value, (int, float)) else str(value)
    return element


class WorldBuilder:
    """Builds a World from objects and robots, in metres and radians, in the world's frame.

        builder = robosim.WorldBuilder(x_m=(0, 10), y_m=(0, 6))
        builder.box("wall", 5, 3, length_m=4, width_m=0.1)
        builder.cylinder("gold", 9, 5, radius_m=0.2, heat_celsius=20, color=(1, 0.8, 0))
        builder.robot("pioneer3dx", "R1", 1, 1, controller="wander")
        world = builder.build()

    Methods return the builder, so that calls can be chained. Values are checked by build().
    """

    def __init__(self, x_m=(-10, 10), y_m=(-10, 10)):
        """x_m, y_m: the surface's lower and upper bound."""
        self._world = ET.Element("world")
        self._surface = _add(self._world, "surface")
        size = _add(self._surface, "size")
        for axis, bounds in (("x", x_m), ("y", y_m)):
            low, high = _numbers(axis + "_m", bounds, 2, (-10, 10))
            _add(size, axis + "min", low)
            _add(size, axis + "max", high)

    def _body(self, tag, name, x_m, y_m, dimensions, height_m, base_m, color, heading_rad, heat_celsius,
              light_cd, fiducial):
        primitive = _add(_add(_add(self._surface, "object"), "shape"), "primitive")
        body = _add(primitive, tag)
        values = {"name": name, "x": x_m, "y": y_m, "z": base_m + height_m / 2, **dimensions, "height": height_m,
                  "direction": heading_rad, "color": " ".join(repr(float(part)) for part in color),
                  "hot": heat_celsius, "stationary": "1"}
        if light_cd:
            values["light"] = light_cd
        if fiducial:
            values["fiducial"] = str(int(fiducial))
        for setting, value in values.items():
            _add(body, setting, value)
        return self

    def box(self, name, x_m, y_m, *, length_m, width_m, height_m=0.6, base_m=0, heading_rad=0, color=(0.5, 0.5, 0.5),
            heat_celsius=0, light_cd=0, fiducial=0):
        """Adds a stationary box around (x_m, y_m); its length is along its heading. base_m: height of its underside.

        With base_m=-0.01, height_m=0.01 it is an area painted on the floor. light_cd: its luminous intensity;
        fiducial: number of its mark.
        """
        return self._body("cube", name, x_m, y_m, {"length": length_m, "width": width_m}, height_m, base_m, color,
                          heading_rad, heat_celsius, light_cd, fiducial)

    def cylinder(self, name, x_m, y_m, *, radius_m, height_m=0.6, base_m=0, color=(0.5, 0.5, 0.5), heat_celsius=0,
                 light_cd=0, fiducial=0):
        """Adds a stationary cylinder; otherwise as box(). A hot one is gold."""
        return self._body("cylinder", name, x_m, y_m, {"radius": radius_m}, height_m, base_m, color, 0, heat_celsius,
                          light_cd, fiducial)

    def _robot_in(self, parent, type, name, controller, parameters):
        robot = _add(parent, "robot")
        _add(robot, "model", type)
        _add(robot, "name", name)
        if controller:
            _add(robot, "controller").attrib.update({"name": controller}, **{k: repr(v) for k, v in parameters.items()})
        elif parameters:
            raise ValueError(f"parameters {sorted(parameters)} without a controller; name the controller")
        return robot

    def robot(self, type, name, x_m, y_m, heading_rad=0, *, controller="", **parameters):
        """Adds a robot of a type, such as "pioneer3dx". parameters: of its controller (`robosim controllers`)."""
        robot = self._robot_in(_add(_add(self._surface, "object"), "shape"), type, name, controller, parameters)
        for setting, value in (("x", x_m), ("y", y_m), ("direction", heading_rad)):
            _add(robot, setting, value)
        return self

    def scatter_robots(self, count, type, name, *, pattern="uniform", controller="", area=None, gap_m=0, **parameters):
        """Adds robots name1, name2, … at random places without overlap, which depend on the seed of build().

        pattern: "uniform", "free" or "grid". area: (x_min, x_max, y_min, y_max) [m]; None: the surface.
        gap_m: minimum distance to everything else.
        """
        require_whole("count", count, 0, 1_000_000, 5)
        scatter = _add(self._surface, "scatter")
        scatter.attrib.update(count=str(int(count)), pattern=pattern, gap=repr(float(gap_m)))
        if area is not None:
            for setting, value in zip(("xmin", "xmax", "ymin", "ymax"), _numbers("area", area, 4, (0, 10, 0, 6))):
                scatter.set(setting, repr(value))
        self._robot_in(scatter, type, name, controller, parameters)
        return self

    def to_xml(self):
        """The text of the world file."""
        ET.indent(self._world)
        return ET.tostring(self._world, encoding="unicode")

    def build(self, *, name="world", folder=".", seed=1):
        """The world. folder: in which own robot types are found. Raises ConfigError with all faults found."""
        return World.parse(self.to_xml(), folder=folder, name=name, seed=seed)
