#!/usr/bin/env python3
"""Draws docs/metaballs-triangles.svg and docs/metaballs-tolerance.svg from what the programs
metaballs_triangles and metaballs_tolerance wrote into the folder of their build, or a figure of the
curves in a report of pbrt-converge, one panel for each scene.

    ./dev bench metaballs_triangles metaballs_tolerance && tests/bench/plot.py build/bench
    tests/bench/plot.py REPORT.json FIGURE.svg
"""

import csv
import html
import json
import math
import pathlib
import sys

PROJECT = pathlib.Path(__file__).resolve().parents[2]
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"]  # Okabe and Ito 2008
LEVEL = '<tspan dy="6"> </tspan>'  # back to the line after a raised exponent
HALO = ' stroke="#fff" stroke-width="6" paint-order="stroke"'


def power_of_ten(exponent):
    raised = f'<tspan dy="-6" font-size="10">{str(exponent).replace("-", "−")}</tspan>'
    return "1" if exponent == 0 else "10" + raised


def decades(values):
    """The powers of ten that enclose the values, and those between them."""
    logs = [math.log10(v) for v in values]
    return [(10.0**e, power_of_ten(e)) for e in range(math.floor(min(logs)), math.ceil(max(logs)) + 1)]


def steps(values):
    """The same with the steps 1, 2, 5, for a range of few decades."""
    marks = [(m * 10**e, f"{m * 10**e:,}") for e in range(0, 7) for m in (1, 2, 5)]
    below = max(i for i, mark in enumerate(marks) if mark[0] <= min(values))
    above = min(i for i, mark in enumerate(marks) if mark[0] >= max(values))
    return marks[below:above + 1]


