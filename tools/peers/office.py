"""Writes an office as glTF: a room with desks, a partition and a cupboard, without lamps."""

import struct

import gltf_room

SIZE = (7.2, 2.8, 5.4)  # m, Y up; one corner is the origin
REFLECTANCES = {"floor": 0.2, "walls": 0.5, "ceiling": 0.7, "wood": 0.4, "partition": 0.35}
# Corners of the boxes that stand in the room: (low, high), m, and their material.
FURNITURE = {
    "desk_0": ((1.0, 0.70, 1.0), (2.6, 0.73, 1.8), "wood"),
    "desk_1": ((1.0, 0.70, 3.6), (2.6, 0.73, 4.4), "wood"),
    "desk_2": ((3.8, 0.70, 1.0), (5.4, 0.73, 1.8), "wood"),
    "desk_3": ((3.8, 0.70, 3.6), (5.4, 0.73, 4.4), "wood"),
    "partition": ((1.0, 0.0, 2.675), (5.4, 1.4, 2.725), "partition"),
    "cupboard": ((6.7, 0.0, 1.2), (7.15, 2.0, 4.2), "wood"),
}


def sides(low, high, inwards=False):
    """The four corners of the six sides of a box, in the order −x, +x, −y, +y, −z, +z."""
    found = []
    for axis in range(3):
        b, c = (axis + 1) % 3, (axis + 2) % 3
        for end in (low, high):
            corners = []
            for u, v in ((low, low), (high, low), (high, high), (low, high)):
                corner = [0.0] * 3
                corner[axis], corner[b], corner[c] = end[axis], u[b], v[c]
                corners.append(corner)
            found.append(corners[:: 1 if (end is high) != inwards else -1])
    return found


def surfaces():
    """(name, material, quadrilaterals)"""
    left, right, floor, ceiling, back, front = sides((0.0, 0.0, 0.0), SIZE, inwards=True)
    yield "floor", "floor", [floor]
    yield "ceiling", "ceiling", [ceiling]
    yield "walls", "walls", [left, right, back, front]
    for name, (low, high, material) in FURNITURE.items():
        yield name, material, sides(low, high)


def write_office(path):
    names = list(REFLECTANCES)
    materials = [{"name": name, "extras": {"reflectance": value}} for name, value in REFLECTANCES.items()]
    document = {"asset": {"version": "2.0"}, "scene": 0, "materials": materials}
    document |= {key: [] for key in ("nodes", "meshes", "accessors", "bufferViews")}
    buffer = b""

    def accessor(data, **what):
        nonlocal buffer
        document["bufferViews"].append({"buffer": 0, "byteOffset": len(buffer), "byteLength": len(data)})
        document["accessors"].append({"bufferView": len(document["bufferViews"]) - 1, **what})
        buffer += data
        return len(document["accessors"]) - 1

    for name, material, quadrilaterals in surfaces():
        corners = [corner for four in quadrilaterals for corner in four]
        ends = {"min": [min(x) for x in zip(*corners)], "max": [max(x) for x in zip(*corners)]}
        indices = [4 * k + n for k in range(len(quadrilaterals)) for n in (0, 1, 2, 0, 2, 3)]
        places = struct.pack(f"<{3 * len(corners)}f", *(x for corner in corners for x in corner))
        position = accessor(places, componentType=5126, count=len(corners), type="VEC3", **ends)
        order = struct.pack(f"<{len(indices)}I", *indices)
        index = accessor(order, componentType=5125, count=len(indices), type="SCALAR")
        part = {"attributes": {"POSITION": position}, "indices": index, "material": names.index(material)}
        document["nodes"].append({"name": name, "mesh": len(document["meshes"])})
        document["meshes"].append({"name": name, "primitives": [part]})
    document["scenes"] = [{"nodes": list(range(len(document["nodes"])))}]
    document["buffers"] = [{"byteLength": len(buffer)}]
    gltf_room.write_glb(document, buffer, path)
