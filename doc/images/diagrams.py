#!/usr/bin/env python3
"""Draws the diagrams mounts.svg (frame and sensors of worlds/robots/pioneer3dx.xml) and protocol.svg (doc/protocol.md) in this folder.

Colours follow the light or dark theme of the page.
"""
import math
import xml.etree.ElementTree as ElementTree
from pathlib import Path

FOLDER = Path(__file__).parent
ROBOT_TYPE = FOLDER.parents[1] / "worlds/robots/pioneer3dx.xml"

STYLE = """<style>
  svg { --text: #1f2328; --quiet: #636c76; --line: #afb8c1; --fill: #f0f3f6; --blue: #0757b8; --red: #b3261e; --green: #116329; }
  @media (prefers-color-scheme: dark) {
    svg { --text: #e6edf3; --quiet: #9198a1; --line: #59636e; --fill: #21262d; --blue: #6cb2ff; --red: #ff8a80; --green: #56d364; }
  }
  text { fill: var(--text); font: 13px "DejaVu Sans", "Segoe UI", Helvetica, Arial, sans-serif; }
  .small { font-size: 11.5px; } .bold { font-weight: bold; } .quiet { fill: var(--quiet); }
  .blue { fill: var(--blue); } .red { fill: var(--red); } .green { fill: var(--green); }
  .mono { font-family: "DejaVu Sans Mono", Consolas, Menlo, monospace; font-size: 12px; }
  .thin { fill: none; stroke: var(--line); } .dashed { stroke-dasharray: 4 4; }
  .body { fill: var(--fill); stroke: var(--quiet); stroke-width: 1.5; }
  .a { fill: none; stroke-width: 1.8; } .a.blue { stroke: var(--blue); } .a.red { stroke: var(--red); } .a.green { stroke: var(--green); }
  .a.text { stroke: var(--text); } .a.quiet { stroke: var(--quiet); }
</style>
"""


class Drawing:
    def __init__(self, width, height, label):
        self._size = f'viewBox="0 0 {width} {height}" width="{width}" height="{height}"'
        self._label = label
        self._parts = []

    def add(self, element):
        self._parts.append(element)

    def text(self, x, y, text, css="", anchor="start"):
        self.add(f'<text x="{x:.1f}" y="{y:.1f}" class="{css}" text-anchor="{anchor}">{text}</text>')

    def path(self, d, css):
        self.add(f'<path d="{d}" class="{css}"/>')

    def circle(self, x, y, radius, css):
        self.add(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius:.1f}" class="{css}"/>')

    def arrow(self, x1, y1, x2, y2, css):
        """A line with a filled head at its end."""
        length = math.hypot(x2 - x1, y2 - y1)
        u, v = (x2 - x1) / length, (y2 - y1) / length
        self.path(f"M{x1:.1f} {y1:.1f}L{x2 - 6 * u:.1f} {y2 - 6 * v:.1f}", f"a {css}")
        self.add(f'<path d="M{x2:.1f} {y2:.1f}L{x2 - 9 * u - 4 * v:.1f} {y2 - 9 * v + 4 * u:.1f}'
                 f'L{x2 - 9 * u + 4 * v:.1f} {y2 - 9 * v - 4 * u:.1f}z" class="{css}" fill="currentColor"/>')

    def write(self, name):
        (FOLDER / name).write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" {self._size} role="img" aria-label="{self._label}">\n'
            + STYLE + "\n".join(self._parts) + "\n</svg>\n", encoding="utf-8")


