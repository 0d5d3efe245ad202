#!/usr/bin/env python3
"""Checks that no source can omit a new emitter law: a source that treats the shapes of emitters one by one does not
compile until it treats the new one, and a source that treats them all alike compiles without a change.

Usage: check_laws.py PROJECT_DIR BUILD_DIR

Adds a shape UnknownEmitter with a law UnknownLaw to a copy of the public headers and compiles sources against this copy
with the commands of BUILD_DIR/compile_commands.json (syntax only).
"""
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

UNKNOWN = r"Unknown(Emitter|Law)"
# What names one of these works with any shape or any law.
TREATS_ALL = r"\b(visit_shape|law_of|emitting_surface|PointShape|EmitterLaw|light_source\.hpp|launcher\.hpp)\b"
# These sources name a shape and compile with an unknown one, for the reason given.
ONLY_CREATE = {
    "src/gltf/lights.cpp": "creates the emitters that a file describes",
    "src/inspect/inspect.cpp": "creates an isotropic emitter to test a room without emitters",
    "src/run/lit_space.cpp": "creates an isotropic emitter to find the rooms of a building without emitters",
    "apps/lichtmc/light_spec.cpp": "creates the emitters of --light",
    "src/room/measured_emitter.cpp": "has the law of luminaires with photometric files",
    "src/room/room.cpp": "checks the axes of luminaires, beside what all shapes have",
    "apps/lichtmc_bench/luminaire_rows.cpp": "creates emitters of benchmark rooms",
    "apps/lichtmc_bench/channel.cpp": "creates emitters of benchmark rooms",
    "apps/lichtmc_bench/points.cpp": "creates emitters of benchmark rooms",
    "apps/lichtmc_bench/main.cpp": "creates emitters of benchmark rooms",
    "apps/lichtmc_bench/rooms.cpp": "creates emitters of benchmark rooms",
    "apps/lichtmc_bench/storey.cpp": "creates emitters of benchmark rooms",
}
LAW = """struct UnknownLaw {
  glm::dvec3 sample(double u, double turns) const { return direction_at(2.0 * u, turns); }
  double density(const glm::dvec3& /*local*/) const { return 1.0 / (4.0 * std::numbers::pi); }
  EmitterExtent extent() const { return {std::numbers::pi, std::numbers::pi}; }
  std::optional<LawFault> fault() const { return std::nullopt; }
  static constexpr std::string_view name() { return "unknown"; }
};

"""
SHAPE = """struct UnknownEmitter {
  glm::dvec3 position{0.0};
  UnknownLaw law() const { return {}; }
};

"""
# (header, text that occurs once, what replaces it)
CHANGES = [
    ("emitter_law.hpp", "using EmitterLaw = ", LAW + "using EmitterLaw = "),
    ("emitter_law.hpp", "std::variant<IsotropicLaw, ", "std::variant<UnknownLaw, IsotropicLaw, "),
    ("emitter_law.hpp", "static_assert(DirectionalLaw<", "static_assert(DirectionalLaw<UnknownLaw> && DirectionalLaw<"),
    ("room.hpp", "struct Emitter {", SHAPE + "struct Emitter {"),
    ("room.hpp", "> shape;", ", UnknownEmitter> shape;"),
]


def point_shapes(project):
    """A pattern of the names of all shapes but that of area lights."""
    text = (project / "include/lichtmc/room.hpp").read_text()
    names = re.search(r"std::variant<([\w,\s]+)> shape;", text)[1].split(",")
    return r"\b(" + "|".join(name.strip() for name in names if name.strip() != "SurfaceEmitter") + r")\b"


def sources(project):
    for pattern in ("src/*/*.[ch]pp", "apps/*/*.[ch]pp"):
        for file in sorted(project.glob(pattern)):
            yield file.relative_to(project).as_posix(), file.read_text()


def change_headers(folder):
    for header, old, new in CHANGES:
        file = folder / "lichtmc" / header
        text = file.read_text()
        if text.count(old) != 1:
            sys.exit(f"{header} holds '{old}' {text.count(old)} times (expected: once). Adapt CHANGES in this script.")
        file.write_text(text.replace(old, new))


def compiled_by(file):
    """The sources that a file of the build compiles: those that a file of CMake's folder Unity includes, or itself."""
    if file.parent.name != "Unity":
        return [file]
    return [pathlib.Path(path) for path in re.findall(r'#include "([^"]+)"', file.read_text())]


def syntax_commands(project, build):
    """The compile command of each source, without its outputs, with its folder."""
    commands = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        file = pathlib.Path(entry["directory"], entry["file"])
        if not file.is_relative_to(project):
            continue
        words = shlex.split(entry["command"]) if "command" in entry else entry["arguments"]
        kept = []
        skip = False
        for word in words:
            if skip:
                skip = False
            elif word in ("-o", "-MF", "-MT", "-MQ"):
                skip = True
            elif word not in ("-c", "-MD", "-MMD"):
                kept.append(word)
        for source in compiled_by(file):
            own = [str(source) if word == entry["file"] else word for word in kept]
            commands[source.relative_to(project).as_posix()] = (own + ["-fsyntax-only"], entry["directory"])
    return commands


