#!/usr/bin/env python3
"""Checks that a folder of src/ includes only folders below it, that the files of a folder do not include each other in a
circle, that a library is included in its own folder only, and that the Python extension uses public headers.

Usage: check_layers.py PROJECT_DIR
"""
import pathlib
import re
import sys

# Layers from the lowest up; the adapters photometry, gltf and output see base, chance, room and the public headers.
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
    "photometry": ["base", "chance", "room"],
    "gltf": ["base", "chance", "room"],
    "output": ["base", "chance", "room"],
}
# Public headers by the layer that provides them: a layer may use its own headers and those of the layers below it.
PUBLIC = {
    "error": "base", "walk_direction": "base", "emitter_law": "chance", "candela_table": "chance", "intensity_cut": "chance", "luminous_opening": "chance", "units": "base", "version": "base", "visible_text": "base",
    "room": "room", "area": "room", "figure": "room", "emitter_parts": "room", "photometry": "room", "cover": "room", "cuboid": "room", "overrides": "room", "tiles": "room", "receiver_table": "room",
    "settings": "room", "channel": "room", "fingerprint": "room",  # plain data that every layer may read
    "communicator": "run", "control": "run", "progress": "run", "state": "run", "state_bytes": "run", "mpi": "mpi",
    "result": "run", "dimmed_scene": "run", "lay_areas": "run", "simulate": "run", "receivers": "run", "study": "run", "inspect": "inspect",
    "prepared_room": "tracer", "paths": "walk", "picture": "view", "area_drawing": "view",
    "gltf": "gltf", "lit_room": "gltf", "output": "output", "emitter_parts_file": "output", "compare": "output", "luminaire_figures": "output", "folder_lock": "output",
}
ADAPTERS_SEE_RESULTS = {"output": ["prepared_room", "result", "dimmed_scene", "inspect", "study", "picture", "area_drawing", "paths", "lit_room"], "gltf": ["result", "picture", "paths"]}
# Libraries that only these files or folders may include.
LIBRARIES = {
    r"embree\d?/": ["src/tracer/embree.hpp"],
    r"tiny_gltf": ["src/gltf/"],
    r"Imf|OpenEXR": ["src/output/", "tests/"],
    r"CLI/": ["apps/"],
    r"draco/": ["src/gltf/"],
    r"meshoptimizer": ["src/gltf/"],
    r"stb/": ["src/base/", "src/gltf/"],
    r"hwy/": ["src/chance/", "src/walk/"],
    r"hdf5\.h": ["src/base/hdf5", "src/store/", "src/output/channels_h5", "src/output/h5_"],
    r"matio": ["src/output/"],
    r"xxhash": ["src/base/", "python/src/"],
    r"mpi\.h": ["src/mpi/"],
    r"nanobind/|Python\.h": ["python/src/"],
    r"cereal/": ["python/src/"],
}
# The Python extension is a program like any other: public headers, its own, and the commands of the program.
BESIDE_PYTHON = ["python/src", "apps/lichtmc"]


def faults(project):
    for file in sorted(project.glob("src/*/*.[ch]pp")):
        layer = file.parent.name
        for include in re.findall(r'#include "([^"]+)"', file.read_text()):
            folder, _, name = include.partition("/")
            if folder == "lichtmc":
                provider = PUBLIC.get(name.removesuffix(".hpp"))
                allowed = [layer] + BELOW[layer]
                if provider not in allowed and name.removesuffix(".hpp") not in ADAPTERS_SEE_RESULTS.get(layer, []):
                    yield f"{file}: includes {include}, which belongs to the layer '{provider}'"
            elif folder != layer and folder not in BELOW[layer]:
                yield f"{file}: includes {include}, which is not below the layer '{layer}'"
    for file in sorted(project.glob("python/src/*.[ch]pp")):
        for include in re.findall(r'#include "([^"]+)"', file.read_text()):
            is_public = include.startswith("lichtmc/") and (project / "include" / include).exists()
            if not is_public and not any((project / folder / include).exists() for folder in BESIDE_PYTHON):
                yield f"{file}: includes {include}, which is neither a public header nor in {', '.join(BESIDE_PYTHON)}"
    for pattern in ("src/*/*.[ch]pp", "include/lichtmc/*.hpp", "apps/*/*.[ch]pp", "python/src/*.[ch]pp"):
        for file in sorted(project.glob(pattern)):
            name = file.relative_to(project).as_posix()
            for include in re.findall(r"#include <([^>]+)>", file.read_text()):
                for library, homes in LIBRARIES.items():
                    if re.match(library, include) and not any(name.startswith(home) for home in homes):
                        yield f"{file}: includes <{include}>, which only {', '.join(homes)} may"


def cycles(project):
    """Files of one folder that include each other in a circle; a header and its source count as one."""
    for folder in sorted(path for path in project.glob("src/*") if path.is_dir()):
        below = {}
        for file in folder.glob("*.[ch]pp"):
            found = re.findall(rf'#include "{folder.name}/([^"]+)\.hpp"', file.read_text())
            below.setdefault(file.stem, set()).update(set(found) - {file.stem})
        while True:
            leaves = {name for name, others in below.items() if not others & below.keys()}
            if not leaves:
                break
            below = {name: others for name, others in below.items() if name not in leaves}
        if below:
            yield f"{folder}: these files include each other in a circle, or include such files: {', '.join(sorted(below))}"


def main():
    project = pathlib.Path(sys.argv[1])
    found = list(faults(project)) + list(cycles(project))
    print("\n".join(found) or "every include points downwards")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
