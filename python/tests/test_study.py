"""study()."""

from __future__ import annotations

import lichtmc
import numpy as np
import pytest
from rooms import cube


DIRECTIONS = {"forward", "backward"}
ESTIMATORS = {"weight", "collision", "absorption"}


@pytest.fixture(scope="module")
def found() -> tuple[lichtmc.Study, list[lichtmc.StudyProgress]]:
    """A study of 6 s; of more if the processors are so busy that this is not enough for each method."""
    for seconds in (6, 24, 96):
        seen: list[lichtmc.StudyProgress] = []
        study = lichtmc.study(cube(), seconds=seconds, tile=0.5, threads=2, progress=seen.append)
        if DIRECTIONS <= set(study.rows["direction"]) and ESTIMATORS <= set(study.rows["estimator"]):
            break
    return study, seen


def test_rows(found):
    study, _ = found
    rows = study.rows
    assert len(rows) > 5
    assert set(rows["direction"]) == DIRECTIONS
    assert ESTIMATORS <= set(rows["estimator"])
    assert np.all(rows["histories"] > 0) and np.all(rows["seconds"] > 0)
    assert np.all(rows["rms_error"] > 0)
    assert not rows.flags.writeable
    assert study.references["tile"][0] == 0.5
    assert study.references["tiles"][0] == 24


def test_advice_is_in_words_and_figures(found):
    study, _ = found
    for advice in study.advice:
        assert advice.sentence in str(study)
        assert advice.setting["estimator"] in ESTIMATORS
        assert advice.seconds > 0 and advice.histories > 0
    assert repr(study).startswith("<lichtmc.Study of")


def test_progress(found):
    _, seen = found
    assert seen and seen[-1].of_seconds in (6, 24, 96)
    assert any(progress.what for progress in seen)


def test_files(found, tmp_path):
    study, _ = found
    study.write(tmp_path / "study")
    written = {file.name for file in (tmp_path / "study").iterdir()}
    assert {"study.csv", "advice.txt", "error_over_time.svg"} <= written
    assert (tmp_path / "study" / "advice.txt").read_text() == str(study)


def test_wrong_arguments():
    with pytest.raises(lichtmc.InputError):
        lichtmc.study(cube(), seconds=0.1)
    with pytest.raises(lichtmc.InputError):
        lichtmc.study(cube(), seconds=6, tile=-1.0)
