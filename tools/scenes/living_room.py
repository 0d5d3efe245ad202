"""A furnished living room, 5.2 × 2.6 × 4.2 m, with a window and four lamps of different kinds.

The origin is a lower corner; x runs along the window's wall, y up, z from the window into the room. Outside of the
window there is nothing: light that leaves through it has escaped.

No two faces lie in one place. Where a thing stands on, hangs from or touches another, the smaller of the two faces in
contact is left out, and it lies within the larger: were both there, chance would decide which of the two a ray hits.
What is left out is named by `without`. Books and cushions keep some millimetres between them instead.
"""

import math

from . import shapes
from .gltf import POINTING_DOWN, POINTING_UP, Gltf
from .shapes import Chart, Plane, box, circle, lathe, wall

WIDTH, HEIGHT, DEPTH = 5.2, 2.6, 4.2
WINDOW = (1.4, 0.9, 3.8, 2.2)  # x and y of the lower left, of the upper right corner of the opening
WALL_THICKNESS = 0.3

LAMP_CENTRE, LAMP_RADIUS, LAMP_SEGMENTS = (2.6, 2.1), 0.28, 32
LAMP_POWER_LM = 2000.0

TABLE_TOP = 0.46  # height (m)
TABLE_CENTRE = (3.1, 2.1)


def materials(gltf):
    """Materials by a short name. Reflectances are usual ones of such things, hues are matters of taste."""
    # A Lambertian surface of area A and luminance L emits π L A; the lamp is a polygon of LAMP_SEGMENTS corners.
    area = 0.5 * LAMP_SEGMENTS * LAMP_RADIUS**2 * math.sin(2.0 * math.pi / LAMP_SEGMENTS)
    lamp_luminance = round(LAMP_POWER_LM / (math.pi * area), 3)
    return {
        "ceiling": gltf.material("ceiling paint", 0.85),
        "wall": gltf.material("wall paint", 0.6, (1.0, 0.93, 0.8)),
        "floor": gltf.material("oak floor", 0.35, (1.0, 0.55, 0.25)),
        "wood": gltf.material("walnut", 0.2, (1.0, 0.5, 0.25)),
        "lacquer": gltf.material("white lacquer", 0.75),
        "rug": gltf.material("wool rug", 0.45, (1.0, 0.85, 0.65)),
        "fabric": gltf.material("sofa fabric", 0.3, (0.5, 0.8, 1.0)),
        "cushion": gltf.material("cushion fabric", 0.5, (1.0, 0.7, 0.35)),
        "curtain": gltf.material("curtain cloth", 0.55, (1.0, 0.95, 0.85), double_sided=True),
        "books": gltf.material("book covers", 0.4, (1.0, 0.6, 0.45)),
        "screen": gltf.material("black screen", 0.05),
        "metal": gltf.material("grey metal", 0.4),
        "ceramic": gltf.material("glazed ceramic", 0.7, (0.8, 0.95, 1.0)),
        "picture": gltf.material("picture", 0.35, (0.6, 1.0, 0.8)),
        "shade": gltf.material("lamp shade", 0.6, (1.0, 0.9, 0.7), double_sided=True),
        "diffuser": gltf.material("lamp diffuser", 0.7, luminance_cd_m2=lamp_luminance),
    }


def window_wall():
    """The wall at z = 0 about the opening: four trapezoids, so that vertices meet vertices at every edge."""
    x0, y0, x1, y1 = WINDOW
    chart = Plane("+z", 0.0, (0.0, 0.0))
    chart.polygon([(0.0, 0.0), (WIDTH, 0.0), (x1, y0), (x0, y0)])
    chart.polygon([(WIDTH, 0.0), (WIDTH, HEIGHT), (x1, y1), (x1, y0)])
    chart.polygon([(WIDTH, HEIGHT), (0.0, HEIGHT), (x0, y1), (x1, y1)])
    chart.polygon([(0.0, HEIGHT), (0.0, 0.0), (x0, y0), (x0, y1)])
    return [chart]


def window_reveal():
    """The four sides of the opening, as deep as the wall."""
    x0, y0, x1, y1 = WINDOW
    outside = -WALL_THICKNESS
    return [
        wall("+x", x0, y0, outside, y1, 0.0),
        wall("-x", x1, y0, outside, y1, 0.0),
        wall("+y", y0, x0, outside, x1, 0.0),
        wall("-y", y1, x0, outside, x1, 0.0),
    ]


