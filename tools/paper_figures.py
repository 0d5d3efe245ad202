#!/usr/bin/env python3
"""Draws the floor of the example cube of H. Schulze, Lichtausbreitung in Räumen (2021), figures 3 and 4, right.

Runs build/release/bin/lichtmc on scenes/cube_paper.gltf with 100 000 photons, for ρ = 0.6 and 0.9, and writes
docs/figures/paper_floor_rho*.svg: the simulated floor beside the exact one (tests/data), in one scale, with the χ² of
their comparison.
"""

import csv
import math
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/bin/lichtmc"
PHOTONS = 100_000
CELLS = 10  # tiles along either edge of the floor, 0.1 m each

# The picture, in pixels: two panels side by side; a unit of the floor's plane and the height of the vertical axis.
PANEL_WIDTH, PICTURE_HEIGHT = 500, 580
FLOOR_SCALE, AXIS_HEIGHT = 220.0, 210.0
TITLE_HEIGHT = 96
COS30, SIN30 = math.sqrt(0.75), 0.5  # isometric projection

# Five points of the colour map viridis (S. van der Walt and N. Smith, CC0), dark to light.
COLORS = ((68, 1, 84), (59, 82, 139), (33, 145, 140), (94, 201, 98), (253, 231, 37))


def simulate(rho):
    """Runs the program; gives the folder with its results."""
    folder = ROOT / "build/figures" / f"rho{rho}"
    command = [PROGRAM, "run", ROOT / "scenes/cube_paper.gltf", "--output", folder, "--photons", PHOTONS]
    command += ["--estimator", "collision", "--reflectance", f"wall={rho}", "--quiet"]
    subprocess.run([str(part) for part in command], check=True)
    return folder


def read_floor(file):
    """Irradiance and standard error of the floor's tiles as two tables [along x][along z]."""
    irradiance = [[None] * CELLS for _ in range(CELLS)]
    error = [[None] * CELLS for _ in range(CELLS)]
    with file.open(encoding="utf-8", newline="") as lines:
        for row in csv.DictReader(lines):
            if row["surface"] != "floor":
                continue
            i, j = (int(float(row[axis]) * CELLS) for axis in "xz")
            if irradiance[i][j] is not None:
                raise SystemExit(f"{file}: two tiles of the floor at x = {row['x']}, z = {row['z']}")
            irradiance[i][j] = float(row["irradiance"])
            error[i][j] = float(row["standard_error"])
    if any(value is None for values in irradiance for value in values):
        raise SystemExit(f"{file}: the floor does not have {CELLS} x {CELLS} tiles")
    return irradiance, error


def read_exact(rho):
    lines = (ROOT / f"tests/data/cube_cos5_rho{rho}_floor.csv").read_text(encoding="utf-8").splitlines()
    return [[float(value) for value in line.split(",")] for line in lines if not line.startswith("#")]


def chi_square(simulated, error, exact):
    """Σ z² over the tiles; its expectation is their number."""
    tiles = [(i, j) for i in range(CELLS) for j in range(CELLS)]
    return sum(((simulated[i][j] - exact[i][j]) / error[i][j]) ** 2 for i, j in tiles)


def color(share):
    """Colour of a value's share of the scale, 0 to 1."""
    place = min(max(share, 0.0), 1.0) * (len(COLORS) - 1)
    k = min(int(place), len(COLORS) - 2)
    parts = (round(a + (place - k) * (b - a)) for a, b in zip(COLORS[k], COLORS[k + 1]))
    return "#" + "".join(f"{part:02x}" for part in parts)


