#!/usr/bin/env python3
"""Measures time and memory of large models: scenes/living_room.glb with every triangle divided into four, several times,
and with small tiles.

    tools/large_models.py [PROGRAM]      default: build/release/bin/lichtmc; takes some minutes and 100 MB in a temporary folder

For each command: CPU seconds, elapsed seconds, largest memory of the process (VmHWM), and the memory that `check` has told.
The machine should do nothing else. docs/performance.md has the results.
"""
import array
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import time

PROJECT = pathlib.Path(__file__).resolve().parent.parent
ROOM = PROJECT / "scenes" / "living_room.glb"
CODES = {5126: ("f", 4), 5123: ("H", 2), 5125: ("I", 4)}
WIDTH = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}
NAMES = {width: name for name, width in WIDTH.items()}


def read_glb(file):
    data = file.read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20:20 + length]), data[28 + length:]


def numbers_of(model, blob, index):
    accessor = model["accessors"][index]
    view = model["bufferViews"][accessor["bufferView"]]
    code, size = CODES[accessor["componentType"]]
    first = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    return array.array(code, blob[first:first + accessor["count"] * WIDTH[accessor["type"]] * size])


def divided(attributes, indices):
    """Every triangle as four, with the middles of its sides; `attributes`: (width, numbers) by name."""
    vertices = len(attributes["POSITION"][1]) // 3
    middles, fine = {}, array.array("I")

    def middle(a, b):
        key = (a, b) if a < b else (b, a)
        if key not in middles:
            middles[key] = vertices + len(middles)
            for width, numbers in attributes.values():
                numbers.extend([0.5 * (numbers[width * a + k] + numbers[width * b + k]) for k in range(width)])
        return middles[key]

    for n in range(0, len(indices), 3):
        a, b, c = indices[n:n + 3]
        ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
        fine.extend((a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca))
    return fine


def subdivide(file, times):
    """Writes the living room with every triangle divided `times` times; returns the number of triangles."""
    model, blob = read_glb(ROOM)
    out, views, accessors, triangles = bytearray(), [], [], 0

    def add(numbers, kind, code, bounds=False):
        views.append({"buffer": 0, "byteOffset": len(out), "byteLength": len(numbers) * numbers.itemsize})
        out.extend(numbers.tobytes())
        width = WIDTH[kind]
        accessor = {"bufferView": len(views) - 1, "componentType": code, "count": len(numbers) // width, "type": kind}
        if bounds:
            accessor["min"] = [min(numbers[k::width]) for k in range(width)]
            accessor["max"] = [max(numbers[k::width]) for k in range(width)]
        accessors.append(accessor)
        return len(accessors) - 1

    for mesh in model["meshes"]:
        for primitive in mesh["primitives"]:
            attributes = {name: (WIDTH[model["accessors"][index]["type"]], numbers_of(model, blob, index))
                          for name, index in primitive["attributes"].items()}
            indices = array.array("I", numbers_of(model, blob, primitive["indices"]))
            for _ in range(times):
                indices = divided(attributes, indices)
            triangles += len(indices) // 3
            primitive["attributes"] = {name: add(numbers, NAMES[width], 5126, name == "POSITION")
                                       for name, (width, numbers) in attributes.items()}
            primitive["indices"] = add(indices, "SCALAR", 5125)
    model.update(bufferViews=views, accessors=accessors, buffers=[{"byteLength": len(out)}])
    text = json.dumps(model, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    file.write_bytes(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(out)) + struct.pack("<II", len(text), 0x4E4F534A)
                     + text + struct.pack("<II", len(out), 0x4E4942) + out)
    return triangles


def measure(command):
    began = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: exit status {process.returncode}")
    return usage.ru_utime + usage.ru_stime, time.monotonic() - began, usage.ru_maxrss * 1024.0


def told(program, room, options):
    done = subprocess.run([program, "check", room, "--json", *options], stdout=subprocess.PIPE, check=True)
    return json.loads(done.stdout)["memory_bytes"]


def main():
    program = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else PROJECT / "build/release/bin/lichtmc").resolve()
    print(f"{'room':20} {'command':28} {'CPU s':>7} {'elapsed s':>9} {'memory MB':>9} {'told MB':>8}")
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        cases = []
        for times in (3, 4, 5):
            file = folder / f"divided_{times}.glb"
            cases.append((f"{subdivide(file, times)} triangles", file, []))
        cases += [(f"tiles of {tile} m", ROOM, ["--tile", tile]) for tile in ("0.0112", "0.0056")]
        run = ["--estimator", "collision", "--threads", "2", "-o", folder / "out"]
        few = ["--photons", "1024", "--only", "tiles", "--no-report", "--no-images"]
        for name, room, options in cases:
            memory = told(program, room, options)
            for command, arguments in (("check", ["check", room, *options]),
                                       ("run, 1024 photons, no report", ["run", room, *options, *run, *few]),
                                       ("run, 1 million photons", ["run", room, *options, *run, "--photons", "1M"])):
                cpu, elapsed, most = measure([program, *arguments])
                print(f"{name:20} {command:28} {cpu:7.1f} {elapsed:9.1f} {most / 1e6:9.0f} {memory / 1e6:8.0f}", flush=True)


if __name__ == "__main__":
    main()
