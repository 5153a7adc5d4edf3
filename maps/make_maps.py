#!/usr/bin/env python3
"""Writes the maps of this folder, each in one of the formats that RoboSim reads.

opho2_1.gridmap.gz is exported from a world (README.md)."""
import math
import pathlib
import struct
import zlib

FOLDER = pathlib.Path(__file__).parent
FREE, UNKNOWN, OCCUPIED = 254, 205, 0


class Picture:
    """Gray pixels over a rectangle of ground, painted in metres; the lower left corner is at (left, bottom)."""

    def __init__(self, left, bottom, width, height, cell, shade):
        self.left, self.bottom, self.cell = left, bottom, cell
        self.columns, self.rows = round(width / cell), round(height / cell)
        self.shades = [[shade] * self.columns for _ in range(self.rows)]

    def paint(self, shade, is_inside):
        """Paints every pixel whose centre is inside."""
        for row in range(self.rows):
            for column in range(self.columns):
                if is_inside(self.left + (column + 0.5) * self.cell, self.bottom + (row + 0.5) * self.cell):
                    self.shades[row][column] = shade

    def box(self, shade, x1, y1, x2, y2):
        self.paint(shade, lambda x, y: x1 <= x <= x2 and y1 <= y <= y2)

    def disc(self, shade, x, y, radius):
        self.paint(shade, lambda px, py: math.hypot(px - x, py - y) <= radius)

    def bar(self, shade, x1, y1, x2, y2, width):
        """A straight line of a width, in any direction."""
        length = math.hypot(x2 - x1, y2 - y1)
        ux, uy = (x2 - x1) / length, (y2 - y1) / length

        def is_inside(x, y):
            along, across = (x - x1) * ux + (y - y1) * uy, (y - y1) * ux - (x - x1) * uy
            return 0 <= along <= length and abs(across) <= width / 2

        self.paint(shade, is_inside)

    def rows_from_top(self):
        return [bytes(row) for row in reversed(self.shades)]

    def write_pgm(self, name):
        header = f"P5\n# Made by make_maps.py\n{self.columns} {self.rows}\n255\n"
        (FOLDER / name).write_bytes(header.encode() + b"".join(self.rows_from_top()))

    def write_png(self, name):
        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

        pixels = zlib.compress(b"".join(b"\0" + row for row in self.rows_from_top()), 9)
        header = struct.pack(">IIBBBBB", self.columns, self.rows, 8, 0, 0, 0, 0)
        data = chunk(b"IHDR", header) + chunk(b"IDAT", pixels) + chunk(b"IEND", b"")
        (FOLDER / name).write_bytes(b"\x89PNG\r\n\x1a\n" + data)