class Panel:
    """One log-log diagram; x and y are the marks on its axes, pairs of value and label."""

    def __init__(self, left, top, width, height, x, y):
        self.left, self.top, self.width, self.height = left, top, width, height
        self.x, self.y = x, y
        self.parts = []

    def place(self, x, y):
        def along(value, marks):
            return math.log(value / marks[0][0]) / math.log(marks[-1][0] / marks[0][0])

        return (self.left + self.width * along(x, self.x),
                self.top + self.height * (1 - along(y, self.y)))

    def text(self, x, y, text, anchor="middle", style=""):
        self.parts.append(
            f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{style}>{text}</text>')

    def line(self, x0, y0, x1, y1, style):
        self.parts.append(
            f'<line x1="{x0:.1f}" y1="{y0:.1f}" x2="{x1:.1f}" y2="{y1:.1f}" {style}/>')

    def axes(self, title, x_label, y_label):
        right, bottom = self.left + self.width, self.top + self.height
        grid = 'stroke="#ddd"'
        for value, label in self.x:
            x, _ = self.place(value, self.y[0][0])
            self.line(x, self.top, x, bottom, grid)
            self.text(x, bottom + 18, label)
        for value, label in self.y:
            _, y = self.place(self.x[0][0], value)
            self.line(self.left, y, right, y, grid)
            self.text(self.left - 8, y + 4, label, "end")
        self.text((self.left + right) / 2, bottom + 40, x_label)
        self.text((self.left + right) / 2, self.top - 14, title, style=' font-weight="bold"')
        x, y = self.left - 58, (self.top + bottom) / 2
        self.text(x, y, y_label, style=f' transform="rotate(-90 {x:.1f} {y:.1f})"')

    def curve(self, points, colour):
        path = " ".join("{:.1f},{:.1f}".format(*self.place(*p)) for p in points)
        self.parts.append(
            f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="1.8"/>')
        for p in points:
            self.dot(p, colour, 3)

    def note(self, point, text, dx, dy):
        x, y = self.place(*point)
        self.text(x + dx, y + dy, text, "start", ' font-size="11"')

    def dot(self, point, colour, radius):
        x, y = self.place(*point)
        self.parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" fill="{colour}"/>')


def write(name, width, height, parts):
    body = "\n".join(parts)
    (PROJECT / "docs" / name).write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
        f'font-family="sans-serif" font-size="13" fill="#222">\n'
        f'<rect width="100%" height="100%" fill="#fff"/>\n{body}\n</svg>\n', encoding="utf-8")


def read(path):
    """The rows of a table, as one list for each number of atoms."""
    sets = {}
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            sets.setdefault(row["atoms"], []).append(row)
    return sets


def legend(sets, x, y):
    parts = []
    for colour, atoms in zip(COLOURS, sets):
        parts.append(f'<circle cx="{x}" cy="{y - 4}" r="5" fill="{colour}"/>'
                     f'<text x="{x + 12}" y="{y}">{int(atoms):,} atoms</text>')
        x += 130
    return parts


def draw_triangles(sets):
    parts = legend(sets, 270, 24)
    for left, column, title, unit in (
            (85, "distance_mean", "Distance along the ray", "mean error / support radius h"),
            (585, "degrees_mean", "Normal", "mean error in degrees")):
        rows = [row for set_ in sets.values() for row in set_]
        panel = Panel(left, 80, 400, 460, decades([float(row["total"]) for row in rows]),
                      decades([float(row[column]) for row in rows]))
        panel.axes(title, "processor seconds: build and 512 × 512 rays", unit)
        for colour, set_ in zip(COLOURS, sets.values()):
            points = [(float(row["total"]), float(row[column])) for row in set_]
            names = [row["surface"] for row in set_]  # the first is the metaballs
            panel.curve(points[1:], colour)
            panel.dot(points[0], colour, 7)
            panel.note(points[-1], names[-1].split()[-1], 6, 4)
        for part, text in ((0.53, "lines: triangles; every dot halves the voxel, from h/2 on"),
                           (0.75, "large dots: metaballs as they are")):
            panel.text(panel.left + panel.width / 2, panel.top + part * panel.height, text, style=HALO)
        parts += panel.parts
    write("metaballs-triangles.svg", 1030, 600, parts)


def draw_tolerance(sets):
    rows = [row for set_ in sets.values() for row in set_]
    panel = Panel(85, 70, 620, 420, steps([float(row["nanoseconds"]) for row in rows]),
                  decades([float(row["error_mean"]) for row in rows]))
    panel.axes(f"The first root to tolerances of {power_of_ten(-2)}{LEVEL} h (top) to "
               f"{power_of_ten(-12)}{LEVEL} h, and to the last digit",
               "processor nanoseconds a ray, the root finder alone",
               "mean error / support radius h")
    for colour, set_ in zip(COLOURS, sets.values()):
        points = [(float(row["nanoseconds"]), float(row["error_mean"])) for row in set_]
        panel.curve(points, colour)
    parts = legend(sets, 130, 24) + panel.parts
    write("metaballs-tolerance.svg", 740, 550, parts)


def draw_report(report, name):
    """RMSE against CPU seconds, which other work on the machine disturbs least."""
    scenes = {}
    for variant in report["variants"]:
        scenes.setdefault(variant["reference"], []).append(variant)
    parts = []
    for index, (reference, variants) in enumerate(scenes.items()):
        curves = [[(s["cpuSeconds"], s["rmse"]) for s in v["snapshots"]] for v in variants]
        points = [p for curve in curves for p in curve]
        panel = Panel(85 + 400 * index, 50, 300, 330, decades([p[0] for p in points]),
                      decades([p[1] for p in points]))
        panel.axes(report["references"][reference]["scene"], "CPU seconds", "RMSE")
        for row, (colour, variant, curve) in enumerate(zip(COLOURS, variants, curves)):
            panel.curve(curve, colour)
            slope = variant["slope"]
            text = html.escape(variant["label"]) + (
                f": {slope['value']:.2f} ± {slope['error']:.2f}".replace("-", "−") if slope else "")
            y = panel.top + panel.height + 66 + 20 * row
            panel.parts.append(
                f'<circle cx="{panel.left}" cy="{y - 4}" r="5" fill="{colour}"/>'
                f'<text x="{panel.left + 12}" y="{y}">{text}</text>')
        parts += panel.parts
    rows = max(len(variants) for variants in scenes.values())
    write(name, 400 * len(scenes) + 20, 450 + 20 * rows, parts)


def main():
    if len(sys.argv) == 3:
        draw_report(json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8")), sys.argv[2])
        return
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else PROJECT / "build" / "bench"
    draw_triangles(read(folder / "metaballs_triangles.csv"))
    draw_tolerance(read(folder / "metaballs_tolerance.csv"))


if __name__ == "__main__":
    main()
