"""Files of pictures: Picture.save()."""

from __future__ import annotations

import os
import secrets
from pathlib import Path
from typing import Any

from lichtmc import _core


def _write_whole(file: Path, content: bytes) -> None:
    """Writes a file beside its place and moves it there: it is never half written."""
    name = file.parent / f".{file.name}.{secrets.token_hex(8)}.part"
    try:
        handle = os.open(name, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
    except OSError as error:
        raise _core.RuntimeError(
            f"The file {file} cannot be written: {error.strerror}. Choose another folder, or make this one."
        ) from error
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(content)
        os.replace(name, file)
    except BaseException as error:
        os.unlink(name)
        if isinstance(error, OSError):
            raise _core.RuntimeError(f"The file {file} cannot be written: {error.strerror}.") from error
        raise


def save(picture: _core.Picture, path: str | os.PathLike[str]) -> None:
    """See Picture.save()."""
    try:
        file = Path(path)
    except TypeError:
        raise _core.InputError(
            f"The argument path is {path!r} (allowed: the name of a file that ends with .png or .svg). Give one."
        ) from None
    ending = file.suffix.lower()
    if ending == ".png":
        pixels: Any = picture  # the stub has no private methods
        _write_whole(file, pixels._repr_png_())
    elif ending == ".svg":
        _write_whole(file, picture.svg.encode())
    else:
        raise _core.InputError(
            f"The argument path is {str(path)!r} (allowed: a name that ends with .png or .svg). Give such a name; for "
            "other formats save numpy.asarray(picture) with a library for images."
        )
