"""The pieces of a RoboSim world file, as text. All lengths in metres, angles in radians."""
import math

WALL_COLOR = "0.55 0.46 0.37"
GOLD_COLOR = "1 0.8 0.1"


def number(value):
    return f"{round(value, 4):.10g}"


def color_of(index, saturation=0.75, brightness=0.9):
    """A colour for the index-th robot: hues a golden angle apart, so that adjacent indices differ clearly."""
    hue = index * 0.381966 % 1 * 6
    rest = [abs(hue - 3) - 1, 2 - abs(hue - 2), 2 - abs(hue - 4)]
    return " ".join(number(brightness * (1 - saturation * (1 - min(1, max(0, part))))) for part in rest)


def cube(name, x, y, length, width, height, color=WALL_COLOR, direction=0):
    turned = f" <direction>{number(direction)}</direction>" if direction else ""
    return f"""    <object><shape><primitive><cube>
      <name>{name}</name> <x>{number(x)}</x> <y>{number(y)}</y> <z>{number(height / 2)}</z>{turned}
      <length>{number(length)}</length> <width>{number(width)}</width> <height>{number(height)}</height>
      <color>{color}</color> <hot>0</hot> <stationary>1</stationary>
    </cube></primitive></shape></object>
"""


def cylinder(name, x, y, radius, height, color, hot=0):
    return f"""    <object><shape><primitive><cylinder>
      <name>{name}</name> <x>{number(x)}</x> <y>{number(y)}</y> <z>{number(height / 2)}</z>
      <radius>{number(radius)}</radius> <height>{number(height)}</height>
      <color>{color}</color> <hot>{hot}</hot> <stationary>1</stationary>
    </cylinder></primitive></shape></object>
"""


def gold(x, y):
    return cylinder("Gold", x, y, 0.2, 0.5, GOLD_COLOR, hot=20)


def robots(places, controller, types=("pioneer3dx", "scout")):
    """Robots at (x, y, direction), types in turn; the neighbour of each is the next one."""
    names = [("Pioneer" if i % 2 == 0 else "Scout") + str(i // 2 + 1) for i in range(len(places))]
    text = ""
    for i, (x, y, direction) in enumerate(places):
        neighbour = f"      <neighbour>{names[(i + 1) % len(names)]}</neighbour>\n" if len(names) > 1 else ""
        text += f"""    <object><shape><robot>
      <model>{types[i % 2]}</model>
      <name>{names[i]}</name> <x>{number(x)}</x> <y>{number(y)}</y> <direction>{number(direction)}</direction>
      <color>{color_of(i)}</color>
      <controller>{controller}</controller>
{neighbour}    </robot></shape></object>
"""
    return text


def world(remark, half_width, half_height, objects):
    return f"""<?xml version="1.0"?>
<!-- {remark} -->
<world>
  <surface>
    <type>smooth</type>
    <size>
      <xmin>{number(-half_width)}</xmin> <xmax>{number(half_width)}</xmax>
      <ymin>{number(-half_height)}</ymin> <ymax>{number(half_height)}</ymax>
    </size>
{objects}  </surface>
</world>
"""


def quarter_turn(i):
    return [0, math.pi / 2, math.pi, -math.pi / 2][i % 4]
