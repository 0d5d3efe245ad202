"""resume() and merge(): the digits of one run."""

from __future__ import annotations

import lichtmc
import pytest
from rooms import cube, living_room, same, same_tiles


def test_resume_gives_the_digits_of_one_run():
    first = lichtmc.simulate(cube(), photons=5000, tile=0.5)
    before = first.tiles.irradiance.copy()
    both = lichtmc.resume(first, photons=12_000)
    assert same_tiles(both, lichtmc.simulate(cube(), photons=12_000, tile=0.5))
    assert same(first.tiles.irradiance, before)  # the old result is unchanged


def test_resume_without_rules_keeps_to_those_of_the_run():
    done = lichtmc.simulate(cube(), photons=5000, tile=0.5)
    assert same_tiles(lichtmc.resume(done), done)


def test_resume_to_an_error():
    first = lichtmc.simulate(cube(), photons=5000, tile=0.5)
    more = lichtmc.resume(first, target_error=0.05)
    assert more.stopped_by == "target-error"
    assert same_tiles(more, lichtmc.simulate(cube(), target_error=0.05, tile=0.5))


def test_resume_to_fewer_photons_gives_the_result():
    first = lichtmc.simulate(cube(), photons=5000, tile=0.5)
    assert same_tiles(lichtmc.resume(first, photons=2048), first)


def test_a_target_error_in_per_cent_is_refused():
    message = r"target_error is 2, which means 200 % .*For 2 % give target_error=0\.02"
    with pytest.raises(lichtmc.InputError, match=message):
        lichtmc.simulate(cube(), target_error=2)
    with pytest.raises(lichtmc.InputError, match=message):
        lichtmc.resume(lichtmc.simulate(cube(), photons=5000, tile=0.5), target_error=2)


def test_resume_keeps_other_settings():
    first = lichtmc.simulate(cube(), photons=5000, tile=0.5, seed=7, estimator="weight")
    assert same_tiles(
        lichtmc.resume(first, photons=9000),
        lichtmc.simulate(cube(), photons=9000, tile=0.5, seed=7, estimator="weight"),
    )


@pytest.mark.filterwarnings("ignore::lichtmc.ResultWarning")
def test_resume_completes_an_interrupted_run():
    def interrupt(progress):
        if progress.stage == "tiles" and progress.histories > 0:
            raise KeyboardInterrupt

    whole = lichtmc.simulate(living_room(), photons=2_000_000)
    part = lichtmc.simulate(living_room(), photons=2_000_000, progress=interrupt)
    assert part.stopped_by == "interrupt"
    assert not same_tiles(part, whole)
    assert same_tiles(lichtmc.resume(part), whole)


def test_wrong_arguments_of_resume():
    with pytest.raises(lichtmc.InputError, match="type str"):
        lichtmc.resume("folder")
    done = lichtmc.simulate(cube(), photons=5000, tile=0.5)
    with pytest.raises(lichtmc.InputError):
        lichtmc.resume(done, target_error=-1.0)
    with pytest.raises(lichtmc.InputError):
        lichtmc.resume(done, photons=0)


def test_merge_gives_the_digits_of_one_run():
    parts = [
        lichtmc.simulate(cube(), tile=0.5, histories=part) for part in ((0, 2048), (2048, 4096), (4096, 10_000))
    ]
    whole = lichtmc.simulate(cube(), tile=0.5, photons=10_000)
    assert same_tiles(lichtmc.merge(parts), whole)
    assert same_tiles(lichtmc.merge(reversed(parts)), whole)
    assert same_tiles(lichtmc.merge([lichtmc.merge(parts[:2]), parts[2]]), whole)


def test_a_gap_is_allowed_and_told():
    first, _, last = [
        lichtmc.simulate(cube(), tile=0.5, histories=part) for part in ((0, 2048), (2048, 4096), (4096, 6144))
    ]
    with pytest.warns(lichtmc.ResultWarning, match="No part contains the histories 2048 to 4095") as caught:
        merged = lichtmc.merge([first, last])
    assert all(warning.filename == __file__ for warning in caught)
    with pytest.raises(lichtmc.InputError, match="gap"):
        lichtmc.resume(merged, photons=10_000)


def test_what_cannot_be_merged():
    part = lichtmc.simulate(cube(), tile=0.5, histories=(0, 2048))
    with pytest.raises(lichtmc.InputError, match="no results"):
        lichtmc.merge([])
    with pytest.raises(lichtmc.InputError, match="one Result"):
        lichtmc.merge(part)
    with pytest.raises(lichtmc.InputError, match=r"results\[1\].*type int"):
        lichtmc.merge([part, 3])
    with pytest.raises(lichtmc.InputError, match=r"results\[1\]"):  # the same histories twice
        lichtmc.merge([part, part])
    other = lichtmc.simulate(living_room(), tile=0.5, histories=(2048, 4096))
    with pytest.raises(lichtmc.InputError, match="room"):
        lichtmc.merge([part, other])
