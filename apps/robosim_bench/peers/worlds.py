"""The world of a scene (scene.py) in the format of each simulator, as texts."""
import math


def number(value):
    """The shortest decimal text of a number, without an exponent, which Stage does not read."""
    text = f"{value:.12f}".rstrip("0").rstrip(".")
    return "0" if text in ("", "-0") else text


def numbers(*values):
    return " ".join(number(value) for value in values)


def degrees(angle):
    return math.degrees(angle)


# RoboSim

def robosim_type(scene, sensor):
    """A robot type. sensor: element and attributes of the ring: "sonar model='rays' rays='1'"."""
    body, ring = scene.body, scene.ring
    element = sensor.split()[0]
    return f"""<?xml version="1.0"?>
<robot name="peer">
  <body radius_m="{number(body.radius)}" height_m="{number(body.height)}"/>
  <limits speed_max_mps="{number(body.speed_max)}" accel_mps2="{number(body.accel)}" decel_mps2="{number(body.decel)}"
          turn_max_degps="{number(degrees(body.turn_max))}" turn_accel_degps2="{number(degrees(body.turn_accel))}"/>
  <sensors>
    <{sensor} range_max_m="{number(ring.range_max)}">
      <ring count="{ring.count}" radius_m="{number(ring.radius)}" z_m="{number(ring.height)}" first_angle_deg="{number(degrees(ring.first_angle))}"/>
    </{element}>
    <odometry/>
  </sensors>
</robot>
"""


def robosim_world(scene):
    reach = scene.half + scene.wall
    lines = ['<?xml version="1.0"?>', "<world><surface>",
             f"<size><xmin>{number(-reach)}</xmin><xmax>{number(reach)}</xmax>"
             f"<ymin>{number(-reach)}</ymin><ymax>{number(reach)}</ymax></size>"]
    for i, box in enumerate(scene.solids()):
        lines.append(f"<object><shape><primitive><cube><name>box{i}</name><x>{number(box.x)}</x><y>{number(box.y)}</y>"
                     f"<z>{number(scene.height / 2)}</z><length>{number(box.length)}</length>"
                     f"<width>{number(box.width)}</width><height>{number(scene.height)}</height>"
                     f"<direction>{number(box.heading)}</direction></cube></primitive></shape></object>")
    for i, robot in enumerate(scene.robots):
        lines.append(f"<object><shape><robot><model>peer</model><name>r{i}</name><x>{number(robot.x)}</x>"
                     f"<y>{number(robot.y)}</y><direction>{number(robot.heading)}</direction>"
                     "</robot></shape></object>")
    return "\n".join(lines) + "\n</surface></world>\n"


# Stage 4

STAGE_CORNERS = 32  # of a robot, which is a polygon: its sides are up to 0.5 % of its radius within the circle
STAGE_SENSOR = 0.02  # height of a sensor, whose ray is at half of it


def stage_world(scene, seconds, cell, controller):
    """cell: side of the cells in which Stage casts rays [m]. controller: a shared library; empty for none."""
    body, ring = scene.body, scene.ring
    turned = [2 * math.pi * i / STAGE_CORNERS for i in range(STAGE_CORNERS)]
    corners = [f"    point[{i}] [ {numbers(math.cos(a), math.sin(a))} ]" for i, a in enumerate(turned)]
    sensors = [f"    sensor ( pose [ {numbers(ring.radius * math.cos(ring.angle(i)), ring.radius * math.sin(ring.angle(i)), 0, degrees(ring.angle(i)))} ] "
               f"size [ {numbers(STAGE_SENSOR, STAGE_SENSOR, STAGE_SENSOR)} ] range [ 0 {number(ring.range_max)} ] fov 0 samples 1 )"
               for i in range(ring.count)]
    turn, turn_accel = degrees(body.turn_max), degrees(body.turn_accel)
    lines = ["interval_sim 100", f"quit_time {number(seconds)}", "speedup -1", f"resolution {number(cell)}", "",
             "define box model ( gui_nose 0 )", "",
             "define bot position", "(",
             f"  size [ {numbers(2 * body.radius, 2 * body.radius, body.height)} ]",
             "  block", "  (", f"    points {STAGE_CORNERS}", *corners, "    z [ 0 1 ]", "  )",
             '  drive "diff"', '  localization "gps"',
             f"  velocity_bounds [ {numbers(-body.speed_max, body.speed_max, 0, 0, 0, 0, -turn, turn)} ]",
             f"  acceleration_bounds [ {numbers(-body.accel, body.accel, 0, 0, 0, 0, -turn_accel, turn_accel)} ]",
             "  ranger", "  (",
             f"    pose [ 0 0 {number(ring.height - STAGE_SENSOR / 2 - body.height)} 0 ]",
             "    size [ 0.01 0.01 0.01 ]", *sensors, "  )"]
    if controller:
        lines.append(f'  ctrl "{controller}"')
    lines += [")", ""]
    for i, box in enumerate(scene.solids()):
        lines.append(f'box ( name "box{i}" pose [ {numbers(box.x, box.y, 0, degrees(box.heading))} ] '
                     f"size [ {numbers(box.length, box.width, scene.height)} ] )")
    for i, robot in enumerate(scene.robots):
        lines.append(f'bot ( name "r{i}" pose [ {numbers(robot.x, robot.y, 0, degrees(robot.heading))} ] )')
    return "\n".join(lines) + "\n"


# ARGoS 3

# Readings of the foot-bot's proximity sensors, by the distance d of an obstacle [m]: 1 up to the first number, then
# the second by d plus the third; 0 without an obstacle (footbot_proximity_default_sensor.cpp of ARGoS 3).
ARGOS_NEAR, ARGOS_SCALE, ARGOS_OFFSET = 0.009889556, 0.0100527, 0.000163144


