#!/usr/bin/env python3
"""Writes a random world for mpi.sh: a long narrow crowd of three types of robots, which differ in body, speed, and sensors
with most of their errors, between boxes; some messages are lost. mixed_world.py SEED FOLDER writes FOLDER/mixed_SEED.xml
and the types in FOLDER/robots."""
import pathlib
import random
import sys

ROWS, COLUMNS, PITCH_M = 110, 6, 1.3  # more robots than two chunks of the digest, so that rank 0 knows not all
CONTROLLERS = ["wander", "wander", "stigmergy", "random_walk", "wall_search", "heat_gradient"]


class MixedWorld:
    def __init__(self, seed):
        self.seed, self.random = seed, random.Random(seed)

    def number(self, low, high):
        return round(self.random.uniform(low, high), 3)

    def one_of(self, *choices):
        return self.random.choice(choices)

    def sonar(self):
        noise = self.one_of("", 'noise="polaroid"')
        return (f'<sonar model="{self.one_of("sector", "rays")}" rays="{self.one_of(1, 5)}" '
                f'range_max_m="{self.number(0.5, 2.5)}" beam_width_deg="{self.number(5, 80)}" '
                f'firing_interval_s="{self.one_of(0, 0.04, 0.1)}" {noise}>'
                f'<ring count="{self.random.randint(1, 8)}" radius_m="{self.number(0, 0.3)}" z_m="0.15"/>'
                f'<noise robot_crosstalk="{self.one_of(0, 0.5)}" second_echoes="{self.one_of(0, 1)}" crosstalk="0.2"/></sonar>')

    def laser(self):
        return (f'<laser x_m="{self.number(-0.2, 0.2)}" y_m="{self.number(-0.2, 0.2)}" z_m="0.2" '
                f'beams="{self.random.randint(1, 40)}" field_of_view_deg="{self.number(10, 360)}" '
                f'range_max_m="{self.number(0.5, 2.5)}" range_min_m="0.05" sweep_s="{self.one_of(0, 0.05, 0.3, 1)}" '
                f'latency_s="{self.one_of(0, 0.1, 0.7)}" rate_hz="{self.one_of(0, 3, 7)}" phase_s="0.13">'
                f'<noise divergence_deg="2" reach_m="1.5" drift_m="0.1"/></laser>')

    def infrared(self):
        noise = self.one_of("", 'noise="gp2d12"')
        return (f'<infrared range_max_m="{self.number(0.3, 1.5)}" {noise}>'
                f'<ring count="4" radius_m="0.1" z_m="0.1"/></infrared>')

    def range_and_bearing(self):
        return (f'<range_and_bearing range_max_m="{self.number(0.5, 2.5)}" count="{self.random.randint(1, 5)}">'
                f'{self.one_of("", "<noise/>")}</range_and_bearing>')

    def robot_type(self, name):
        body = self.one_of(f'radius_m="{self.number(0.1, 0.35)}"',
                           f'length_m="{self.number(0.2, 0.5)}" width_m="{self.number(0.2, 0.5)}"')
        sensors = self.sonar() + self.laser() + self.one_of("", self.infrared()) + self.one_of("", self.range_and_bearing())
        return (f'<robot name="{name}" help="One of a mixed crowd.">\n'
                f'<body {body} height_m="{self.number(0.3, 0.6)}"/>\n'
                f'<limits speed_max_mps="{self.number(0.5, 4)}" accel_mps2="{self.number(1, 40)}" '
                f'decel_mps2="{self.number(1, 40)}" turn_max_degps="{self.number(50, 720)}" '
                f'turn_accel_degps2="{self.number(200, 3000)}"/>\n'
                f'<sensors>{sensors}<heat range_max_m="5"><noise lag_s="1"/></heat>'
                f'<bumper segments="7"><noise chatter="0.1"/></bumper>'
                f'<odometry><noise diameter_ratio="1.003" turn_slip_s="0.01" contact_slip="0.3"/></odometry>'
                f'<compass><noise/></compass><battery><noise drop_v_per_mps="0.03" std_v="0.02"/></battery>'
                f'</sensors></robot>\n')

    def world(self, types):
        radio = '<communication loss="0.1" burst_gap_s="2" burst_s="0.5" delay_s="0.2" rate_hz="3"/>'
        lines = [f'<world>{self.one_of("", radio)}<surface><type>smooth</type><size><xmin>0</xmin>'
                 f'<xmax>{COLUMNS * PITCH_M}</xmax><ymin>0</ymin><ymax>{ROWS * PITCH_M}</ymax></size>']
        for place in range(ROWS * COLUMNS):
            x_m, y_m = (place % COLUMNS + 0.5) * PITCH_M, (place // COLUMNS + 0.5) * PITCH_M
            at = f'<x>{x_m}</x><y>{y_m}</y>'
            if place == ROWS * COLUMNS // 2:
                lines.append(f'<object><shape><primitive><cylinder><name>Gold</name>{at}<z>0.25</z><radius>0.1</radius>'
                             '<height>0.5</height><color>1 0.8 0.1</color><hot>20</hot><stationary>1</stationary>'
                             '</cylinder></primitive></shape></object>')
            elif self.random.random() < 0.06:
                lines.append(f'<object><shape><primitive><cube><name>Box{place}</name>{at}<z>0.2</z>'
                             f'<direction>{self.number(0, 3)}</direction><length>{self.number(0.1, 0.6)}</length>'
                             f'<width>0.2</width><height>{self.number(0.1, 0.8)}</height><color>1 1 1</color><hot>0</hot>'
                             '<stationary>1</stationary></cube></primitive></shape></object>')
            else:
                lines.append(f'<object><shape><robot><model>{self.random.choice(types)}</model><name>r{place}</name>{at}'
                             f'<direction>{self.number(-3, 3)}</direction>'
                             f'<controller>{self.random.choice(CONTROLLERS)}</controller></robot></shape></object>')
        return "\n".join(lines + ["</surface></world>\n"])


def main():
    seed, folder = int(sys.argv[1]), pathlib.Path(sys.argv[2])
    (folder / "robots").mkdir(exist_ok=True)
    mixed = MixedWorld(seed)
    types = [f"mixed_{seed}_{i}" for i in range(3)]
    for name in types:
        (folder / "robots" / f"{name}.xml").write_text(mixed.robot_type(name))
    (folder / f"mixed_{seed}.xml").write_text(mixed.world(types))


main()
