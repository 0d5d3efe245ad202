"""Result.write() and Result.load()."""

from __future__ import annotations

import json
import pickle
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import lichtmc
import numpy as np
import pytest
from rooms import ENVIRONMENT, SCENES, command_line, cube, living_room, same_tiles

RUN = ("--photons", "20000", "--tile", "0.5", "--estimator", "collision")


@pytest.fixture(scope="module")
def result() -> lichtmc.Result:
    return lichtmc.simulate(cube(), photons=20_000, tile=0.5)


def test_a_folder_gives_the_same_result_again(result, tmp_path):
    result.write(tmp_path / "new" / "folder")
    again = lichtmc.Result.load(tmp_path / "new" / "folder")
    assert pickle.dumps(again) == pickle.dumps(lichtmc.Result.load(str(tmp_path / "new" / "folder")))
    assert same_tiles(again, result)
    assert again.warnings == result.warnings
    assert same_tiles(lichtmc.resume(again, photons=30_000), lichtmc.simulate(cube(), photons=30_000, tile=0.5))


def test_the_files_are_those_of_the_command_line(result, tmp_path):
    result.write(tmp_path / "python", paths=3)
    command_line("run", SCENES / "cube_paper.gltf", *RUN, "--paths", 3, "-o", "program", folder=tmp_path)

    def files(folder):
        return {str(file.relative_to(folder)) for file in folder.rglob("*") if file.is_file()}

    assert files(tmp_path / "python") == files(tmp_path / "program") | {"result.lichtmc"}
    for name in ("tiles.csv", "surfaces.csv", "emitters.csv", "pictures/room.svg"):
        assert (tmp_path / "python" / name).read_bytes() == (tmp_path / "program" / name).read_bytes(), name
    assert result.summary()["surfaces"] == json.loads((tmp_path / "python" / "summary.json").read_text())["surfaces"]
    summaries = [json.loads((tmp_path / folder / "summary.json").read_text()) for folder in ("python", "program")]
    for key in ("warnings", "ignored", "surfaces", "balance", "histories", "rms_relative_error", "settings"):
        assert summaries[0].get(key) == summaries[1].get(key), key


def test_parts_of_a_folder(result, tmp_path):
    result.write(tmp_path, report=False, images=False)
    names = {file.name for file in tmp_path.iterdir()}
    assert names == {"emitters.csv", "result.lichtmc", "state.h5", "summary.json", "surfaces.csv", "tiles.csv"}


def test_a_run_of_the_command_line_has_its_figures(tmp_path):
    command_line("run", SCENES / "living_room.glb", "--receivers", SCENES / "living_room_receivers.csv", *RUN,
                 "--no-report", "-o", "run", folder=tmp_path)
    loaded = lichtmc.Result.load(tmp_path / "run")
    table = np.genfromtxt(tmp_path / "run" / "tiles.csv", delimiter=",", names=True, usecols=range(2, 12), dtype=None)
    for column, array in (("irradiance", loaded.tiles.irradiance), ("standard_error", loaded.tiles.standard_error)):
        assert np.array_equal(table[column], array), column
    more = lichtmc.resume(loaded, photons=30_000)
    command_line("resume", "run", "--photons", 30_000, folder=tmp_path)
    assert same_tiles(more, lichtmc.Result.load(tmp_path / "run"))


@pytest.mark.filterwarnings("ignore::lichtmc.ResultWarning")
def test_receivers_areas_and_channels_of_the_command_line(tmp_path):
    table = SCENES / "living_room_receivers.csv"
    command_line("run", SCENES / "living_room.glb", "--receivers", table, "--plane", "0.75", "--only", "receivers",
                 "--impulse-response", "1ns", *RUN[:2], "--no-report", "-o", "run", folder=tmp_path)
    loaded = lichtmc.Result.load(tmp_path / "run")
    loaded.write(tmp_path / "again", report=False)
    for name in ("receivers.csv", "areas.csv", "channels.csv", "impulse_response.csv"):
        assert (tmp_path / "again" / name).read_bytes() == (tmp_path / "run" / name).read_bytes(), name