def draw_mounts():
    robot = ElementTree.parse(ROBOT_TYPE).getroot()
    body, laser = robot.find("body"), robot.find("sensors/laser")
    sonars = [{key: float(at.get(key)) for key in ("x_m", "y_m", "z_m", "angle_deg")} for at in robot.findall("sensors/sonar/at")]
    radius_m, height_m = float(body.get("radius_m")), float(body.get("height_m"))
    laser_x_m, laser_z_m = float(laser.get("x_m")), float(laser.get("z_m"))
    drawing = Drawing(920, 500, "Frame and sensors of a Pioneer 3-DX, from above and from its right side")

    scale, x0, y0 = 500, 270, 262  # pixels per metre; the robot's centre. x forward is to the right, y left is up

    def at(x_m, y_m):
        return x0 + scale * x_m, y0 - scale * y_m

    drawing.text(24, 30, "from above", "bold")
    drawing.circle(x0, y0, scale * radius_m, "body")
    # Field of the laser
    lx, ly = at(laser_x_m, 0)
    drawing.path(f"M{lx:.1f} {ly - 178:.1f}A178 178 0 0 1 {lx:.1f} {ly + 178:.1f}", "thin dashed")
    drawing.text(lx + 62, ly - 174, "field of the laser: 180°, 181 beams", "small quiet")
    drawing.text(lx + 62, ly - 159, "from right to left", "small quiet")
    for index, sonar in enumerate(sonars):
        angle = math.radians(sonar["angle_deg"])
        x, y = at(sonar["x_m"], sonar["y_m"])
        drawing.circle(x, y, 3, "blue")
        drawing.arrow(x, y, x + 26 * math.cos(angle), y - 26 * math.sin(angle), "blue")
        # The number is beyond the arrow, or beside one that ends near the circle.
        if abs(sonar["angle_deg"]) == 90:
            drawing.text(x + math.copysign(13, x - x0), y - 20 * math.sin(angle) + 4, str(index), "blue small bold", "middle")
        else:
            drawing.text(x + 38 * math.cos(angle), y - 38 * math.sin(angle) + 4, str(index), "blue small bold", "middle")
    drawing.arrow(x0, y0, x0 + scale * radius_m + 112, y0, "red")
    drawing.text(x0 + scale * radius_m + 118, y0 + 4, "x forward", "red bold")
    drawing.arrow(x0, y0, x0, y0 - scale * radius_m - 62, "red")
    drawing.text(x0, y0 - scale * radius_m - 70, "y left", "red bold", "middle")
    drawing.path(f"M{x0 + 92} {y0}A92 92 0 0 0 {x0 + 92 * math.cos(0.95):.1f} {y0 - 92 * math.sin(0.95):.1f}", "a red")
    drawing.arrow(x0 + 92 * math.cos(0.85), y0 - 92 * math.sin(0.85), x0 + 92 * math.cos(0.98), y0 - 92 * math.sin(0.98), "red")
    drawing.text(x0 + 13, y0 - 24, "angle_deg", "mono red")
    drawing.circle(lx, ly, 5, "green")
    drawing.text(x0 + 12, y0 + 22, "laser", "green small")
    drawing.circle(x0, y0, 4, "red")
    drawing.text(24, 470, "Sonars are numbered in the order of their &lt;at&gt;, from 0; a &lt;ring&gt; is numbered counter-clockwise from first_angle_deg.",
                 "small")
    drawing.text(24, 488, "The circle is the disc that must be free of contacts (radius_m). Bumper segments: counter-clockwise, the first one straight ahead.",
                 "small")

    # From the right side: x to the right, z up
    scale, x0, ground = 400, 762, 330
    drawing.text(655, 30, "from the right", "bold")
    half = scale * radius_m
    drawing.path(f"M{x0 - half - 24:.1f} {ground}H{x0 + half + 34:.1f}", "a quiet")
    drawing.text(x0 + half + 34, ground + 17, "ground, z = 0", "small quiet", "end")
    drawing.add(f'<rect x="{x0 - half:.1f}" y="{ground - scale * height_m:.1f}" width="{2 * half:.1f}" height="{scale * height_m:.1f}" class="body"/>')
    for sonar in sonars:
        if sonar["y_m"] < 0:
            drawing.circle(x0 + scale * sonar["x_m"], ground - scale * sonar["z_m"], 3, "blue")
    drawing.circle(x0 + scale * laser_x_m, ground - scale * laser_z_m, 5, "green")
    drawing.arrow(x0, ground, x0 + half + 34, ground, "red")
    drawing.text(x0 + half + 8, ground - 8, "x", "red bold", "start")
    drawing.arrow(x0, ground, x0, ground - scale * height_m - 62, "red")
    drawing.text(x0 + 8, ground - scale * height_m - 54, "z up", "red bold")
    drawing.circle(x0, ground, 4, "red")
    drawing.text(x0 + 18, ground - scale * laser_z_m + 4, f"laser, {laser_z_m:g} m", "green small")
    drawing.text(x0 + 18, ground - 44, f"sonars, {sonars[0]['z_m']:g} m", "blue small")
    drawing.text(x0 - half, ground - scale * height_m - 8, f"height {height_m:g} m", "small quiet")
    drawing.text(x0 - half, ground + 17, "origin: centre of", "small red")
    drawing.text(x0 - half, ground + 32, "the underside", "small red")
    drawing.write("mounts.svg")


def draw_protocol():
    drawing = Drawing(880, 664, "Messages between a control panel, a robot process, the environment and a viewer")
    panel, robot, environment, viewer = 90, 330, 590, 800
    for x, title, role in ((panel, "control panel", "robosim control"), (robot, "robot process", "robosim robot"),
                           (environment, "environment", "robosim serve"), (viewer, "viewer", "robosim view")):
        drawing.add(f'<rect x="{x - 74}" y="16" width="148" height="46" rx="6" class="body"/>')
        drawing.text(x, 36, title, "bold", "middle")
        drawing.text(x, 53, role, "mono quiet", "middle")
        drawing.path(f"M{x} 62V636", "thin dashed")

    def message(y, source, target, text, detail="", css="blue"):
        drawing.arrow(source, y, target, y, css)
        middle = (source + target) / 2 if abs(source - target) < 300 else (panel + robot) / 2  # clear of other lines
        drawing.text(middle, y - 6, text, f"{css} small bold", "middle")
        drawing.text(middle, y + 15, detail, "small quiet", "middle")

    def phase(y1, y2, title):
        drawing.add(f'<rect x="8" y="{y1}" width="864" height="{y2 - y1}" rx="6" class="thin"/>')
        drawing.text(18, y1 + 17, title, "small bold quiet")

    phase(76, 258, "connect")
    message(112, robot, environment, "Robots.Drive, Bearer TOKEN", "the token must permit these robots", "green")
    message(156, robot, environment, "hello", "protocol, names of robots")
    message(200, environment, robot, "welcome", "world, seed, length of a step, sensors")
    message(126, viewer, environment, "Viewing.Watch", "", "green")
    message(244, panel, environment, "ControlPanel.Start", "", "green")
    phase(268, 524, "each step")
    message(306, environment, robot, "readings", "step k, measurements, inbox, stalled")
    message(358, robot, environment, "answer", "step k, commands, messages, win_checks")
    drawing.add(f'<rect x="{environment - 118}" y="390" width="236" height="64" rx="6" class="body"/>')
    for line, text in enumerate(("limits the commands, authorises", "all moves up to contacts, moves,", "delivers messages, senses: step k + 1")):
        drawing.text(environment, 409 + 17 * line, text, "small", "middle")
    message(478, viewer, environment, "request")
    message(502, environment, viewer, "frame", "newest step, at any rate")
    phase(534, 636, "end")
    message(570, environment, robot, "winner", "all robots halt")
    message(614, environment, robot, "status OK", "", "green")
    drawing.write("protocol.svg")


if __name__ == "__main__":
    draw_mounts()
    draw_protocol()