def argos_distance(reading, range_max):
    """Distance of a reading; the near bound, up to which all readings are 1, for 1."""
    return range_max if reading <= 0 else ARGOS_NEAR if reading >= 1 else ARGOS_SCALE / reading - ARGOS_OFFSET


def argos_experiment(scene, seconds, script, iterations=10):
    """script: the file of argos_script(). iterations: sub-steps of the physics engine, by default ARGoS's."""
    side, height = 2 * (scene.half + scene.wall), scene.height
    lines = ['<?xml version="1.0"?>', "<argos-configuration>",
             f'<framework><system threads="0"/><experiment length="{number(seconds)}" ticks_per_second="10" random_seed="1"/></framework>',
             "<controllers>", '<lua_controller id="walk">',
             '<actuators><differential_steering implementation="default"/></actuators>',
             '<sensors><footbot_proximity implementation="default"/></sensors>',
             f'<params script="{script}"/>', "</lua_controller>", "</controllers>",
             f'<arena size="{number(side)},{number(side)},{number(2 * height)}" center="0,0,{number(height)}">']
    for i, box in enumerate(scene.solids()):
        lines.append(f'<box id="box{i}" size="{number(box.length)},{number(box.width)},{number(height)}" movable="false">'
                     f'<body position="{number(box.x)},{number(box.y)},0" orientation="{number(degrees(box.heading))},0,0"/></box>')
    for i, robot in enumerate(scene.robots):
        lines.append(f'<foot-bot id="r{i}"><body position="{number(robot.x)},{number(robot.y)},0" '
                     f'orientation="{number(degrees(robot.heading))},0,0"/><controller config="walk"/></foot-bot>')
    lines += ["</arena>", f'<physics_engines><dynamics2d id="plane" iterations="{iterations}"/></physics_engines>',
              "<media/>", "</argos-configuration>"]
    return "\n".join(lines) + "\n"


def argos_script(scene):
    """Drives straight ahead, and turns on the spot away from obstacles. Logs the first readings of each robot."""
    speed = 100 * scene.body.speed_max  # ARGoS takes centimetres per second of each wheel
    return f"""local is_new = true
function init() is_new = true end
function reset() is_new = true end
function destroy() end
function step()
  local x, y, text = 0, 0, "READINGS " .. robot.id
  for i = 1, #robot.proximity do
    local reading = robot.proximity[i]
    x = x + reading.value * math.cos(reading.angle)
    y = y + reading.value * math.sin(reading.angle)
    if is_new then text = text .. string.format(" %.9g", reading.value) end
  end
  if is_new then log(text) end
  is_new = false
  if x > 0.05 then
    local turn = y > 0 and {number(speed)} or -{number(speed)}
    robot.wheels.set_velocity(turn, -turn)
  else
    robot.wheels.set_velocity({number(speed)}, {number(speed)})
  end
end
"""


# MVSim

def mvsim_world(scene):
    """Robots drive circles, because MVSim has no controller that avoids obstacles. Their laser has the ring's rays, but
    from the robot's centre: MVSim has no ring of single rays."""
    body, ring = scene.body, scene.ring
    step = 360 / ring.count

    def shape(points):
        return "<shape>" + "".join(f"<pt>{numbers(*point)}</pt>" for point in points) + "</shape>"

    lines = ['<mvsim_world version="1.0">', "<simul_timestep>0.01</simul_timestep>",
             '<vehicle:class name="peer">', '<dynamics class="differential">']
    for side, sign in (("l", 1), ("r", -1)):
        lines.append(f'<{side}_wheel pos="0 {number(sign * body.wheel_track / 2)}" mass="1" width="0.03" diameter="0.1"/>')
    turned = [2 * math.pi * i / 16 for i in range(16)]
    lines += [f'<chassis mass="5" zmin="0.02" zmax="{number(body.height)}">',
              shape((body.radius * math.cos(a), body.radius * math.sin(a)) for a in turned), "</chassis>",
              f'<controller class="twist_ideal"><V>{number(body.speed_max / 2)}</V><W>30</W></controller>',
              "</dynamics>", '<friction class="default"><mu>0.7</mu><C_damping>0.9</C_damping></friction>',
              '<sensor class="laser" name="ring">',
              f"<pose_3d>0 0 {numbers(ring.height, degrees(ring.first_angle) + 180 - step / 2)} 0 0</pose_3d>",
              f"<fov_degrees>{number(360 - step)}</fov_degrees><nrays>{ring.count}</nrays>",
              f"<sensor_period>0.1</sensor_period><maxRange>{number(ring.range_max)}</maxRange>",
              "<range_std_noise>0</range_std_noise><angle_std_noise_deg>0</angle_std_noise_deg>",
              "<raytrace_3d>false</raytrace_3d>", "</sensor>", "</vehicle:class>"]
    for i, box in enumerate(scene.solids()):
        x, y = box.length / 2, box.width / 2
        lines.append(f'<block name="box{i}"><static>true</static><zmin>0</zmin><zmax>{number(scene.height)}</zmax>'
                     + shape(((-x, -y), (-x, y), (x, y), (x, -y)))
                     + f"<init_pose>{numbers(box.x, box.y, degrees(box.heading))}</init_pose></block>")
    for i, robot in enumerate(scene.robots):
        lines.append(f'<vehicle name="r{i}" class="peer">'
                     f"<init_pose>{numbers(robot.x, robot.y, degrees(robot.heading))}</init_pose></vehicle>")
    return "\n".join(lines) + "\n</mvsim_world>\n"
