"""Parts of the world files of tasks."""


def wall(name, x_m, y_m, length_m, width_m):
    return (f"<object><shape><primitive><cube><name>{name}</name><x>{x_m}</x><y>{y_m}</y><z>0.25</z>"
            f"<length>{length_m}</length><width>{width_m}</width><height>0.5</height></cube></primitive></shape></object>")


def arena(half_length_m, half_width_m, contents):
    """A surface of this size with walls of 0.1 m along its edges."""
    x, y = half_length_m - 0.05, half_width_m - 0.05
    walls = (wall("North", 0, y, 2 * half_length_m, 0.1) + wall("South", 0, -y, 2 * half_length_m, 0.1)
             + wall("East", x, 0, 0.1, 2 * y - 0.1) + wall("West", -x, 0, 0.1, 2 * y - 0.1))
    return (f"<world><surface><size><xmin>{-half_length_m}</xmin><xmax>{half_length_m}</xmax><ymin>{-half_width_m}</ymin>"
            f"<ymax>{half_width_m}</ymax></size>{walls}{contents}</surface></world>")


def scatter(count, contents, **settings):
    """settings: attributes of <scatter>, such as gap or xmin [m]."""
    attributes = "".join(f' {name}="{value}"' for name, value in settings.items())
    return f'<scatter count="{count}"{attributes}>{contents}</scatter>'


def robot(model, name, sensors=""):
    """A robot for <scatter>. sensors: elements in place of those of its type."""
    return f"<robot><model>{model}</model><name>{name}</name>{f'<sensors>{sensors}</sensors>' if sensors else ''}</robot>"


def beacons(half_length_m, half_width_m):
    """Radio beacons at the south-west, south-east, north-east and north-west corner (steering.position_of())."""
    corners = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    places = "".join(f'<beacon x_m="{sx * half_length_m}" y_m="{sy * half_width_m}" z_m="0.3"/>' for sx, sy in corners)
    return f'<beacons z_m="0.3"><noise std_m="0.02" wall_bias_m="0"/>{places}</beacons>'
