"""Reads what the comparison needs of a glTF file: triangles in metres, reflectances, texture coordinates.

Files are .glb or .gltf. Only what the rooms of scenes/ and the files of lichtmc contain is read: indexed triangles,
tightly packed accessors, one buffer inside the file, materials with the property `reflectance`, nodes without scale or
matrix. Anything else is an error.
"""

import base64
import dataclasses
import json
import struct

import numpy as np

COMPONENTS = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}


@dataclasses.dataclass
class Part:
    """The triangles of one material of one node."""

    node: str
    material: dict
    triangles: np.ndarray  # [triangle, corner, axis], m
    uvs: np.ndarray | None  # [triangle, corner, axis]


def read_file(path):
    """The JSON and the bytes of the only buffer."""
    content = path.read_bytes()
    if content[:4] == b"glTF":
        length = struct.unpack_from("<I", content, 12)[0]
        return json.loads(content[20 : 20 + length]), content[20 + length + 8 :]
    document = json.loads(content)
    (buffer,) = document["buffers"]
    return document, base64.b64decode(buffer["uri"].partition("base64,")[2])


def read_accessor(document, buffer, index):
    accessor = document["accessors"][index]
    view = document["bufferViews"][accessor["bufferView"]]
    kind, width = np.dtype(COMPONENTS[accessor["componentType"]]), WIDTHS[accessor["type"]]
    if view.get("byteStride", kind.itemsize * width) != kind.itemsize * width:
        raise ValueError(f"accessor {index} is not tightly packed")
    offset = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    return np.frombuffer(buffer, kind, accessor["count"] * width, offset).reshape(-1, width)


def rotation_matrix(quaternion):
    x, y, z, w = quaternion
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def read_parts(path):
    """All parts of the room, in the order of the nodes."""
    document, buffer = read_file(path)
    parts = []
    for node in document["nodes"]:
        if "mesh" not in node:
            continue
        if {"matrix", "scale", "children"} & node.keys():
            raise ValueError(f"node {node['name']}: matrix, scale and children are not read")
        turn = rotation_matrix(node.get("rotation", (0, 0, 0, 1)))
        for primitive in document["meshes"][node["mesh"]]["primitives"]:
            attributes = primitive["attributes"]
            corners = read_accessor(document, buffer, primitive["indices"]).reshape(-1, 3)
            positions = read_accessor(document, buffer, attributes["POSITION"]).astype(float)
            positions = positions @ turn.T + node.get("translation", (0, 0, 0))
            uvs = None
            if "TEXCOORD_0" in attributes:
                uvs = read_accessor(document, buffer, attributes["TEXCOORD_0"]).astype(float)[corners]
            parts.append(Part(node["name"], document["materials"][primitive["material"]], positions[corners], uvs))
    return parts


def triangles_by_reflectance(parts):
    """{reflectance: triangles}"""
    groups = {}
    for part in parts:
        groups.setdefault(float(part.material["extras"]["reflectance"]), []).append(part.triangles)
    return {reflectance: np.concatenate(group) for reflectance, group in groups.items()}


EMITTING = {"power", "unit", "lambert_exponent", "delay_ns", "ies"}  # custom properties
LAMPS = {"KHR_lights_punctual", "EXT_lights_ies"}
SHINING = {"KHR_materials_emissive_strength"}


def without(item, key, names):
    """Takes these names out of the dictionary or the list item[key], and that out of the item if it is empty then."""
    if key in item:
        left = [name for name in item[key] if name not in names]
        item[key] = {name: item[key][name] for name in left} if isinstance(item[key], dict) else left
        if not left:
            del item[key]


def write_without_emitters(source, target, keep_receivers=False):
    """Copies a room: what emitted light stays as a body and emits none."""
    document, buffer = read_file(source)
    for material in document.get("materials", []):
        material.pop("emissiveFactor", None)
        material.pop("emissiveTexture", None)
        without(material, "extensions", SHINING)
        without(material, "extras", EMITTING)
    for node in document["nodes"]:
        without(node, "extensions", LAMPS)
        without(node, "extras", EMITTING if keep_receivers else EMITTING | {"receiver"})
    without(document, "extensions", LAMPS)
    for key in ("extensionsUsed", "extensionsRequired"):
        without(document, key, LAMPS | SHINING)
    write_glb(document, buffer, target)


def write_glb(document, buffer, target):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    header = struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(buffer))
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(buffer), b"BIN\0") + buffer
    target.write_bytes(header + chunks)


def lit_triangles(path):
    """{reflectance: triangles} of a room_lit.glb of lichtmc: the surfaces of a run where they stand, m."""
    parts = read_parts(path)
    told = {part.node: part.material["extras"]["lichtmc"]["reflectance"] for part in parts if is_lit(part)}
    groups = {}
    for part in parts:
        # Triangles of a surface that no light reaches have a material of their own.
        if is_lit(part) or part.node in told and part.material["name"] == "no light":
            groups.setdefault(told[part.node], []).append(part.triangles)
    return {reflectance: np.concatenate(group) for reflectance, group in groups.items()}


def is_lit(part):
    return "reflectance" in part.material.get("extras", {}).get("lichtmc", {})
