"""Rooms and several threads of Python."""

from __future__ import annotations

import json
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import lichtmc
from rooms import cuboid


def test_a_room_changes_while_another_thread_works_with_it():
    room = cuboid()
    stop = threading.Event()
    changes = 0

    def change() -> None:
        nonlocal changes
        while not stop.is_set():
            room.set_reflectance("floor", 0.1 + 0.001 * (changes % 100))
            room.add_emitter(lichtmc.Isotropic((1, 1, 1)), 0)
            changes += 1
            time.sleep(0.001)

    thread = threading.Thread(target=change)
    thread.start()
    try:
        for _ in range(3):
            assert room.check(tile=0.5).closed
            assert len(room.paths(100)) == 100
            assert lichtmc.simulate(room, photons=2000).tiles.irradiance.min() >= 0
    finally:
        stop.set()
        thread.join()
    assert changes > 0
    assert len(room.emitters) == changes + 1


def sheet(n: int) -> tuple[np.ndarray, np.ndarray]:
    """A level mesh of 2 n² triangles, so that it takes a while to lay out an area over it."""
    x, z = np.meshgrid(np.linspace(0.5, 3.5, n + 1), np.linspace(0.5, 4.5, n + 1))
    vertices = np.stack([x, np.full_like(x, 0.01), z], axis=-1).reshape(-1, 3)
    corner = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).reshape(-1)
    right, below = corner + 1, corner + n + 1
    return vertices, np.concatenate([np.stack([corner, below, right], 1), np.stack([right, below, below + 1], 1)])


def lay_while_another_thread_adds(triangles_per_edge: int) -> bool:
    """Whether a lamp was added while an area was laid out: then this is told, and the lamp stays."""
    room = cuboid()
    room.add_surface("carpet", *sheet(triangles_per_edge))
    told: list[str] = []

    def lay() -> None:
        try:
            room.add_area("desk", (1, 0.75, 1), (1, 0, 0), (0, 0, 1))
        except lichtmc.InputError as error:
            told.append(str(error))

    thread = threading.Thread(target=lay)
    thread.start()
    names = []
    while thread.is_alive():
        names.append(room.add_emitter(lichtmc.Isotropic((1, 1, 1)), 1))
        thread.join(0.02)
    assert [e.name for e in room.emitters][1:] == names
    assert len(room.areas) == (0 if told else 1)
    assert all("changed by another thread" in text for text in told)
    return bool(told)


def test_a_change_by_another_thread_during_a_slow_one_is_told():
    assert any(lay_while_another_thread_adds(n) for n in (100, 200, 400, 800))  # the first usually


def test_rooms_are_made_in_several_threads():
    rooms: list[lichtmc.Room] = []
    threads = [threading.Thread(target=lambda: rooms.append(cuboid())) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len({repr(room) for room in rooms}) == 1
    assert len(rooms) == 8


def test_an_error_in_a_thread_is_an_input_error():
    with pytest.raises(lichtmc.InputError):
        lichtmc.Room.from_bytes(b"damaged")


def file_with_an_area(folder: Path) -> Path:
    """A room whose area takes a while to lay out, which is done when it is first needed."""
    room = cuboid()
    room.add_surface("carpet", *sheet(60))
    file = folder / "room.gltf"
    room.write_gltf(file)
    document = json.loads(file.read_text())
    desk = {"name": "desk", "mesh": 0, "translation": [0, 0.75, 0], "extras": {"calculation_area": "task"}}
    document["scenes"][0]["nodes"].append(len(document["nodes"]))
    document["nodes"].append(desk)
    file.write_text(json.dumps(document))
    return file


def test_threads_that_only_read_a_room_with_areas_do_not_disturb_each_other(tmp_path):
    room = lichtmc.Room.from_gltf(file_with_an_area(tmp_path))
    start = threading.Barrier(4)
    found: list[object] = []

    def work(call) -> None:
        start.wait()
        try:
            found.append(call())
        except lichtmc.InputError as error:
            found.append(error)

    calls = [lambda: len(lichtmc.simulate(room, photons=2000, tile=0.5, threads=1).areas)] * 2
    calls += [lambda: len(room.areas), lambda: len(room.check(tile=0.5).to_json()["areas"])]
    threads = [threading.Thread(target=work, args=(call,)) for call in calls]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [1, 1, 1, 1]


def test_a_change_while_areas_are_laid_out_is_kept(tmp_path):
    room = lichtmc.Room.from_gltf(file_with_an_area(tmp_path))
    areas: list[int] = []
    thread = threading.Thread(target=lambda: areas.append(len(room.areas)))
    thread.start()
    name = room.add_emitter(lichtmc.Isotropic((1, 1, 1)), 1)
    thread.join()
    assert areas == [1]
    assert [emitter.name for emitter in room.emitters][-1] == name and len(room.areas) == 1
