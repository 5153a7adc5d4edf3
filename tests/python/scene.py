"""Worlds for tests."""
import robosim

_ROBOT = """<object><shape><robot><model>pioneer3dx</model><name>{name}</name><x>0</x><y>{y}</y><direction>0</direction>
</robot></shape></object>"""


def text(robots=2):
    """A square of 20 m with gold at (4, 0) and robots R1, R2, ... at (0, 0), (0, 1), ..., which head towards +x."""
    placed = "".join(_ROBOT.format(name=f"R{i + 1}", y=i) for i in range(robots))
    return f"""<world><surface>
<size><xmin>-10</xmin><xmax>10</xmax><ymin>-10</ymin><ymax>10</ymax></size>
<object><shape><primitive><cylinder><name>Gold</name><x>4</x><y>0</y><z>0.25</z><radius>0.2</radius>
<height>0.5</height><color>1 0.8 0</color><hot>20</hot><stationary>1</stationary></cylinder></primitive></shape></object>
{placed}</surface></world>"""


def world(robots=2):
    return robosim.World.parse(text(robots), name="scene")