def add_shell(gltf, use):
    shapes.add(gltf, "floor", use["floor"], [wall("+y", 0.0, 0.0, 0.0, WIDTH, DEPTH)])
    shapes.add(gltf, "ceiling", use["ceiling"], [wall("-y", HEIGHT, 0.0, 0.0, WIDTH, DEPTH)])
    shapes.add(gltf, "wall_left", use["wall"], [wall("+x", 0.0, 0.0, 0.0, HEIGHT, DEPTH)])
    shapes.add(gltf, "wall_right", use["wall"], [wall("-x", WIDTH, 0.0, 0.0, HEIGHT, DEPTH)])
    shapes.add(gltf, "wall_door", use["wall"], [wall("-z", DEPTH, 0.0, 0.0, WIDTH, HEIGHT)])
    shapes.add(gltf, "wall_window", use["wall"], window_wall())
    shapes.add(gltf, "window_reveal", use["wall"], window_reveal())
    x0, y0, x1, y1 = WINDOW
    middle = 0.5 * (x0 + x1)
    mullion = box((middle - 0.03, y0, -0.22), (middle + 0.03, y1, -0.16), without=("-y", "+y"))
    shapes.add(gltf, "window_mullion", use["lacquer"], mullion)
    # 8 mm above the floor, as doors are.
    leaf = box((3.95, 0.008, DEPTH - 0.04), (4.83, 2.0, DEPTH), without=("+z",))
    shapes.add(gltf, "door", use["lacquer"], leaf)
    handle = box((4.0, 1.02, DEPTH - 0.09), (4.12, 1.045, DEPTH - 0.04), without=("+z",))
    shapes.add(gltf, "door_handle", use["metal"], handle)
    shapes.add(gltf, "radiator", use["lacquer"], box((1.8, 0.12, 0.05), (3.4, 0.7, 0.12)))


def curtain(left, right):
    """A cloth from x = left to right in ten folds, laid out on its chart at its true length."""
    folds, near, far, bottom, top = 10, 0.06, 0.12, 0.05, 2.45
    chart = Chart()
    step = (right - left) / folds
    length = math.hypot(step, far - near)
    for i in range(folds):
        x0, x1 = left + i * step, left + (i + 1) * step
        z0, z1 = (near, far) if i % 2 == 0 else (far, near)
        points = [(x0, bottom, z0), (x1, bottom, z1), (x1, top, z1), (x0, top, z0)]
        u0, u1, height = i * length, (i + 1) * length, top - bottom
        chart.face(points, [(u0, 0.0), (u1, 0.0), (u1, height), (u0, height)])
    return [chart]


def add_sofa(gltf, use):
    x0, x1, z0, z1 = 4.3, 5.15, 1.1, 3.1
    back, arm = 0.2, 0.18
    parts = box((x1 - back, 0.0, z0), (x1, 0.82, z1), without=("-y",))
    parts += box((x0, 0.0, z0), (x1 - back, 0.58, z0 + arm), without=("-y", "+x"))
    parts += box((x0, 0.0, z1 - arm), (x1 - back, 0.58, z1), without=("-y", "+x"))
    seat = ("-y", "+x", "-z", "+z")
    parts += box((x0 + 0.02, 0.0, z0 + arm), (x1 - back, 0.4, z1 - arm), without=seat)
    shapes.add(gltf, "sofa", use["fabric"], parts)
    middle = 0.5 * (z0 + z1)
    cushions = box((x0 + 0.03, 0.4, z0 + arm + 0.01), (x1 - back - 0.02, 0.48, middle - 0.01), without=("-y",))
    cushions += box((x0 + 0.03, 0.4, middle + 0.01), (x1 - back - 0.02, 0.48, z1 - arm - 0.01), without=("-y",))
    shapes.add(gltf, "sofa_cushions", use["cushion"], cushions)


