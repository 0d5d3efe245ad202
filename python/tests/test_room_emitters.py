"""Emitters of every law, and luminaires."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import lichtmc
from rooms import DATA


def empty() -> lichtmc.Room:
    return lichtmc.Room.cuboid((4, 2.5, 5))


def lamp() -> Path:
    return DATA / "luminaires" / "c_skew.ies"


def test_shapes_are_values():
    shapes = [
        lichtmc.Isotropic((1, 2, 3)),
        lichtmc.Lambert((1, 2, 3), (0, 1, 0), 5),
        lichtmc.Spot((1, 2, 3), (1, 0, 0), inner_deg=10, outer_deg=90),
        lichtmc.AreaLight("ceiling", 2),
    ]
    again = [
        lichtmc.Isotropic(np.array([1.0, 2.0, 3.0])),
        lichtmc.Lambert([1, 2, 3], axis=[0, 1, 0], exponent=5.0),
        lichtmc.Spot([1, 2, 3], axis=[1, 0, 0], inner_deg=10, outer_deg=90),
        lichtmc.AreaLight(surface="ceiling", exponent=2),
    ]
    assert shapes == again
    assert [hash(s) for s in shapes] == [hash(s) for s in again]
    assert len({*shapes, *again}) == 4
    assert lichtmc.Isotropic((1, 2, 3)) != lichtmc.Isotropic((1, 2, 4))
    assert shapes[0] != shapes[1]
    assert repr(shapes[0]) == "Isotropic(position=(1.0, 2.0, 3.0))"
    assert repr(shapes[3]) == "AreaLight(surface='ceiling', exponent=2.0)"
    assert shapes[1].position.tolist() == [1, 2, 3]
    assert shapes[1].axis.tolist() == [0, 1, 0]
    assert shapes[1].exponent == 5
    assert (shapes[2].inner_deg, shapes[2].outer_deg) == (10, 90)
    assert (shapes[3].surface, shapes[3].exponent) == ("ceiling", 2)
    with pytest.raises(AttributeError):
        shapes[1].exponent = 3


def test_defaults():
    assert lichtmc.Lambert((0, 0, 0)) == lichtmc.Lambert((0, 0, 0), (0, -1, 0), 1)
    assert lichtmc.Spot((0, 0, 0)) == lichtmc.Spot((0, 0, 0), (0, -1, 0), inner_deg=0, outer_deg=45)
    assert lichtmc.AreaLight("x") == lichtmc.AreaLight("x", 1)


def test_emitters_are_added_with_names():
    room = empty()
    assert room.add_emitter(lichtmc.Isotropic((1, 1, 1)), 100) == "emitter_1"
    assert room.add_emitter(lichtmc.Lambert((1, 2, 1)), np.float32(50), name="lamp", delay=1e-9) == "lamp"
    assert room.add_emitter(lichtmc.Spot((1, 2, 1)), 25, name="lamp") == "lamp"
    assert room.add_emitter(lichtmc.AreaLight("ceiling"), 200, maintenance_factor=0.75) == "emitter_4"
    assert [e.name for e in room.emitters] == ["emitter_1", "lamp", "lamp", "emitter_4"]
    assert [e.power for e in room.emitters] == [100, 50, 25, 150]
    assert [e.delay for e in room.emitters] == [0, 1e-9, 0, 0]
    assert [e.maintenance_factor for e in room.emitters] == [1, 1, 1, 0.75]
    assert [type(e.shape).__name__ for e in room.emitters] == ["Isotropic", "Lambert", "Spot", "AreaLight"]
    assert room.emitters[3].shape == lichtmc.AreaLight("ceiling")
    assert repr(room.emitters[0]) == "<Emitter 'emitter_1': 100, Isotropic(position=(1.0, 1.0, 1.0))>"
    assert "325 lm" in repr(room)
    room.set_maintenance_factor(0.5)
    assert [e.power for e in room.emitters] == [50, 25, 12.5, 150]


def test_spots_have_the_degrees_that_were_given():
    for inner, outer in ((30, 30), (10, 30), (0.1, 45), (7, 33), (90, 90), (12.3, 60)):
        spot = lichtmc.Spot((1, 2, 3), inner_deg=inner, outer_deg=outer)
        assert (spot.inner_deg, spot.outer_deg) == (inner, outer)
        assert repr(spot).endswith(f"inner_deg={float(inner)}, outer_deg={float(outer)})")
        assert lichtmc.Spot((1, 2, 3), inner_deg=spot.inner_deg, outer_deg=spot.outer_deg) == spot
    room = empty()
    room.add_emitter(lichtmc.Spot((2, 2, 2), inner_deg=30, outer_deg=30), 100)
    assert room.emitters[0].shape.outer_deg == 30
    room.add_receivers([(2, 0, 2), (2, 0, 3.14), (2, 0, 3.17)])  # 2 m · tan 30° = 1.155 m
    direct = lichtmc.simulate(room, photons=1000, only="receivers").receivers.direct
    intensity = 100 / (2 * np.pi * (1 - np.cos(np.pi / 6)))
    assert direct == pytest.approx([intensity / 4, intensity / 4 * np.cos(np.arctan(0.57)) ** 3, 0], rel=1e-3)


def test_powers_are_set_and_emitters_removed():
    room = empty()
    for name in ("left", "right", "spot"):
        room.add_emitter(lichtmc.Isotropic((1, 1, 1)), 100, name=name)
    room.add_emitter(lichtmc.Luminaire(lamp(), (2, 2, 2)), name="office", maintenance_factor=0.5)
    shape = room.emitters[3].shape
    room.set_power("[rs]*", 250)
    assert [e.power for e in room.emitters[:3]] == [100, 250, 250]
    room.set_power("office", np.float32(600))
    assert (room.emitters[3].power, room.emitters[3].shape.power) == (300, 600)
    assert room.emitters[3].shape != shape
    assert room.remove_emitters("[ls]*") == 2
    assert [e.name for e in room.emitters] == ["right", "office"]
    assert "2 emitters '[ls]*' removed." in room.overrides
    assert room.remove_emitters("*") == 2
    with pytest.raises(lichtmc.InputError, match="no emitter '.' in cuboid .allowed: none"):
        room.remove_emitters("*")
    room.add_emitter(lichtmc.Isotropic((1, 1, 1)), 2, unit="W")
    assert room.unit == "W"
    for change, message in (
        (lambda: room.set_power("lamp", 1), "no emitter 'lamp'.*'emitter_1'"),
        (lambda: room.set_power("emitter_1", -1), "is -1 W .allowed: a finite number, 0 or more"),
        (lambda: room.set_power("emitter_1", "3"), r"power of the emitter is '3' .*for example 5 \(W\)"),
        (lambda: room.set_power(1, 1), "name of an emitter is 1"),
        (lambda: room.remove_emitters(None), "name of an emitter is None"),
    ):
        with pytest.raises(lichtmc.InputError, match=message):
            change()
    assert [e.power for e in room.emitters] == [2]


def test_default_names_avoid_those_that_exist():
    room = empty()
    room.add_emitter(lichtmc.Isotropic((1, 1, 1)), 1, name="emitter_2")
    assert room.add_emitter(lichtmc.Isotropic((1, 1, 1)), 1) == "emitter_3"


def test_units():
    room = empty()
    room.add_emitter(lichtmc.Isotropic((1, 1, 1)), 2, unit="W")
    assert (room.unit, room.irradiance_unit) == ("W", "W/m^2")
    with pytest.raises(lichtmc.InputError, match="in lm, the emitters of cuboid are in W"):
        room.add_emitter(lichtmc.Isotropic((1, 1, 1)), 2)
    assert len(room.emitters) == 1


def test_an_emitter_without_power_is_allowed_beside_others():
    room = empty()
    room.add_emitter(lichtmc.Isotropic((1, 1, 1)), 0)
    room.add_emitter(lichtmc.Isotropic((1, 1, 1)), 1)
    assert [e.power for e in room.emitters] == [0, 1]


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: lichtmc.Isotropic((1, 2)), r"position of the emitter has the shape \(2,\) .allowed: \(3,\)"),
        (lambda: lichtmc.Isotropic("here"), "position of the emitter is 'here'"),
        (lambda: lichtmc.Isotropic((1, 2, np.nan)), "finite numbers"),
        (lambda: lichtmc.Lambert((1, 2, 3), (0, 0, 0)), "not all 0"),
        (lambda: lichtmc.Lambert((1, 2, 3), exponent=-1), "is -1"),
        (lambda: lichtmc.Lambert((1, 2, 3), exponent="2"), "exponent of the emitter is '2'"),
        (lambda: lichtmc.Spot((1, 2, 3), outer_deg=100), "outer half angle of the spot is 100 .allowed: 0.0001 to 90 deg"),
        (lambda: lichtmc.Spot((1, 2, 3), inner_deg=60), "of the spot is 60 .allowed: 0 to 45.0 degrees, the outer half angle"),
        (lambda: lichtmc.Spot((1, 2, 3), inner_deg=np.nan), "inner half angle of the spot is nan"),
        (lambda: lichtmc.AreaLight(3), "name of the emitting surface is 3"),
        (lambda: lichtmc.AreaLight("x", -2), "is -2"),
    ],
)
def test_wrong_shapes_are_refused(make, message):
    with pytest.raises(lichtmc.InputError, match=message):
        make()


@pytest.mark.parametrize(
    ("arguments", "options", "message"),
    [
        (((1, 1, 1), 5), {}, r"shape of the emitter is \(1, 1, 1\) .allowed: Isotropic, Lambert"),
        ((lichtmc.Isotropic, 5), {}, "shape of the emitter is <class"),
        ((lichtmc.Isotropic((1, 1, 1)),), {}, "has no power"),
        ((lichtmc.Isotropic((1, 1, 1)), "5 lm"), {}, r"power of the emitter is '5 lm' .*for example 1000 \(lm\)"),
        ((lichtmc.Isotropic((1, 1, 1)), -5), {}, "is -5 .allowed: a finite number, 0 or more"),
        ((lichtmc.Isotropic((1, 1, 1)), np.nan), {}, "is nan"),
        ((lichtmc.Isotropic((1, 1, 1)), 5), {"unit": "lumen"}, "unit is 'lumen'"),
        ((lichtmc.Isotropic((1, 1, 1)), 5), {"unit": None}, "unit is None"),
        ((lichtmc.Isotropic((1, 1, 1)), 5), {"name": 5}, "name of the emitter is 5"),
        ((lichtmc.Isotropic((1, 1, 1)), 5), {"delay": -1}, "delay in s"),
        ((lichtmc.Isotropic((1, 1, 1)), 5), {"maintenance_factor": 1.2}, "above 0 and up to 1"),
        ((lichtmc.AreaLight("roof"), 5), {}, "no surface 'roof' in cuboid .allowed: 'floor', 'ceiling'"),
    ],
)
def test_wrong_emitters_are_refused(arguments, options, message):
    room = empty()
    with pytest.raises(lichtmc.InputError, match=message):
        room.add_emitter(*arguments, **options)
    assert room.emitters == []


def test_every_law_gives_light_where_it_should():
    for shape, lit, dark in [
        (lichtmc.Isotropic((2, 1, 2)), "ceiling", None),
        (lichtmc.Lambert((2, 1, 2)), "floor", "ceiling"),
        (lichtmc.Spot((2, 1, 2), (0, 1, 0), outer_deg=20), "ceiling", "floor"),
        (lichtmc.AreaLight("ceiling"), "floor", "ceiling"),
    ]:
        room = lichtmc.Room.cuboid((4, 2.5, 5), 0)
        room.add_emitter(shape, 100)
        surfaces = lichtmc.simulate(room, photons=2000).surfaces
        assert surfaces[lit].power > 0
        assert dark is None or surfaces[dark].power == 0


def test_luminaires():
    room = empty()
    luminaire = lichtmc.Luminaire(lamp(), (2, 2.4, 2))
    assert luminaire.power == pytest.approx(lichtmc.Photometry(lamp()).flux)
    assert (luminaire.unit, luminaire.area) == ("lm", False)
    assert luminaire.aim.tolist() == [0, -1, 0]
    assert luminaire.c0.tolist() == [1, 0, 0]
    assert luminaire.photometry.source == str(lamp())
    assert room.add_emitter(luminaire) == "c_skew"
    assert room.add_emitter(lichtmc.Luminaire(str(lamp()), (1, 2.4, 1), lumens=1000)) == "c_skew_2"
    assert room.add_emitter(lichtmc.Luminaire(lamp(), (1, 2.4, 1), scale=2), name="third") == "third"
    assert [e.power for e in room.emitters] == pytest.approx([luminaire.power, 1000, 2 * luminaire.power])
    assert room.emitters[0].shape == luminaire
    assert repr(room.emitters[1].shape).startswith("Luminaire(photometry=")


def test_luminaires_are_turned():
    luminaire = lichtmc.Luminaire(lamp(), (2, 2.4, 2), rotation_deg=90)
    assert np.allclose(luminaire.c0, lichtmc.Luminaire(lamp(), (2, 2.4, 2)).c90)
    upwards = lichtmc.Luminaire(lamp(), (2, 2.4, 2), (0, 5, 0))
    assert upwards.aim.tolist() == [0, 1, 0]


def test_luminaires_by_radiant_flux():
    room = empty()
    luminaire = lichtmc.Luminaire(lamp(), (2, 2.4, 2), watts=3)
    assert (luminaire.power, luminaire.unit) == (3, "W")
    room.add_emitter(luminaire)
    assert room.unit == "W"
    with pytest.raises(lichtmc.InputError, match="in lm, the emitters"):
        room.add_emitter(lichtmc.Luminaire(lamp(), (2, 2.4, 2)))


def test_many_luminaires_of_a_file_share_its_tables():
    room = empty()
    file = DATA / "luminaires" / "c_tilt_include.ies"  # of which the room has a remark
    for k in range(50):
        room.add_emitter(lichtmc.Luminaire(file, (0.05 * k + 0.1, 2, 2)))
    assert len(room.ignored) == len(set(room.ignored)) > 0
    assert len({e.name for e in room.emitters}) == 50


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"lumens": 100, "scale": 2}, "more than one number scales"),
        ({"lumens": 0}, "above 0"),
        ({"lumens": "100"}, "luminous flux of the luminaire .lumens. is '100'"),
        ({"watts": -1}, "radiant flux"),
        ({"rotation_deg": np.inf}, "rotation"),
        ({"aim": (0, 0, 0)}, "not all 0"),
        ({"position": (0, 0)}, "position of the luminaire"),
        ({"area": "yes"}, "True or False"),
        ({"lamp_set": 0}, "lamp set is 0"),
    ],
)
def test_wrong_luminaires_are_refused(options, message):
    with pytest.raises(lichtmc.InputError, match=message):
        lichtmc.Luminaire(lamp(), **{"position": (2, 2.4, 2), **options})


def test_what_a_luminaire_has_by_itself_is_refused():
    room = empty()
    with pytest.raises(lichtmc.InputError, match="power of the luminaire is 500"):
        room.add_emitter(lichtmc.Luminaire(lamp(), (2, 2, 2)), 500)
    with pytest.raises(lichtmc.InputError, match="unit of the luminaire is 'W'"):
        room.add_emitter(lichtmc.Luminaire(lamp(), (2, 2, 2)), unit="W")
    with pytest.raises(lichtmc.InputError, match="lamp_set and flip_horizontal"):
        lichtmc.Luminaire(lichtmc.Photometry(lamp()), (2, 2, 2), lamp_set=2)
    with pytest.raises(lichtmc.InputError, match="a Photometry or the name of a file"):
        lichtmc.Luminaire(5, (2, 2, 2))


def test_the_opening_of_a_luminaire():
    photometry = lichtmc.Photometry(lamp())
    if photometry.opening == "point":
        with pytest.raises(lichtmc.InputError, match="no size of the luminous opening"):
            lichtmc.Luminaire(photometry, (2, 2, 2), area=True)
    else:
        assert lichtmc.Luminaire(photometry, (2, 2, 2), area=True).area


def test_area_lights_and_luminaires_are_written_and_read(tmp_path):
    room = empty()
    room.add_emitter(lichtmc.AreaLight("ceiling"), 300, name="panel")
    room.add_emitter(lichtmc.Luminaire(lamp(), (2, 2.25, 2.5), rotation_deg=90, lumens=500), name="lamp")
    room.write_gltf(tmp_path / "room.glb")
    again = lichtmc.Room.from_gltf(tmp_path / "room.glb").emitters
    panel, luminaire = sorted(again, key=lambda emitter: type(emitter.shape).__name__)
    assert panel.shape == lichtmc.AreaLight("ceiling")
    assert panel.power == pytest.approx(300, rel=1e-6)
    assert luminaire.power == pytest.approx(500, rel=1e-6)
    assert np.allclose(luminaire.shape.c0, (0, 0, -1), atol=1e-6)
