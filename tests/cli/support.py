"""Shared by the tests of the command line: the program, temporary folders, small glTF rooms."""
import base64
import copy
import json
import os
import pathlib
import struct
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["LICHTMC_PROGRAM"]
SCENES = pathlib.Path(os.environ["LICHTMC_SCENES"])


def lichtmc(*arguments, timeout=60, **options):
    """Runs the program; stdout and stderr as text."""
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=timeout, check=False, **options)


class ProgramTest(unittest.TestCase):
    """A test with a temporary folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def refused(self, *arguments, says, status=2):
        """The program must end with this status and one message that contains all these words, and print nothing else
        but warnings before it."""
        done = lichtmc(*arguments)
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertEqual(done.stdout, "")
        lines = done.stderr.splitlines(keepends=True)
        while lines and lines[0].startswith(("Warning: ", "Note: ")):
            lines.pop(0)
        message = "".join(lines)
        self.assertTrue(message.startswith("lichtmc: "), done.stderr)
        for word in says:
            self.assertIn(word, message)
        return message

    def write_gltf(self, document, name="room.gltf"):
        path = self.folder / name
        path.write_text(json.dumps(document))
        return path


def triangle_room(positions=((0, 0, 0), (0, 0, 1), (1, 0, 0)), reflectance=0.5):
    """A glTF document with one triangle and a point light above it."""
    data = b"".join(struct.pack("<3f", *p) for p in positions)
    return copy.deepcopy({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [
            {"name": "floor", "mesh": 0},
            {"name": "lamp", "translation": [0.2, 1, 0.2], "extensions": {"KHR_lights_punctual": {"light": 0}}},
        ],
        "meshes": [{"name": "triangle", "primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "materials": [{"name": "paint", "extras": {"reflectance": reflectance}}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(positions), "type": "VEC3",
                       "min": [0, 0, 0], "max": [1, 0, 1]}],
        "bufferViews": [{"buffer": 0, "byteLength": len(data)}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 10}]}},
    })
