#!/usr/bin/env python3
"""Writes an open world as a RoboSim world file to standard output: scattered boxes and pillars, and many robots."""
import argparse
import math
import random
import sys

from world_text import cube, cylinder, gold, quarter_turn, robots, world

HALF_WIDTH = 30
WALL = 0.2
COLORS = ["0.55 0.46 0.37", "0.62 0.55 0.46", "0.45 0.47 0.42", "0.5 0.38 0.3"]


class Scatter:
    """Random positions of discs with a minimum gap to each other and to the walls."""

    def __init__(self, rng, gap):
        self.rng, self.gap, self.discs = rng, gap, []

    def place(self, radius):
        room = HALF_WIDTH - WALL - self.gap - radius
        for _ in range(10000):
            x, y = self.rng.uniform(-room, room), self.rng.uniform(-room, room)
            if all(math.hypot(x - a, y - b) > radius + r + self.gap for a, b, r in self.discs):
                self.discs.append((x, y, radius))
                return x, y
        sys.exit("make_open.py: there is no room for so much; ask for fewer --robots or --things")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", type=int, default=100)
    parser.add_argument("--things", type=int, default=90, help="boxes and pillars")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    rng = random.Random(given.seed)
    scatter = Scatter(rng, gap=0.7)

    inner, side = HALF_WIDTH - WALL / 2, 2 * HALF_WIDTH
    objects = "".join(
        cube(name, x, y, length, width, 0.6)
        for name, x, y, length, width in [
            ("NorthWall", 0, inner, side, WALL),
            ("SouthWall", 0, -inner, side, WALL),
            ("EastWall", inner, 0, WALL, side),
            ("WestWall", -inner, 0, WALL, side),
        ]
    )
    objects += gold(*scatter.place(0.2))
    for i in range(1, given.things + 1):
        height, color = rng.uniform(0.3, 1.2), COLORS[i % len(COLORS)]
        if i % 3 == 0:
            radius = rng.uniform(0.2, 0.9)
            objects += cylinder(f"Pillar{i // 3}", *scatter.place(radius), radius, height, color)
        else:
            length, width = rng.uniform(0.5, 5), rng.uniform(0.2, 1.2)
            x, y = scatter.place(math.hypot(length, width) / 2)
            objects += cube(f"Box{i - i // 3}", x, y, length, width, height, color, rng.uniform(0, math.pi))
    places = [(*scatter.place(0.3), quarter_turn(rng.randrange(4))) for _ in range(given.robots)]
    objects += robots(places, "wander")
    remark = f"Made by make_open.py: {given.robots} robots, {given.things} things, seed {given.seed}."
    print(world(remark, HALF_WIDTH, HALF_WIDTH, objects), end="")


if __name__ == "__main__":
    main()