def test_a_folder_in_use_is_refused(result, tmp_path):
    program = f"""
import lichtmc, sys
room = lichtmc.Room.from_gltf({str(SCENES / "cube_paper.gltf")!r})
lichtmc.simulate(room, photons=1000, tile=0.5).write("run", report=False)
sys.exit(0)
"""
    with subprocess.Popen(
        [sys.executable, "-m", "lichtmc", "run", SCENES / "cube_paper.gltf", "--max-time", "600s", "-o", "run"],
        cwd=tmp_path, env=ENVIRONMENT, stderr=subprocess.PIPE,
    ) as process:
        try:
            for _ in range(600):
                if (tmp_path / "run" / ".lichtmc.lock").exists():
                    break
                time.sleep(0.05)
            with pytest.raises(lichtmc.InputError, match="run"):
                result.write(tmp_path / "run")
            done = subprocess.run([sys.executable, "-c", program], cwd=tmp_path, env=ENVIRONMENT, capture_output=True,
                                  text=True, timeout=60)
            assert done.returncode == 1 and "InputError" in done.stderr
        finally:
            process.kill()
            process.communicate()


def test_two_threads_write_one_folder(result, tmp_path):
    """One of them may be refused; the folder has the whole of a result."""

    def write(number: int) -> bool:
        try:
            result.write(tmp_path / "run", report=False, images=False)
        except lichtmc.InputError:
            return False
        return True

    with ThreadPoolExecutor(4) as pool:
        assert any(pool.map(write, range(8)))
    assert same_tiles(lichtmc.Result.load(tmp_path / "run"), result)
    assert not [file for file in (tmp_path / "run").iterdir() if file.name.startswith(".")]


def test_a_later_run_of_the_command_line_counts(result, tmp_path):
    result.write(tmp_path / "run", report=False)
    command_line("run", SCENES / "cube_paper.gltf", *RUN, "--seed", 5, "--no-report", "-o", "run", folder=tmp_path)
    assert not (tmp_path / "run" / "result.lichtmc").exists()
    assert same_tiles(
        lichtmc.Result.load(tmp_path / "run"), lichtmc.simulate(cube(), photons=20_000, tile=0.5, seed=5)
    )


def test_a_stale_result_does_not_count(result, tmp_path):
    """As if a run had been killed after it wrote its state."""
    result.write(tmp_path / "one", report=False, images=False)
    lichtmc.simulate(cube(), photons=20_000, tile=0.5, seed=5).write(tmp_path / "two", report=False, images=False)
    shutil.copy(tmp_path / "two" / "state.h5", tmp_path / "one" / "state.h5")
    with pytest.raises(lichtmc.InputError, match="no result.lichtmc of the same result.*room=…"):
        lichtmc.Result.load(tmp_path / "one")
    loaded = lichtmc.Result.load(tmp_path / "one", room=cube())
    assert same_tiles(loaded, lichtmc.Result.load(tmp_path / "two"))


def _of_another_version(file: Path) -> None:
    content = file.read_bytes()
    version = b"version " + lichtmc.__version__.encode()
    assert version in content
    file.write_bytes(content.replace(version, b"version 0.0.1", 1))


def test_a_stale_result_of_another_version_does_not_count(result, tmp_path):
    result.write(tmp_path / "one", report=False, images=False)
    _of_another_version(tmp_path / "one" / "result.lichtmc")
    with pytest.raises(lichtmc.InputError, match="version 0.0.1"):
        lichtmc.Result.load(tmp_path / "one")
    command_line("run", SCENES / "cube_paper.gltf", *RUN, "--seed", 5, "--no-report", "-o", "two", folder=tmp_path)
    shutil.copy(tmp_path / "two" / "state.h5", tmp_path / "one" / "state.h5")
    assert same_tiles(lichtmc.Result.load(tmp_path / "one"), lichtmc.Result.load(tmp_path / "two"))