class Panel:
    """One surface plot: x to the lower right, z to the lower left, irradiance upwards."""

    def __init__(self, left, top_value):
        self.back_corner = (left + PANEL_WIDTH / 2 + 12, TITLE_HEIGHT + AXIS_HEIGHT)
        self.top_value = top_value
        self.items = []

    def point(self, x, z, value=0.0):
        """Where (x, z) in m with a value in W/m² is drawn."""
        right = (x - z) * COS30 * FLOOR_SCALE
        down = (x + z) * SIN30 * FLOOR_SCALE - value / self.top_value * AXIS_HEIGHT
        return self.back_corner[0] + right, self.back_corner[1] + down

    def line(self, points, stroke):
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in (self.point(*p) for p in points))
        self.items.append(f'<polyline points="{path}" fill="none" stroke="{stroke}"/>')

    def text(self, place, content, anchor, shift=(0.0, 0.0), turn=0.0):
        x, y = (round(p + s, 1) for p, s in zip(self.point(*place), shift))
        rotate = f' transform="rotate({turn:g} {x} {y})"' if turn else ""
        self.items.append(f'<text x="{x}" y="{y}" text-anchor="{anchor}"{rotate}>{content}</text>')

    def axes(self, step):
        """Floor, the two walls behind with lines at the ticks, tick labels and titles."""
        for k in range(round(self.top_value / step) + 1):
            value = k * step
            self.line([(0, 1, value), (0, 0, value), (1, 0, value)], "#ddd")
            self.text((0, 1, value), f"{value:g}", "end", (-6, 4))
        for corner in ((0, 1), (0, 0), (1, 0)):
            self.line([(*corner, 0.0), (*corner, self.top_value)], "#aaa")
        self.line([(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)], "#555")
        for k in range(6):
            place = k / 5
            self.text((place, 1), f"{place:g}", "end", (-4, 14))
            self.text((1, place), f"{place:g}", "start", (4, 14))
        # Along the edges of the floor, which fall and rise by 30°.
        self.text((0.5, 1), "x/m", "middle", (-22, 36), 30)
        self.text((1, 0.5), "z/m", "middle", (22, 36), -30)
        self.text((0, 1, self.top_value / 2), "E in W/m²", "middle", (-38, 0), -90)

    def surface(self, values):
        """The map as a mesh through the tiles' middles, the cells farthest away first, so that near ones hide them."""
        cells = [(i, j) for i in range(CELLS - 1) for j in range(CELLS - 1)]
        for i, j in sorted(cells, key=lambda cell: (sum(cell), cell)):
            corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
            mean = sum(values[a][b] for a, b in corners) / 4
            points = [self.point((a + 0.5) / CELLS, (b + 0.5) / CELLS, values[a][b]) for a, b in corners]
            path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
            fill = color(mean / self.top_value)
            self.items.append(f'<polygon points="{path}" fill="{fill}" stroke="#222" stroke-width="0.5"/>')


def scale_of(maximum):
    """End and step of the vertical axis: at most six steps of 1, 2 or 5 times a power of ten, above the maximum."""
    power = 10.0 ** math.floor(math.log10(maximum / 6.0))
    step = next(factor * power for factor in (1, 2, 5, 10) if maximum <= 6.0 * factor * power)
    return math.ceil(maximum / step) * step, step


def picture(rho, simulated, exact, chi2):
    """The SVG text."""
    top, step = scale_of(max(max(max(row) for row in values) for values in (simulated, exact)))
    width = 2 * PANEL_WIDTH
    title = f"Irradiance of the floor: cube of 1 m, ρ = {rho}, emitter of 1 W with m = 5 at the centre, downwards"
    photons = f"{PHOTONS:,}".replace(",", "\u2009")
    items = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{PICTURE_HEIGHT}"'
        f' viewBox="0 0 {width} {PICTURE_HEIGHT}" font-family="sans-serif" font-size="12" fill="#222">',
        f"<title>{title}</title>",
        f'<rect width="{width}" height="{PICTURE_HEIGHT}" fill="#fff"/>',
        f'<text x="{width / 2:g}" y="28" text-anchor="middle" font-size="17">{title}</text>',
    ]
    captions = (
        (f"simulated: {photons} photons, collision estimator", f"χ²/{CELLS**2} = {chi2 / CELLS**2:.2f} against exact"),
        ("exact: deterministic radiosity", "means of the same 0.1 m tiles"),
    )
    for k, (values, lines) in enumerate(zip((simulated, exact), captions)):
        panel = Panel(k * PANEL_WIDTH, top)
        panel.axes(step)
        panel.surface(values)
        middle = k * PANEL_WIDTH + PANEL_WIDTH / 2
        for y, line in zip((56, 75), lines):
            items.append(f'<text x="{middle:g}" y="{y}" text-anchor="middle" font-size="13">{line}</text>')
        items += panel.items
    return "\n".join(items + ["</svg>"]) + "\n"


def main():
    if not PROGRAM.exists():
        raise SystemExit(f"{PROGRAM} is missing. Build it: cmake --preset release && cmake --build --preset release")
    figures = ROOT / "docs/figures"
    figures.mkdir(parents=True, exist_ok=True)
    for rho in ("0.6", "0.9"):
        try:
            folder = simulate(rho)
        except subprocess.CalledProcessError as failure:
            raise SystemExit(f"lichtmc failed with exit status {failure.returncode}; see its message above.") from None
        simulated, error = read_floor(folder / "tiles.csv")
        exact = read_exact(rho)
        chi2 = chi_square(simulated, error, exact)
        file = figures / f"paper_floor_rho{rho}.svg"
        file.write_text(picture(rho, simulated, exact, chi2), encoding="utf-8", newline="\n")
        print(f"{file.relative_to(ROOT)}: chi-square {chi2:.1f} over {CELLS * CELLS} tiles")


if __name__ == "__main__":
    sys.exit(main())
