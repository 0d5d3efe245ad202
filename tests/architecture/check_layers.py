#!/usr/bin/env python3
"""Checks that a folder of src/ includes only folders below it, and that a library is named in its own folder only.

Usage: check_floors.py PROJECT_DIR
"""
import pathlib
import re
import sys

# Floors from the ground up; the wings gltf and output see base, chance, room and the public headers.
BELOW = {
    "base": [],
    "chance": ["base"],
    "room": ["base", "chance"],
    "tracer": ["base", "chance", "room"],
    "walk": ["base", "chance", "room", "tracer"],
    "run": ["base", "chance", "room", "tracer", "walk"],
    "store": ["base", "chance", "room", "tracer", "walk", "run"],
    "inspect": ["base", "chance", "room", "tracer", "walk", "run"],
    "view": ["base", "chance", "room", "tracer", "walk", "run"],
    "mpi": ["base", "run"],
    "gltf": ["base", "chance", "room"],
    "output": ["base", "chance", "room"],
}
# Public headers by the floor that provides them: a floor may use those of floors below it and its own.
PUBLIC = {
    "error": "base", "walk_direction": "base", "emitter_law": "chance", "units": "base", "version": "base",
    "room": "room", "cuboid": "room", "overrides": "room", "tiles": "room",
    "settings": "room", "state": "room",  # plain data that every floor may read
    "communicator": "run", "mpi": "mpi",
    "result": "run", "simulate": "run", "receivers": "run", "study": "run", "inspect": "inspect",
    "paths": "walk", "picture": "view",
    "gltf": "gltf", "lit_room": "gltf", "output": "output", "compare": "output",
}
WINGS_SEE_RESULTS = {"output": ["result", "inspect", "study", "picture", "paths", "lit_room"], "gltf": ["result", "picture", "paths"]}
# Libraries that one file or folder alone may name.
LIBRARIES = {
    r"embree\d?/": ["src/tracer/embree.hpp"],
    r"tiny_gltf": ["src/gltf/"],
    r"Imf|OpenEXR": ["src/output/", "tests/"],
    r"CLI/": ["apps/"],
    r"draco/": ["src/gltf/"],
    r"meshoptimizer": ["src/gltf/"],
    r"stb/": ["src/base/", "src/gltf/"],
    r"hwy/": ["src/chance/", "src/walk/"],
    r"libfccp": ["src/output/"],
    r"hdf5\.h": ["src/store/"],
    r"xxhash": ["src/base/"],
    r"mpi\.h": ["src/mpi/"],
}


def faults(project):
    for file in sorted(project.glob("src/*/*.[ch]pp")):
        floor = file.parent.name
        for include in re.findall(r'#include "([^"]+)"', file.read_text()):
            folder, _, name = include.partition("/")
            if folder == "lichtmc":
                provider = PUBLIC.get(name.removesuffix(".hpp"))
                allowed = [floor] + BELOW[floor]
                if provider not in allowed and name.removesuffix(".hpp") not in WINGS_SEE_RESULTS.get(floor, []):
                    yield f"{file}: includes {include}, which belongs to the floor '{provider}'"
            elif folder != floor and folder not in BELOW[floor]:
                yield f"{file}: includes {include}, which is not below the floor '{floor}'"
    for pattern in ("src/*/*.[ch]pp", "include/lichtmc/*.hpp", "apps/*/*.[ch]pp"):
        for file in sorted(project.glob(pattern)):
            name = file.relative_to(project).as_posix()
            for include in re.findall(r"#include <([^>]+)>", file.read_text()):
                for library, homes in LIBRARIES.items():
                    if re.match(library, include) and not any(name.startswith(home) for home in homes):
                        yield f"{file}: includes <{include}>, which only {', '.join(homes)} may"


def main():
    project = pathlib.Path(sys.argv[1])
    found = list(faults(project))
    print("\n".join(found) or "every include points downwards")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
