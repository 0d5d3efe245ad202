"""Receivers of a room."""

from __future__ import annotations

import numpy as np
import pytest

import lichtmc
from rooms import SCENES, cuboid


def test_receivers_from_arrays():
    room = cuboid()
    names = room.add_receivers([(1, 1, 1), (2, 1, 1), (3, 1, 1)])
    assert names == ["receiver_1", "receiver_2", "receiver_3"]
    assert room.add_receivers(np.array([1, 1, 2]), (0, 0, 2), names="eye") == ["eye"]
    receivers = room.receivers
    assert len(receivers) == 4
    assert receivers.names == [*names, "eye"]
    assert (receivers.position.shape, receivers.position.dtype) == ((4, 3), np.float64)
    assert receivers.position.tolist() == [[1, 1, 1], [2, 1, 1], [3, 1, 1], [1, 1, 2]]
    assert receivers.normal.tolist() == 3 * [[0, 1, 0]] + [[0, 0, 2]]
    assert receivers.half_angle.tolist() == 4 * [90]
    assert receivers.area.tolist() == 4 * [1]
    assert np.isnan(receivers.concentrator_index).all()
    assert receivers.filter_gain.tolist() == 4 * [1]
    assert receivers.law == 4 * ["planar"]
    assert repr(receivers) == "<RoomReceivers: 4>"
    for array in (receivers.position, receivers.half_angle, receivers.concentrator_index):
        assert not array.flags.writeable


def test_values_for_each_or_for_all():
    room = cuboid()
    room.add_receivers(
        [(1, 1, 1), (2, 1, 1)],
        [(0, 1, 0), (0, 0, 1)],
        names=["a", "b"],
        half_angle=[60, 30],
        area=1e-4,
        concentrator_index=1.5,
        filter_gain=np.array([0.5, 1]),
    )
    receivers = room.receivers
    assert receivers.half_angle.tolist() == [60, 30]
    assert receivers.area.tolist() == [1e-4, 1e-4]
    assert receivers.concentrator_index.tolist() == [1.5, 1.5]
    assert receivers.filter_gain.tolist() == [0.5, 1]


def test_cylinders_and_cells():
    room = cuboid()
    room.add_receivers((2, 1.2, 2), law="cylindrical")
    room.add_receivers((2, 1.2, 2), law="semicylindrical", facing=(0, 0, 1))
    room.add_receivers([(2, 1, 2), (1, 1, 2)], cell_u=(0.5, 0, 0), cell_v=[(0, 0, 0.5), (0, 0, 0.25)])
    assert room.receivers.law == ["cylindrical", "semicylindrical", "planar", "planar"]
    assert lichtmc.simulate(room, photons=2000, only="receivers").receivers.irradiance.min() > 0


@pytest.mark.parametrize(
    ("positions", "options", "message"),
    [
        ((1, 1), {}, r"positions has the shape \(2,\)"),
        ([(1, 1, 1, 1)], {}, r"positions has the shape \(1, 4\)"),
        ([], {}, "positions has the shape"),
        ("here", {}, "positions is 'here'"),
        (None, {}, "positions is None"),
        ((1, 1, np.nan), {}, "finite numbers"),
        ((1, 1, 1), {"normals": (0, 0, 0)}, "not all 0"),
        ((1, 1, 1), {"normals": [(0, 1, 0), (0, 1, 0)]}, "normals has 2 rows .allowed: 1"),
        ([(1, 1, 1), (1, 1, 2)], {"names": ["a"]}, "number of names is 1 .allowed: 2"),
        ([(1, 1, 1), (1, 1, 2)], {"names": "ab"}, "number of names is 1 .allowed: 2"),
        ((1, 1, 1), {"names": [1]}, "position 0 is 1 .allowed: a text"),
        ([(1, 1, 1), (1, 1, 2)], {"half_angle": [1, 2, 3]}, r"shape \(3,\) .allowed: \(2,\), one for each receiver"),
        ((1, 1, 1), {"half_angle": 100}, "is 100 .allowed: 0 to 90"),
        ((1, 1, 1), {"half_angle": "wide"}, "field of view is 'wide'"),
        ((1, 1, 1), {"area": -1}, "is -1"),
        ((1, 1, 1), {"concentrator_index": 0.5}, "is 0.5"),
        ((1, 1, 1), {"filter_gain": np.inf}, "is inf"),
        ((1, 1, 1), {"law": "round"}, "law is 'round' .allowed: 'planar', 'cylindrical', 'semicylindrical'"),
        ((1, 1, 1), {"law": 3}, "law of the receivers is 3"),
        ((1, 1, 1), {"law": "semicylindrical", "facing": (0, 1, 0)}, "sine of the angle"),
        ((1, 1, 1), {"law": "cylindrical", "half_angle": 60}, "which stands for all directions"),
        ((1, 1, 1), {"cell_u": (1, 0, 0)}, "edges of the cell"),
        ((1, 1, 1), {"cell_u": (1, 0, 0), "cell_v": (0, 1, 0)}, "cell"),
    ],
)
def test_wrong_receivers_are_refused(positions, options, message):
    room = cuboid()
    with pytest.raises(lichtmc.InputError, match=message):
        room.add_receivers(positions, **options)
    assert len(room.receivers) == 0


def test_grids():
    room = cuboid()
    names = room.add_receiver_grid(0.75, 1)
    assert len(names) == 20
    assert names[0] == "grid_0_0"
    assert np.all(room.receivers.position[:, 1] == 0.75)
    assert len(room.add_receiver_grid(0.85)) == 80
    with pytest.raises(lichtmc.InputError, match="above 0"):
        room.add_receiver_grid(0.75, 0)
    with pytest.raises(lichtmc.InputError, match="height of the grid is 'desk'"):
        room.add_receiver_grid("desk")
    with pytest.raises(lichtmc.InputError, match="No point of the grid"):
        room.add_receiver_grid(5)


def test_tables(tmp_path):
    room = lichtmc.Room.from_gltf(SCENES / "living_room.glb")
    before = len(room.receivers)
    names = room.read_receivers(SCENES / "living_room_receivers.csv")
    assert names[0] == "eye_0"
    assert len(room.receivers) == before + len(names)
    assert room.receivers.half_angle[before] == 80
    with pytest.raises(lichtmc.InputError, match="none.csv"):
        room.read_receivers("none.csv")
    table = tmp_path / "table.csv"
    table.write_text("x,y\n1,2\n", encoding="utf-8")
    with pytest.raises(lichtmc.InputError, match="table.csv"):
        room.read_receivers(table)


def test_receivers_of_a_room_do_not_change_with_it():
    room = cuboid()
    room.add_receivers((1, 1, 1))
    before = room.receivers
    position = before.position
    room.add_receivers((2, 1, 1))
    assert (len(before), len(room.receivers)) == (1, 2)
    assert position.tolist() == [[1, 1, 1]]


def test_a_table_with_names_that_are_no_unicode_is_refused_before_it_is_added(tmp_path):
    room = cuboid()
    table = tmp_path / "table.csv"
    table.write_bytes(b"name,x,y,z,nx,ny,nz\nfirst,1,1,1,0,1,0\nb\xfcro,1,1,2,0,1,0\n")
    with pytest.raises(lichtmc.InputError, match=r"receiver 2 of .*table.csv is b.xfcro, which is not UTF-8"):
        room.read_receivers(table)
    assert len(room.receivers) == 0
