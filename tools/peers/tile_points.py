"""Random points on the tiles of lichtmc, so that other programs can measure the means over the same tiles.

The tiles are those of room_lit.glb, which has the triangles of every surface with their place on its tile map.
"""

import csv

import numpy as np

import gltf_room

# The additive recurrence of M. Roberts in two dimensions: 1/g and 1/g², where g³ = g + 1.
SEQUENCE = 1.3247179572447460 ** -np.arange(1.0, 3.0)


def cut(polygon, axis, limit, keep_above):
    """The part of a convex polygon [corner, coordinate] on one side of a line (Sutherland and Hodgman)."""
    distances = polygon[:, axis] - limit if keep_above else limit - polygon[:, axis]
    kept = []
    for here, there, d, e in zip(polygon, np.roll(polygon, -1, 0), distances, np.roll(distances, -1)):
        if d >= 0:
            kept.append(here)
        if d * e < 0:
            kept.append(here + d / (d - e) * (there - here))
    return np.array(kept).reshape(-1, polygon.shape[1])


def pieces_of(corners, cells):
    """The pieces of a triangle in each cell of the map: (column, row, triangles). cells: its corners, in cells."""
    # Each corner as a point on the map, then its coordinates in space: both are cut by the same lines.
    whole = np.hstack([cells, corners])
    first, last = np.floor(cells.min(0)).astype(int), np.ceil(cells.max(0)).astype(int)
    for column in range(first[0], last[0]):
        strip = cut(cut(whole, 0, column, True), 0, column + 1, False)
        for row in range(first[1], last[1]):
            if len(strip) < 3:
                break
            piece = cut(cut(strip, 1, row, True), 1, row + 1, False)[:, 2:]
            if len(piece) >= 3:
                yield column, row, [(piece[0], piece[k], piece[k + 1]) for k in range(1, len(piece) - 1)]


def pieces_by_tile(lit_room):
    """{(surface, column, row): triangles} of all tiles; the normals of the triangles point to the side of the tile."""
    tiles = {}
    for part in gltf_room.read_parts(lit_room):
        tile_map = part.material["extras"]["lichtmc"]
        size = np.array([tile_map["columns"], tile_map["rows"]])
        for corners, uvs in zip(part.triangles, part.uvs):
            # The file has coordinates in float: an edge on the border of a cell is moved to it.
            cells = uvs * size
            nearest = np.round(cells)
            cells = np.where(np.abs(cells - nearest) < 1e-5 * size, nearest, cells)
            for column, row, triangles in pieces_of(corners, cells):
                tiles.setdefault((tile_map["surface"], column, row), []).extend(triangles)
    return tiles


def areas_of(triangles):
    a, b, c = np.moveaxis(triangles, 1, 0)
    normals = np.cross(b - a, c - a)
    doubled = np.linalg.norm(normals, axis=1)
    return doubled / 2, normals / np.where(doubled > 0, doubled, 1)[:, None]


class TilePoints:
    """Tiles in the order of tiles.csv; surface: one of them, or all.

    areas: [tile], m². selected: [row of tiles.csv], which of its rows are the tiles.
    """

    def __init__(self, results, surface=None):
        with open(results / "tiles.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.selected = np.array([surface in (None, row["surface"]) for row in rows])
        rows = [row for row, selected in zip(rows, self.selected) if selected]
        self.areas = np.array([float(row["area"]) for row in rows])
        found = pieces_by_tile(results / "room_lit.glb")
        pieces = [found.get((row["surface"], int(row["column"]), int(row["row"])), []) for row in rows]
        self.triangles = np.array([triangle for group in pieces for triangle in group])
        areas, self.normals = areas_of(self.triangles)
        self.ends = np.concatenate([[0], np.cumsum([len(group) for group in pieces])])
        self.cumulated = np.concatenate([[0.0], np.cumsum(areas)])
        self._check()

    def _check(self):
        """The tiles of the table: their areas differ only because the file has coordinates in float.

        Coordinates of 5 m are rounded by at most 3e-7 m, so an area changes by at most 3e-7 m times the perimeter; that
        is less than 30 times the square root of the area, unless a tile is 220 times as long as wide.
        """
        areas = np.diff(self.cumulated[self.ends])
        wrong = np.flatnonzero(np.abs(areas - self.areas) > 1e-5 * np.sqrt(self.areas))
        if wrong.size:
            k = wrong[0]
            found = f"number {k} has {areas[k]} m² instead of {self.areas[k]} m²"
            raise ValueError(f"{wrong.size} tiles of room_lit.glb are not those of tiles.csv; {found}")

    def __len__(self):
        return len(self.areas)

    def sample(self, count, random, even=False):
        """Points distributed uniformly over each tile, and normals: two arrays [tile, count, axis].

        Independent points or, if even, a sequence of low discrepancy, shifted at random: for means of programs that
        do not average over many paths.
        """
        if even:
            numbers = (random.random((len(self), 1, 2)) + np.arange(count)[:, None] * SEQUENCE) % 1.0
        else:
            numbers = random.random((len(self), count, 2))
        low, high = self.cumulated[self.ends[:-1], None], self.cumulated[self.ends[1:], None]
        area = low + numbers[..., 0] * (high - low)
        chosen = np.searchsorted(self.cumulated, area, "right") - 1
        chosen = np.clip(chosen, self.ends[:-1, None], self.ends[1:, None] - 1)
        # The place of the number among those of the chosen triangle is a number between 0 and 1 again.
        width = self.cumulated[chosen + 1] - self.cumulated[chosen]
        among = (area - self.cumulated[chosen]) / np.where(width > 0, width, 1.0)
        s, t = np.sqrt(np.clip(among, 0.0, 1.0)), numbers[..., 1]
        weights = np.stack([1 - s, s * (1 - t), s * t], -1)
        return np.einsum("ijk,ijkl->ijl", weights, self.triangles[chosen]), self.normals[chosen]