def add_table(gltf, use):
    """Rug, table, what lies on it, and a receiver between: the sensor looks up from 5 mm above the table."""
    rug = 0.012
    shapes.add(gltf, "rug", use["rug"], box((2.3, 0.0, 1.2), (4.1, rug, 3.0), without=("-y",)))
    x, z = TABLE_CENTRE
    under, wide, deep, leg = TABLE_TOP - 0.03, 0.35, 0.6, 0.05
    shapes.add(gltf, "table_top", use["wood"], box((x - wide, under, z - deep), (x + wide, TABLE_TOP, z + deep)))
    legs = []
    for left in (x - wide + 0.02, x + wide - 0.02 - leg):
        for front in (z - deep + 0.02, z + deep - 0.02 - leg):
            legs += box((left, rug, front), (left + leg, under, front + leg), without=("-y", "+y"))
    shapes.add(gltf, "table_legs", use["wood"], legs)

    plate = [(0.06, 0.0), (0.11, 0.018), (0.11, 0.021), (0.06, 0.005), (0.0, 0.005)]
    for name, place in (("plate_left", (x - 0.15, z - 0.4)), ("plate_right", (x + 0.15, z - 0.4))):
        shapes.add_without_uvs(gltf, name, use["ceramic"], lathe(place, [(r, TABLE_TOP + y) for r, y in plate]))
    outside = [(0.04, 0.0), (0.065, 0.04), (0.075, 0.09), (0.065, 0.14), (0.04, 0.19), (0.035, 0.22), (0.045, 0.25)]
    inside = [(0.041, 0.25), (0.031, 0.22), (0.036, 0.19), (0.061, 0.14), (0.071, 0.09), (0.061, 0.04), (0.0, 0.01)]
    vase = lathe((x + 0.1, z + 0.4), [(r, TABLE_TOP + y) for r, y in outside + inside])
    shapes.add_without_uvs(gltf, "vase", use["ceramic"], vase)
    gltf.node(
        {
            "name": "sensor_on_table",
            "translation": [x, TABLE_TOP + 0.005, z],
            "rotation": list(POINTING_UP),
            "extras": {"receiver": {"area": 0.0001, "fov": 90}},
        }
    )


def add_shelf(gltf, use):
    """A shelf without a back at the wall with the door, and rows of books of differing size on its boards."""
    x0, x1, front, height, thick = 0.5, 2.1, DEPTH - 0.3, 1.9, 0.03
    parts = []
    for x in (x0, x1 - thick):
        parts += box((x, 0.0, front), (x + thick, height, DEPTH), without=("-y", "+z"))
    boards = (0.08, 0.46, 0.84, 1.22, 1.6, height - thick)
    for y in boards:
        parts += box((x0 + thick, y, front), (x1 - thick, y + thick, DEPTH), without=("-x", "+x", "+z"))
    shapes.add(gltf, "shelf", use["lacquer"], parts)

    rows = ((0, 0.60, 9), (1, 1.25, 11), (2, 0.60, 13), (3, 1.10, 8))  # board, where the row begins, books
    for row, (board, x, count) in enumerate(rows):
        books = []
        for i in range(count):
            wide = 0.025 + 0.005 * ((3 * i + row) % 5)
            tall = 0.22 + 0.02 * ((2 * i + 3 * row) % 6)
            deep = 0.15 + 0.01 * ((i + row) % 4)
            low = (x, boards[board] + thick, DEPTH - 0.03 - deep)
            books += box(low, (x + wide, low[1] + tall, DEPTH - 0.03), without=("-y",))
            x += wide + 0.003
        shapes.add(gltf, f"books_{row + 1}", use["books"], books)


def add_wall_furniture(gltf, use):
    """TV board and screen at the left wall, a picture in its frame at the right wall over the sofa."""
    shapes.add(gltf, "tv_board", use["lacquer"], box((0.0, 0.0, 1.1), (0.4, 0.42, 3.1), without=("-y", "-x")))
    shapes.add(gltf, "tv", use["screen"], box((0.12, 0.42, 1.45), (0.16, 1.15, 2.75), without=("-y",)))

    y0, y1, z0, z1, bar, front = 1.3, 1.9, 1.65, 2.55, 0.03, WIDTH - 0.025
    frame = box((front, y0, z0), (WIDTH, y0 + bar, z1), without=("+x",))
    frame += box((front, y1 - bar, z0), (WIDTH, y1, z1), without=("+x",))
    for z in (z0, z1 - bar):
        frame += box((front, y0 + bar, z), (WIDTH, y1 - bar, z + bar), without=("+x", "-y", "+y"))
    shapes.add(gltf, "picture_frame", use["wood"], frame)
    canvas = wall("-x", WIDTH - 0.01, y0 + bar, z0 + bar, y1 - bar, z1 - bar)
    shapes.add(gltf, "picture", use["picture"], [canvas])