def make_lab():
    """An L-shaped floor: a corridor, five rooms, benches, tables and pillars; cells outside are unknown."""
    lab = Picture(-0.5, -0.5, 15, 11, 0.05, UNKNOWN)
    for x1, y1, x2, y2 in [(0, 0, 14, 6), (0, 6, 9, 10)]:
        lab.box(FREE, x1, y1, x2, y2)
    walls = [(0, 0, 14, 0), (14, 0, 14, 6), (9, 6, 14, 6), (9, 6, 9, 10), (0, 10, 9, 10), (0, 0, 0, 10)]
    walls += [(0, 4, 14, 4), (0, 6, 9, 6), (4.5, 0, 4.5, 4), (9.5, 0, 9.5, 4), (4.5, 6, 4.5, 10)]
    for x1, y1, x2, y2 in walls:
        lab.box(OCCUPIED, x1 - 0.1, y1 - 0.1, x2 + 0.1, y2 + 0.1)
    doors = [(1.6, 4, 3.0, 4), (6.2, 4, 7.6, 4), (11, 4, 12.4, 4), (1.6, 6, 3.0, 6), (6.2, 6, 7.6, 6)]
    doors += [(9.5, 1.3, 9.5, 2.7), (4.5, 7.4, 4.5, 8.8)]
    for x1, y1, x2, y2 in doors:
        across, along = (0.1, 0) if x1 == x2 else (0, 0.1)
        lab.box(FREE, x1 - across, y1 - along, x2 + across, y2 + along)
    for x1, y1, x2, y2 in [(0.1, 1.5, 0.8, 3), (6, 0.1, 8, 0.8), (5.6, 9.3, 7.6, 9.9), (12.6, 2.6, 13.9, 3.2)]:
        lab.box(OCCUPIED, x1, y1, x2, y2)
    for x, y, radius in [(2.4, 7.9, 0.55), (11.6, 1.3, 0.5), (13.2, 5.0, 0.15), (6.9, 7.6, 0.15)]:
        lab.disc(OCCUPIED, x, y, radius)
    lab.bar(OCCUPIED, 6.0, 2.1, 7.4, 2.7, 0.25)
    lab.write_pgm("lab.pgm")
    (FOLDER / "lab.yaml").write_text(
        "image: lab.pgm\nresolution: 0.05\norigin: [-0.5, -0.5, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )


def make_courtyard():
    """A walled yard, 20 m × 15 m, as a picture: light ground, gray paving, black walls."""
    yard = Picture(0, 0, 20, 15, 0.1, 235)
    yard.box(190, 3, 3, 17, 12)  # paving, too light to be a wall
    for x1, y1, x2, y2 in [(0, 0, 20, 0.3), (0, 14.7, 20, 15), (0, 0, 0.3, 15), (19.7, 0, 20, 15)]:
        yard.box(20, x1, y1, x2, y2)
    for i in range(12):
        angle = math.tau * i / 12
        yard.disc(40, 10 + 4.5 * math.cos(angle), 7.5 + 3.5 * math.sin(angle), 0.3)
    yard.disc(60, 10, 7.5, 1.2)
    yard.bar(30, 1.5, 12.5, 4, 14, 0.3)
    yard.write_png("courtyard.png")


def make_office():
    """A small office in ActivMedia's format: walls as lines, laser points of three tables and a sofa."""
    walls = [(0, 0, 12000, 0), (12000, 0, 12000, 8000), (12000, 8000, 0, 8000), (0, 8000, 0, 0)]
    walls += [(5000, 0, 5000, 1800), (5000, 3200, 5000, 8000), (5000, 4600, 7000, 4600), (8400, 4600, 12000, 4600)]
    walls += [(0, 5200, 1600, 5200), (3000, 5200, 5000, 5200)]
    points = set()
    for x, y, radius in [(2200, 2800, 450), (8000, 2200, 600), (10300, 2200, 400)]:
        for i in range(200):
            angle = math.tau * i / 200
            points.add((round((x + radius * math.cos(angle)) / 20) * 20, round((y + radius * math.sin(angle)) / 20) * 20))
    points |= {(x, 7300) for x in range(9000, 11001, 20)} | {(9000, y) for y in range(7300, 8000, 20)}
    lines = ["2D-Map"]
    lines += [f"MinPos: {min(x for x, _ in points)} {min(y for _, y in points)}"]
    lines += [f"MaxPos: {max(x for x, _ in points)} {max(y for _, y in points)}"]
    lines += [f"NumPoints: {len(points)}", "PointsAreSorted: true", "Resolution: 20"]
    lines += ["LineMinPos: 0 0", "LineMaxPos: 12000 8000", f"NumLines: {len(walls)}"]
    lines += ['Cairn: RobotHome 1000 1000 0 "" ICON "Home"', 'Cairn: Dock 11400 7000 180 "" ICON "Dock"']
    lines += ['Cairn: GoalWithHeading 6000 7000 0 "" ICON "Coffee"']
    lines += ['Cairn: ForbiddenLine 0 0 0 "" ICON "" 6000 0 6000 1000', "LINES"]
    lines += [" ".join(map(str, wall)) for wall in walls]
    lines += ["DATA"] + [f"{x} {y}" for x, y in sorted(points)]
    (FOLDER / "office.map").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    make_lab()
    make_courtyard()
    make_office()
