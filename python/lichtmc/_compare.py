"""Comparison of two results."""

from __future__ import annotations

import os

from lichtmc import _core


def compare(
    a: _core.Result | str | os.PathLike[str], b: _core.Result | str | os.PathLike[str]
) -> list[_core.Comparison]:
    """Whether two results agree within their standard errors: `all(compare(a, b))`.

    Tiles are compared with tiles, receivers with receivers. If one result has only tiles and the other only receivers,
    each receiver is compared with the tile at its point. Use different seeds: with the same seed the errors of both are
    correlated.

    Args:
        a: A Result, or the folder of one.
        b: The same: both are results, or both are folders.

    Returns:
        A Comparison of the tiles, and one of the receivers, as far as both have them.

    Raises:
        InputError: The units, tiles or receivers differ, or nothing can be compared.
    """
    if isinstance(a, _core.Result) and isinstance(b, _core.Result):
        return _core.compare(a, b)
    if isinstance(a, (str, os.PathLike)) and isinstance(b, (str, os.PathLike)):
        return _core.compare_folders(os.fspath(a), os.fspath(b))
    raise _core.InputError(
        f"compare() got {type(a).__name__} and {type(b).__name__} (allowed: two results, or two folders). Read a folder "
        "with Result.load()."
    )