def add_ceiling_lamps(gltf, use):
    """A flat round lamp, whose underside emits, and a spot over the table."""
    under = HEIGHT - 0.05
    corners = circle(LAMP_CENTRE, LAMP_RADIUS, LAMP_SEGMENTS)
    disc = Plane("-y", under, (LAMP_CENTRE[0] - LAMP_RADIUS, LAMP_CENTRE[1] - LAMP_RADIUS)).polygon(corners)
    shapes.add(gltf, "ceiling_lamp", use["diffuser"], [disc])
    rim = lathe(LAMP_CENTRE, [(LAMP_RADIUS, under), (LAMP_RADIUS, HEIGHT)], LAMP_SEGMENTS)
    shapes.add_without_uvs(gltf, "ceiling_lamp_rim", use["lacquer"], rim)

    housing = lathe(TABLE_CENTRE, [(0.0, 2.36), (0.04, 2.36), (0.04, HEIGHT)])
    shapes.add_without_uvs(gltf, "spot_housing", use["metal"], housing)
    spot = {"type": "spot", "intensity": 400.0, "spot": {"innerConeAngle": 0.3, "outerConeAngle": 0.5}}
    gltf.light("spot_over_table", (TABLE_CENTRE[0], 2.35, TABLE_CENTRE[1]), spot, POINTING_DOWN)


def add_floor_lamp(gltf, use):
    """A bulb under a shade that is open above and below, on a pole."""
    place = (4.75, 0.65)
    pole = lathe(place, [(0.14, 0.0), (0.14, 0.02), (0.012, 0.02), (0.012, 1.4), (0.0, 1.4)])
    shapes.add_without_uvs(gltf, "floor_lamp_pole", use["metal"], pole)
    shapes.add_without_uvs(gltf, "floor_lamp_shade", use["shade"], lathe(place, [(0.24, 1.32), (0.15, 1.62)]))
    bulb = {"type": "point", "intensity": 800.0 / (4.0 * math.pi)}
    gltf.light("floor_lamp", (place[0], 1.47, place[1]), bulb)


def add_reading_lamp(gltf, use):
    """A lamp beside the sofa that shines down from a small shade: a generalized Lambert emitter."""
    x, z, top = 4.9, 3.4, 0.5
    table = box((x - 0.18, 0.0, z - 0.18), (x + 0.18, top, z + 0.18), without=("-y",))
    shapes.add(gltf, "side_table", use["wood"], table)
    post, head, arm = z + 0.05, z - 0.15, 1.0
    foot = lathe((x, post), [(0.09, top), (0.09, top + 0.015), (0.0, top + 0.015)])
    shapes.add_without_uvs(gltf, "reading_lamp_foot", use["metal"], foot)
    stem = box((x - 0.01, top + 0.015, post - 0.01), (x + 0.01, arm, post + 0.01), without=("-y", "+y"))
    stem += box((x - 0.01, arm, head - 0.02), (x + 0.01, arm + 0.02, post + 0.01))
    shapes.add(gltf, "reading_lamp_stem", use["metal"], stem)
    socket = lathe((x, head), [(0.0, arm - 0.025), (0.009, arm - 0.025), (0.009, arm)], 12)
    shapes.add_without_uvs(gltf, "reading_lamp_socket", use["metal"], socket)
    shade = lathe((x, head), [(0.1, arm - 0.14), (0.03, arm - 0.03)])
    shapes.add_without_uvs(gltf, "reading_lamp_shade", use["shade"], shade)
    bulb = {"type": "point", "intensity": 300.0 / (4.0 * math.pi)}
    extras = {"lambert_exponent": 3, "power": 300, "unit": "lm"}
    gltf.light("reading_lamp", (x, arm - 0.035, head), bulb, POINTING_DOWN, extras)


def living_room():
    gltf = Gltf()
    use = materials(gltf)
    add_shell(gltf, use)
    shapes.add(gltf, "curtain_left", use["curtain"], curtain(0.9, 1.35))
    shapes.add(gltf, "curtain_right", use["curtain"], curtain(3.85, 4.3))
    add_sofa(gltf, use)
    add_table(gltf, use)
    add_shelf(gltf, use)
    add_wall_furniture(gltf, use)
    add_ceiling_lamps(gltf, use)
    add_floor_lamp(gltf, use)
    add_reading_lamp(gltf, use)
    return gltf
