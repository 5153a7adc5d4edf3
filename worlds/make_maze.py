#!/usr/bin/env python3
"""Writes a maze as a RoboSim world file to standard output: square cells, some loops, gold in a dead end."""
import argparse
import random
from collections import deque

from world_text import cube, gold, quarter_turn, robots, world

PITCH = 1.5
THICKNESS = 0.1
HEIGHT = 0.6
STEPS = [(1, 0), (0, 1), (-1, 0), (0, -1)]


class Maze:
    """Cells (column, row); `open` contains the pairs of adjacent cells without a wall between them."""

    def __init__(self, columns, rows, loops, rng):
        self.columns, self.rows = columns, rows
        self.open = set()
        self._carve(rng)
        closed = [(a, b) for a in self.cells() for b in self.neighbours(a) if a < b and not self.is_open(a, b)]
        for a, b in rng.sample(closed, round(loops * len(closed))):
            self.open.add(frozenset((a, b)))

    def cells(self):
        return [(column, row) for column in range(self.columns) for row in range(self.rows)]

    def neighbours(self, cell):
        near = [(cell[0] + dx, cell[1] + dy) for dx, dy in STEPS]
        return [(x, y) for x, y in near if 0 <= x < self.columns and 0 <= y < self.rows]

    def is_open(self, a, b):
        return frozenset((a, b)) in self.open

    def ways(self, cell):
        return [near for near in self.neighbours(cell) if self.is_open(cell, near)]

    def _carve(self, rng):
        """Randomised depth-first search with backtracking: all cells are connected."""
        way = [(0, 0)]
        seen = set(way)
        while way:
            fresh = [cell for cell in self.neighbours(way[-1]) if cell not in seen]
            if not fresh:
                way.pop()
                continue
            cell = rng.choice(fresh)
            self.open.add(frozenset((way[-1], cell)))
            seen.add(cell)
            way.append(cell)

    def distances(self, starts):
        """Steps from the nearest of the starts to each cell."""
        steps = {start: 0 for start in starts}
        queue = deque(starts)
        while queue:
            cell = queue.popleft()
            for near in self.ways(cell):
                if near not in steps:
                    steps[near] = steps[cell] + 1
                    queue.append(near)
        return steps

    def center(self, cell):
        return (cell[0] - (self.columns - 1) / 2) * PITCH, (cell[1] - (self.rows - 1) / 2) * PITCH

    def walls(self):
        """One box per straight run of wall: (x, y, length along x, length along y)."""
        for row in range(self.rows + 1):
            stands = [not self.is_open((c, row - 1), (c, row)) for c in range(self.columns)]
            for first, last in runs(stands):
                left, y = self.center((first - 0.5, row - 0.5))
                right, _ = self.center((last + 0.5, row - 0.5))
                yield (left + right) / 2, y, right - left + THICKNESS, THICKNESS
        for column in range(self.columns + 1):
            stands = [not self.is_open((column - 1, r), (column, r)) for r in range(self.rows)]
            for first, last in runs(stands):
                x, bottom = self.center((column - 0.5, first - 0.5))
                _, top = self.center((column - 0.5, last + 0.5))
                yield x, (bottom + top) / 2, THICKNESS, top - bottom + THICKNESS


def runs(flags):
    """(first, last) of each run of True."""
    first = None
    for i, flag in enumerate([*flags, False]):
        if flag and first is None:
            first = i
        if not flag and first is not None:
            yield first, i - 1
            first = None


def start_cells(columns, rows, count):
    """Spread evenly along the maze's rim, counter-clockwise from its lower left corner."""
    rim = [(c, 0) for c in range(columns - 1)] + [(columns - 1, r) for r in range(rows - 1)]
    rim += [(columns - 1 - c, rows - 1) for c in range(columns - 1)] + [(0, rows - 1 - r) for r in range(rows - 1)]
    return [rim[i * len(rim) // count] for i in range(count)]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--columns", type=int, default=20)
    parser.add_argument("--rows", type=int, default=20)
    parser.add_argument("--robots", type=int, default=8)
    parser.add_argument("--loops", type=float, default=0.1, help="fraction of the inner walls that is removed")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--types", default="pioneer3dx,scout", help="robot types, used in turn")
    parser.add_argument("--controller", default="gold_finder")
    given = parser.parse_args()

    maze = Maze(given.columns, given.rows, given.loops, random.Random(given.seed))
    starts = start_cells(given.columns, given.rows, given.robots)
    steps = maze.distances(starts)
    dead_ends = [cell for cell in maze.cells() if len(maze.ways(cell)) == 1 and cell not in starts]
    treasury = max(dead_ends, key=lambda cell: (steps[cell], cell))

    objects = "".join(cube(f"Wall{i}", x, y, dx, dy, HEIGHT) for i, (x, y, dx, dy) in enumerate(maze.walls(), 1))
    objects += gold(*maze.center(treasury))
    places = [(*maze.center(cell), quarter_turn(i)) for i, cell in enumerate(starts)]
    objects += robots(places, given.controller, given.types.split(","))
    half = [(count * PITCH + THICKNESS) / 2 for count in (given.columns, given.rows)]
    remark = f"Made by make_maze.py: {given.columns} x {given.rows} cells, {given.robots} robots, loops {given.loops}, "
    print(world(remark + f"seed {given.seed}.", *half, objects), end="")


if __name__ == "__main__":
    main()
