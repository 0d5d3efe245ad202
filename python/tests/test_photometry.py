"""Photometric files."""

from __future__ import annotations

import csv

import numpy as np
import pytest

import lichtmc
from rooms import DATA

FOLDER = DATA / "luminaires"


def oracles() -> list[dict[str, str]]:
    with open(FOLDER / "oracles.tsv", newline="", encoding="utf-8") as rows:
        return list(csv.DictReader(rows, delimiter="\t"))


def test_figures_of_files_are_those_of_another_program():
    seen = 0
    for row in oracles():
        if not (FOLDER / row["file"]).exists():
            continue
        photometry = lichtmc.Photometry(FOLDER / row["file"])
        assert photometry.flux == pytest.approx(float(row["lumens"]), rel=1e-7), row["file"]
        assert photometry.peak == pytest.approx(float(row["max_cd"]), rel=1e-7), row["file"]
        for name, value in row.items():
            if not name.startswith("cd_C") or not value:
                continue
            c, gamma = np.deg2rad([float(part) for part in name[4:].split("_g")])
            direction = (np.sin(gamma) * np.cos(c), np.sin(gamma) * np.sin(c), np.cos(gamma))
            assert photometry.candela(direction)[0] == pytest.approx(float(value), rel=1e-6, abs=1e-6), (row["file"], name)
            seen += 1
    assert seen > 50


def test_what_a_file_says():
    photometry = lichtmc.Photometry(FOLDER / "c_skew.ies")
    assert photometry.source.endswith("c_skew.ies")
    assert photometry.version.startswith("LM-63")
    assert (photometry.type, photometry.intensity_unit) == ("C", "cd")
    assert isinstance(photometry.texts, dict)
    assert isinstance(photometry.warnings, list)
    assert isinstance(photometry.notes, list)
    assert photometry.opening_size.shape == (3,)
    assert 0 < photometry.flux_towards_aim <= photometry.flux
    assert len(photometry.peak_angles) == 2
    assert repr(photometry).startswith("<Photometry ")
    for text in (photometry.manufacturer, photometry.luminaire, photometry.catalogue, photometry.opening):
        assert isinstance(text, str)
    assert photometry.watts >= 0
    assert photometry.stated_lm is None or photometry.stated_lm > 0
    assert photometry.efficacy is None or photometry.efficacy > 0


def test_intensities_are_arrays():
    photometry = lichtmc.Photometry(FOLDER / "c_lambert.ies")
    directions = np.array([(0, 0, 2.0), (0, 0, -1), (1, 0, 1)])
    values = photometry.candela(directions)
    assert (values.shape, values.dtype) == ((3,), np.float64)
    assert values[0] == pytest.approx(photometry.peak)
    assert values[1] == 0
    assert values[2] == pytest.approx(values[0] / np.sqrt(2), rel=1e-3)


def test_texts_are_read_as_files():
    file = FOLDER / "c_lambert.ies"
    for text in (file.read_text(encoding="latin-1"), file.read_bytes()):
        photometry = lichtmc.Photometry.from_text(text, "lamp.ies")
        assert photometry.source == "lamp.ies"
        assert photometry.flux == lichtmc.Photometry(file).flux
    room = lichtmc.Room.cuboid((4, 2.5, 5))
    assert room.add_emitter(lichtmc.Luminaire(photometry, (2, 2, 2))) == "lamp"


def test_lamp_sets():
    file = FOLDER / "c_ldt_two_sets.ldt"
    assert lichtmc.Photometry(file).flux != lichtmc.Photometry(file, lamp_set=2).flux
    with pytest.raises(lichtmc.InputError, match="3"):
        lichtmc.Photometry(file, lamp_set=3)


def test_lamps_without_flux():
    file = FOLDER / "b_ldt_flux0.ldt"
    with pytest.raises(lichtmc.InputError):
        lichtmc.Photometry(file)
    shape = lichtmc.Luminaire(lichtmc.Photometry(file, needs_flux=False), (2, 2, 2), lumens=500)
    assert shape == lichtmc.Luminaire(file, (2, 2, 2), lumens=500)


def test_wrong_files_are_refused():
    with pytest.raises(lichtmc.InputError, match="No such file"):
        lichtmc.Photometry("none.ies")
    with pytest.raises(lichtmc.InputError, match="photometric file is 3"):
        lichtmc.Photometry(3)
    with pytest.raises(lichtmc.InputError, match="content of the photometric file is 3"):
        lichtmc.Photometry.from_text(3, "x")
    with pytest.raises(lichtmc.InputError, match="x.ies"):
        lichtmc.Photometry.from_text("not photometric", "x.ies")


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("b_nan.ies", r'b_nan.ies:10: "nan" is not a number'),
        ("b_truncated.ies", "b_truncated.ies: 234 candela values are announced"),
        ("b_ldt_truncated.ldt", "b_ldt_truncated.ldt: 44 candela values are announced"),
    ],
)
def test_faults_are_told_with_file_and_line(name, message):
    with pytest.raises(lichtmc.InputError, match=message):
        lichtmc.Photometry(FOLDER / name)


@pytest.mark.parametrize("directions", [(0, 0), [(0, 0, 0)], [(np.nan, 0, 1)], "down"])
def test_wrong_directions_are_refused(directions):
    with pytest.raises(lichtmc.InputError, match="direction"):
        lichtmc.Photometry(FOLDER / "c_lambert.ies").candela(directions)
