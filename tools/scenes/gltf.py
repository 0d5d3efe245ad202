"""A glTF 2.0 file under construction: materials, meshes, lights and nodes, written as .gltf or .glb.

Lengths are metres, Y is up. Everything a file holds follows from the calls made, in their order: the same calls give
the same bytes.
"""

import array
import base64
import json
import math
import struct
import sys

FLOAT, UNSIGNED_SHORT = 5126, 5123  # componentType of the specification
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963  # bufferView.target
TRIANGLES = 4  # primitive.mode

# Weights of linear red, green and blue in luminance, ITU-R BT.709.
REC709 = (0.2126, 0.7152, 0.0722)

# Rotations that turn a node's -Z, the direction of lights and receivers, to where it is wanted (x, y, z, w).
POINTING_DOWN = (-math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5))
POINTING_UP = (math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5))


def luminance(color):
    return sum(weight * part for weight, part in zip(REC709, color))


def packed(kind, numbers):
    """The numbers as little-endian bytes; kind as in the module array: "f" float32, "H" uint16."""
    values = array.array(kind, numbers)
    if sys.byteorder == "big":
        values.byteswap()
    return values.tobytes()


class Gltf:
    """Collects what a file holds; `write` puts it on disk."""

    def __init__(self):
        self.json = {
            "asset": {"version": "2.0", "generator": "lichtmc tools/make_scenes.py"},
            "scene": 0,
            "scenes": [{"name": "room", "nodes": []}],
        }
        self.binary = bytearray()

    def material(self, name, reflectance, tint=(1.0, 1.0, 1.0), double_sided=False, luminance_cd_m2=0.0):
        """Adds a diffuse material and gives its index.

        reflectance is what the simulation uses; tint is a hue in linear RGB, scaled such that the base colour that
        viewers show has the luminance `reflectance`. luminance_cd_m2 > 0 makes the material emit.
        """
        scale = reflectance / luminance(tint)
        color = [round(scale * part, 6) for part in tint]
        if max(color) > 1.0:
            raise ValueError(f"material {name}: no colour of this tint is as light as {reflectance}")
        material = {
            "name": name,
            "pbrMetallicRoughness": {"baseColorFactor": color + [1.0], "metallicFactor": 0.0, "roughnessFactor": 1.0},
            "extras": {"reflectance": reflectance},
        }
        if double_sided:
            material["doubleSided"] = True
        if luminance_cd_m2 > 0.0:
            self._use("KHR_materials_emissive_strength")
            material["emissiveFactor"] = [1.0, 1.0, 1.0]
            material["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": luminance_cd_m2}}
        return self._add("materials", material)

    def surface(self, name, material, positions, normals, uvs, triangles):
        """Adds a mesh of one primitive and a node that shows it.

        positions and normals are lists of (x, y, z), uvs of (u, v) or None, triangles of three indices each.
        """
        attributes = {
            "POSITION": self._floats(positions, "VEC3", bounds=True),
            "NORMAL": self._floats(normals, "VEC3"),
        }
        if uvs is not None:
            attributes["TEXCOORD_0"] = self._floats(uvs, "VEC2")
        primitive = {
            "attributes": attributes,
            "indices": self._indices(triangles, len(positions)),
            "material": material,
            "mode": TRIANGLES,
        }
        mesh = self._add("meshes", {"name": name, "primitives": [primitive]})
        self.node({"name": name, "mesh": mesh})

    def light(self, name, position, light, rotation=None, extras=None):
        """Adds a light of KHR_lights_punctual and a node that carries it; extras belong to the node."""
        self._use("KHR_lights_punctual")
        lights = self.json.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {"lights": []})["lights"]
        lights.append({"name": name, **light})
        node = {"name": name, "translation": list(position)}
        if rotation is not None:
            node["rotation"] = list(rotation)
        if extras is not None:
            node["extras"] = extras
        node["extensions"] = {"KHR_lights_punctual": {"light": len(lights) - 1}}
        self.node(node)

    def node(self, node):
        """Adds a node, given as the JSON object it is, to the scene."""
        self.json["scenes"][0]["nodes"].append(self._add("nodes", node))

    def write(self, path):
        """Writes the file: .glb binary, .gltf with the buffer embedded as base64."""
        content = dict(self.json)
        if path.suffix == ".glb":
            content["buffers"] = [{"byteLength": len(self.binary)}]
            path.write_bytes(self._container(content))
        else:
            data = base64.b64encode(self.binary).decode("ascii")
            uri = "data:application/octet-stream;base64," + data
            content["buffers"] = [{"byteLength": len(self.binary), "uri": uri}]
            path.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8", newline="\n")

    def triangle_count(self):
        return sum(
            self.json["accessors"][primitive["indices"]]["count"] // 3
            for mesh in self.json["meshes"]
            for primitive in mesh["primitives"]
        )

    def _container(self, content):
        """The GLB container: header, JSON chunk padded with spaces, binary chunk padded with zeros, to 4 bytes."""
        text = json.dumps(content, separators=(",", ":")).encode("utf-8")
        text += b" " * (-len(text) % 4)
        binary = bytes(self.binary) + b"\0" * (-len(self.binary) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(binary), b"BIN\0") + binary
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks

    def _add(self, kind, item):
        items = self.json.setdefault(kind, [])
        items.append(item)
        return len(items) - 1

    def _use(self, extension):
        used = self.json.setdefault("extensionsUsed", [])
        if extension not in used:
            used.append(extension)

    def _view(self, data, target):
        self.binary += b"\0" * (-len(self.binary) % 4)  # accessors must be aligned to their component's size
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data), "target": target}
        self.binary += data
        return self._add("bufferViews", view)

    def _floats(self, rows, kind, bounds=False):
        data = packed("f", (number for row in rows for number in row))
        view = self._view(data, ARRAY_BUFFER)
        accessor = {"bufferView": view, "componentType": FLOAT, "count": len(rows), "type": kind}
        if bounds:
            # Of the numbers as stored: a bound rounded less than they are would not hold them.
            width = len(rows[0])
            stored = struct.unpack(f"<{len(rows) * width}f", data)
            accessor["min"] = [min(stored[i::width]) for i in range(width)]
            accessor["max"] = [max(stored[i::width]) for i in range(width)]
        return self._add("accessors", accessor)

    def _indices(self, triangles, vertices):
        if vertices > 65535:  # 65535 is the primitive-restart value and must not appear
            raise ValueError(f"{vertices} vertices are too many for 16-bit indices")
        data = packed("H", (index for triangle in triangles for index in triangle))
        view = self._view(data, ELEMENT_ARRAY_BUFFER)
        count = 3 * len(triangles)
        return self._add(
            "accessors", {"bufferView": view, "componentType": UNSIGNED_SHORT, "count": count, "type": "SCALAR"}
        )
