"""Every notebook runs without an exception (they check their own outcome) and prints what is stored in it."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

for needed in ("nbclient", "ipykernel", "matplotlib", "scipy"):
    pytest.importorskip(needed)

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))

import run_notebooks  # noqa: E402

FILES = sorted(run_notebooks.NOTEBOOKS.glob("*.ipynb"))


def test_all_notebooks_are_found() -> None:
    assert len(FILES) == 5


@pytest.mark.parametrize("file", FILES, ids=[file.stem for file in FILES])
def test_notebook(file: Path) -> None:
    assert run_notebooks.check(file) == []


@pytest.mark.parametrize("file", FILES, ids=[file.stem for file in FILES])
def test_notebook_is_small(file: Path) -> None:
    # They are in the repository with their pictures.
    assert file.stat().st_size < 400_000
