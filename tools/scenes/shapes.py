"""Shapes made of flat faces, laid out on charts.

A face is a convex polygon, counter-clockwise seen from its front. A chart is a piece of the plane, in metres, onto
which some faces are laid out without stretching or overlap; `add` packs a shape's charts into the unit square at one
common scale and adds the shape to a file.
"""

import math

# Charts of one shape keep this distance (m). It is the default edge of a tile: so no tile of that size holds parts of
# two charts, which may be faces that look in different directions.
CHART_GAP = 0.1

AXES = {"x": 0, "y": 1, "z": 2}


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit_normal(points):
    """Unit normal of a flat polygon that is counter-clockwise seen from where the normal points."""
    a = points[0]
    total = [0.0, 0.0, 0.0]
    for b, c in zip(points[1:], points[2:]):
        part = cross([q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)])
        total = [t + p for t, p in zip(total, part)]
    length = math.sqrt(sum(t * t for t in total))
    if length == 0.0:
        raise ValueError(f"a face without area: {points}")
    return tuple(t / length for t in total)


class Chart:
    """Faces with their places on a chart: pairs of (points in space, the same points on the chart), in metres."""

    def __init__(self):
        self.faces = []

    def face(self, points, places):
        self.faces.append((points, places))
        return self

    def size(self):
        return tuple(max(p[i] for _, places in self.faces for p in places) for i in (0, 1))


class Plane(Chart):
    """A chart of faces in one axis-parallel plane: u along the first world axis in the plane, v along the second.

    normal is the axis that the front looks along, "+x" or "-z" for example; at its position on that axis (m);
    corner the smallest u and v of the faces (m).
    """

    def __init__(self, normal, at, corner):
        super().__init__()
        self.axis = AXES[normal[1]]
        self.u, self.v = (i for i in range(3) if i != self.axis)
        self.at = at
        self.corner = corner
        # u × v is along the axis for x and z, against it for y: there, and for a front that looks the other way, a
        # polygon counter-clockwise on the chart is turned over to be counter-clockwise seen from its front.
        self.turned = (normal[0] == "-") != (self.axis == 1)

    def polygon(self, corners):
        """Adds a polygon with the corners (u, v) in world coordinates, counter-clockwise with u to the right."""
        points = []
        for u, v in corners:
            point = [0.0, 0.0, 0.0]
            point[self.axis], point[self.u], point[self.v] = self.at, u, v
            points.append(tuple(point))
        places = [(u - self.corner[0], v - self.corner[1]) for u, v in corners]
        if self.turned:
            points.reverse()
            places.reverse()
        return self.face(points, places)

    def rectangle(self, u0, v0, u1, v1):
        return self.polygon([(u0, v0), (u1, v0), (u1, v1), (u0, v1)])


def wall(normal, at, u0, v0, u1, v1):
    """A rectangle, see Plane; u0 < u1 and v0 < v1."""
    return Plane(normal, at, (u0, v0)).rectangle(u0, v0, u1, v1)


def box(low, high, without=()):
    """The faces of an axis-parallel box seen from outside, each a chart; `without` names faces to leave out: "-y"."""
    charts = []
    for name, axis in AXES.items():
        u, v = (i for i in range(3) if i != axis)
        for sign, end in (("-", low), ("+", high)):
            if sign + name not in without:
                charts.append(wall(sign + name, end[axis], low[u], low[v], high[u], high[v]))
    return charts


def circle(centre, radius, segments):
    """The corners of a regular polygon in the plane, from angle 0 on."""
    angles = (2.0 * math.pi * j / segments for j in range(segments))
    return [(centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a)) for a in angles]


def lathe(centre, profile, segments=24):
    """A surface of revolution about the vertical through centre = (x, z), as faces without a chart.

    profile lists (radius, height) such that the front is to the right on the way: upwards on the outside, down again
    on the inside. A radius of 0 ends in a point.
    """

    def ring(radius, height):
        return [(x, height, z) for x, z in circle(centre, radius, segments)]

    faces = []
    for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
        lower, upper = ring(r0, y0), ring(r1, y1)
        for j in range(segments):
            k = (j + 1) % segments
            face = [lower[j], upper[j], upper[k], lower[k]]
            if r0 == 0.0:
                face.pop()
            if r1 == 0.0:
                face.pop(2)
            faces.append(face)
    return faces


def pack(charts):
    """Where each chart's lower left corner goes: (x, y) in metres, and the edge of the square that holds them all.

    Rows from the tallest chart to the flattest, about as wide as high in all.
    """
    sizes = [chart.size() for chart in charts]
    room = sum((w + CHART_GAP) * (h + CHART_GAP) for w, h in sizes)
    width = max(max(w for w, _ in sizes), math.sqrt(room))
    order = sorted(range(len(charts)), key=lambda i: (-sizes[i][1], -sizes[i][0], i))
    places = [None] * len(charts)
    x = y = row = edge = 0.0
    for i in order:
        w, h = sizes[i]
        if x > 0.0 and x + w > width:
            x, y = 0.0, y + row + CHART_GAP
            row = 0.0
        places[i] = (x, y)
        edge = max(edge, x + w, y + h)
        row = max(row, h)
        x += w + CHART_GAP
    return places, edge


def add(gltf, name, material, charts):
    """Adds charts as one surface, flat-shaded, with texture coordinates in [0, 1]."""
    corners, edge = pack(charts)
    faces = []
    for chart, (x, y) in zip(charts, corners):
        for points, places in chart.faces:
            # min(): the quotient of equal numbers is 1, of sums that were rounded differently 1 to rounding.
            faces.append((points, [(min((x + u) / edge, 1.0), min((y + v) / edge, 1.0)) for u, v in places]))
    _add_faces(gltf, name, material, faces)


def add_without_uvs(gltf, name, material, faces):
    """Adds faces as one surface, flat-shaded, without texture coordinates."""
    _add_faces(gltf, name, material, [(points, None) for points in faces])


def _add_faces(gltf, name, material, faces):
    positions, normals, uvs, triangles = [], [], [], []
    for points, places in faces:
        first = len(positions)
        positions += points
        normals += [unit_normal(points)] * len(points)
        uvs += places or []
        triangles += [(first, first + i, first + i + 1) for i in range(1, len(points) - 1)]
    gltf.surface(name, material, positions, normals, uvs or None, triangles)