def compile_source(command, headers):
    """The compiler's messages, or None where it accepts the source."""
    words, folder = command
    at = next(k for k, word in enumerate(words) if word.startswith("-"))  # before the other include folders
    words = words[:at] + [f"-I{headers}"] + words[at:]
    done = subprocess.run(words, cwd=folder, capture_output=True, text=True, env=dict(os.environ, LC_ALL="C"))
    return None if done.returncode == 0 else done.stderr


def chains_of_ifs(name, text):
    for match in re.finditer(r"\b(get_if|holds_alternative)\s*<([^>]*)>\s*\(([^)]*)", text):
        if "Emitter" in match[2] or re.search(r"\bshape\b", match[3]):
            yield f"{name}: {match[1]}<{match[2]}> on the shape of an emitter. Use visit_shape() or std::visit()."


def check_chains(texts):
    """A chain of ifs over the alternatives compiles when one is missing: it is not allowed for Emitter::shape."""
    for sample in ("std::get_if<SpotEmitter>(&emitter.shape)", "std::holds_alternative<Spot>(emitter.shape)"):
        if not list(chains_of_ifs("", sample)):
            sys.exit(f"this script does not recognise {sample}")
    faults = [fault for name, text in texts.items() for fault in chains_of_ifs(name, text)]
    if not faults:
        print(f"{len(texts)} files: no get_if or holds_alternative on the shape of an emitter")
    return faults


def judge_treats_each(name, messages):
    """For a source that treats the shapes one by one: a fault, or None and a line of output. The build has compiled it
    with the headers as they are."""
    if messages is None:
        return (f"{name}: names shapes of emitters and compiles although one is not treated. Visit all shapes, or list "
                "it in ONLY_CREATE with the reason.")
    reasons = [line for line in messages.splitlines() if re.search(UNKNOWN, line)]
    if not reasons:
        return f"{name}: fails for another reason than the unknown law:\n{messages}"
    reason = next((line for line in reasons if " error: " in line), reasons[0])
    print(f"{name}: compiles; with an unknown law it does not: {re.sub(r'^.*(error|note): ', '', reason)}")
    return None


def judge_treats_all(name, messages):
    if messages is None:
        print(f"{name}: compiles with an unknown law: {ONLY_CREATE.get(name, 'treats all laws alike')}")
        return None
    if re.search(UNKNOWN, messages):
        return f"{name}: does not compile with an unknown law, but is expected to treat all laws alike:\n{messages}"
    return f"{name}: fails for another reason than the unknown law:\n{messages}"


def check_compilation(project, build, texts):
    shapes = point_shapes(project)
    naming = [name for name, text in texts.items() if re.search(shapes, text)]
    faults = [f"{name}: is in the list ONLY_CREATE, but names no shape" for name in ONLY_CREATE if name not in naming]
    faults += [f"{name}: a header that names a shape is not checked here. Move that to a source."
               for name in naming if name.endswith(".hpp")]
    treat_each = [name for name in naming if name.endswith(".cpp") and name not in ONLY_CREATE]
    treat_all = [name for name, text in texts.items()
                 if name.endswith(".cpp") and name not in naming and re.search(TREATS_ALL, text)] + list(ONLY_CREATE)
    commands = syntax_commands(project, build)
    built = [name for name in treat_each + treat_all if name in commands]
    for name in treat_each + treat_all:
        if name not in built:
            print(f"{name}: not checked, is not part of this build")
    if not any(name in built for name in treat_each):
        faults.append("no source was found that treats the shapes of emitters one by one")

    with tempfile.TemporaryDirectory() as temporary, concurrent.futures.ThreadPoolExecutor(2) as pool:
        changed = pathlib.Path(temporary) / "include"
        shutil.copytree(project / "include", changed)
        change_headers(changed)
        runs = {name: pool.submit(compile_source, commands[name], changed) for name in built}
        for name in built:
            messages = runs[name].result()
            if name in treat_each:
                faults.append(judge_treats_each(name, messages))
            else:
                faults.append(judge_treats_all(name, messages))
    return [fault for fault in faults if fault]


def main():
    project, build = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    texts = dict(sources(project))
    public = {file.relative_to(project).as_posix(): file.read_text()
              for file in sorted(project.glob("include/lichtmc/*.hpp"))}
    faults = check_chains({**texts, **public}) + check_compilation(project, build, texts)
    print("\n".join(faults) or "every source that treats emitter shapes one by one fails to compile if one is missing")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
