"""compare() and compare_designs()."""

from __future__ import annotations

import lichtmc
import numpy as np
import pytest
from rooms import command_line, cube, living_room


@pytest.fixture(scope="module")
def two() -> list[lichtmc.Result]:
    return [lichtmc.simulate(cube(), photons=50_000, tile=0.5, seed=seed) for seed in (1, 2)]


def test_results_of_the_same_room_agree(two):
    a, b = two
    (comparison,) = lichtmc.compare(a, b)
    assert comparison and comparison.agree
    assert comparison.what == "tiles"
    count = len(comparison)
    assert count == len(a.tiles) == len(comparison.names)
    for name in ("a", "error_a", "b", "error_b", "z", "freedom"):
        array = getattr(comparison, name)
        assert array.shape == (count,) and array.dtype == np.float64 and not array.flags.writeable
    assert np.array_equal(comparison.a, a.tiles.irradiance)
    assert np.array_equal(comparison.error_b, b.tiles.standard_error)
    assert np.allclose(comparison.z, (comparison.b - comparison.a) / np.hypot(comparison.error_a, comparison.error_b))
    assert comparison.chi_square == pytest.approx(np.sum(comparison.z**2))
    assert abs(comparison.z[comparison.largest]) == abs(comparison.largest_z)
    assert comparison.difference == pytest.approx(comparison.b.mean() / comparison.a.mean() - 1)
    assert "They agree" in str(comparison) and "they agree" in repr(comparison)


def test_arrays_live_longer_than_the_comparison(two):
    (comparison,) = lichtmc.compare(*two)
    a = comparison.a
    kept = a.copy()
    del comparison
    assert np.array_equal(a, kept)


@pytest.mark.filterwarnings("ignore::lichtmc.ResultWarning")
def test_less_light_disagrees(two):
    darker = lichtmc.simulate(cube(), photons=50_000, tile=0.5, seed=3, max_bounces=2, estimator="weight")
    (comparison,) = lichtmc.compare(two[0], darker)
    assert not comparison
    assert comparison.difference < 0
    assert "They disagree" in str(comparison)


def test_folders_give_the_comparison_of_the_command_line(two, tmp_path):
    for name, result in zip("ab", two, strict=True):
        result.write(tmp_path / name, report=False, images=False)
    (in_memory,) = lichtmc.compare(*two)
    (of_folders,) = lichtmc.compare(tmp_path / "a", str(tmp_path / "b"))
    assert np.array_equal(in_memory.z, of_folders.z)
    assert str(of_folders) == command_line("compare", "a", "b", folder=tmp_path)


def test_what_cannot_be_compared(two, tmp_path):
    with pytest.raises(lichtmc.InputError, match="Result and PosixPath"):
        lichtmc.compare(two[0], tmp_path)
    with pytest.raises(lichtmc.InputError, match="int"):
        lichtmc.compare(3, 4)
    with pytest.raises(lichtmc.InputError):
        lichtmc.compare(tmp_path, tmp_path)  # no results in it
    with pytest.raises(lichtmc.InputError):
        lichtmc.compare(two[0], lichtmc.simulate(living_room(), photons=5000, tile=0.5))
    with pytest.raises(lichtmc.InputError):
        lichtmc.compare_designs(tmp_path, tmp_path)