def test_a_full_disk_leaves_the_earlier_result(tmp_path):
    """As on a full disk, the new tables cannot be written, but the new state, which is smaller, can."""
    folder = tmp_path / "run"
    lichtmc.simulate(cube(), photons=5000, tile=0.05).write(folder, report=False, images=False)
    before = {file.name: file.read_bytes() for file in folder.iterdir()}
    limit = len(before["state.h5"]) + 10_000
    assert limit < max(map(len, before.values()))
    program = f"""
import lichtmc, resource, sys
room = lichtmc.Room.from_gltf({str(SCENES / "cube_paper.gltf")!r})
result = lichtmc.simulate(room, photons=5000, tile=0.05, seed=5)
resource.setrlimit(resource.RLIMIT_FSIZE, ({limit}, {limit}))
try:
    result.write({str(folder)!r}, report=False, images=False)
except lichtmc.RuntimeError:
    sys.exit(3)
"""
    done = subprocess.run([sys.executable, "-c", program], env=ENVIRONMENT, capture_output=True, text=True, timeout=120)
    assert done.returncode == 3, done.stderr
    assert {file.name: file.read_bytes() for file in folder.iterdir()} == before
    lichtmc.Result.load(folder)


def test_a_room_that_was_moved_is_given(tmp_path):
    shutil.copy(SCENES / "cube_paper.gltf", tmp_path / "room.gltf")
    command_line("run", "room.gltf", *RUN, "--no-report", "-o", "run", folder=tmp_path)
    (tmp_path / "room.gltf").rename(tmp_path / "moved.gltf")
    with pytest.raises(lichtmc.InputError, match="Cannot find the room.*Give the room to Result.load"):
        lichtmc.Result.load(tmp_path / "run")
    loaded = lichtmc.Result.load(tmp_path / "run", room=lichtmc.Room.from_gltf(tmp_path / "moved.gltf"))
    assert same_tiles(loaded, lichtmc.simulate(cube(), photons=20_000, tile=0.5))
    with pytest.raises(lichtmc.InputError, match="another room"):
        lichtmc.Result.load(tmp_path / "run", room=living_room())


def test_the_command_line_tells_where_to_continue(result, tmp_path):
    result.write(tmp_path / "run", report=False, images=False)
    assert "lichtmc.resume(lichtmc.Result.load(" in command_line("resume", tmp_path / "run", status=2)


def test_a_loaded_run_of_the_command_line_stays_one(tmp_path):
    command_line("run", SCENES / "cube_paper.gltf", *RUN, "--no-report", "-o", "run", folder=tmp_path)
    lichtmc.resume(lichtmc.Result.load(tmp_path / "run"), photons=30_000).write(tmp_path / "more", report=False)
    command_line("resume", "more", "--photons", 40_000, folder=tmp_path)
    assert same_tiles(
        lichtmc.Result.load(tmp_path / "more"), lichtmc.simulate(cube(), photons=40_000, tile=0.5)
    )


def test_folders_that_cannot_be_used(result, tmp_path):
    (tmp_path / "file").write_text("not a folder")
    with pytest.raises(lichtmc.InputError):
        result.write(tmp_path / "file")
    with pytest.raises(lichtmc.InputError, match="no state.h5"):
        lichtmc.Result.load(tmp_path)
    with pytest.raises(lichtmc.InputError, match="missing does not exist"):
        lichtmc.Result.load(tmp_path / "missing")
    for argument in ({"report_style": "nice"}, {"colours": "jet"}, {"scale": "logarithmic"},
                     {"paths": 20_000}, {"paths": 20_000, "report": False}, {"scale_max": -1.0},
                     {"scale_max": float("nan")}):
        with pytest.raises(lichtmc.InputError, match="allowed: "):
            result.write(tmp_path / "out", **argument)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("name", ["state.h5", "result.lichtmc"])
def test_damaged_files_are_refused(result, tmp_path, name):
    result.write(tmp_path, report=False, images=False)
    content = (tmp_path / name).read_bytes()
    for position in range(0, len(content), len(content) // 20):
        damaged = bytearray(content)
        damaged[position] ^= 1
        for changed in (bytes(damaged), content[:position]):
            (tmp_path / name).write_bytes(changed)
            with pytest.raises(lichtmc.InputError):
                lichtmc.Result.load(tmp_path)
    (tmp_path / name).write_bytes(content)
    assert same_tiles(lichtmc.Result.load(tmp_path), result)
