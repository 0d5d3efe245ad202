"""Pictures as arrays."""

from __future__ import annotations

import gc
import struct
import zlib
from pathlib import Path

import lichtmc
import numpy as np
import pytest
import rooms


def test_pixels() -> None:
    picture = rooms.box_result().render(width=320, height=240)
    assert picture.rgba.shape == (240, 320, 4) and picture.rgba.dtype == np.uint8
    assert picture.irradiance.shape == (240, 320) and picture.irradiance.dtype == np.float32
    assert not picture.rgba.flags.writeable and not picture.irradiance.flags.writeable
    assert np.shares_memory(picture.rgba, picture.rgba) and np.shares_memory(picture.irradiance, picture.irradiance)
    drawn = np.isfinite(picture.irradiance)
    assert 0.2 < drawn.mean() < 1 and np.all(picture.rgba[drawn][:, 3] > 0)
    assert (picture.view, picture.colours, picture.logarithmic, picture.low) == ("corner", "viridis", False, 0)
    assert picture.high > 50 and not picture.from_inside and picture.cut_height is None
    assert repr(picture) == "Picture(320 × 240 pixels, view 'corner')"


def test_a_plan_shows_the_floor() -> None:
    result = rooms.box_result()
    picture = result.render("above", width=600, height=400, colours="inferno", scale="log", scale_max=1000)
    assert (picture.view, picture.colours, picture.logarithmic, picture.high) == ("above", "inferno", True, 1000)
    inside = picture.irradiance[np.isfinite(picture.irradiance)]
    assert np.mean(inside) == pytest.approx(result.surfaces["floor"].mean, rel=0.05)


def test_a_picture_is_an_array() -> None:
    picture = rooms.box_result().render(width=64, height=48)
    array = np.asarray(picture)
    assert np.shares_memory(array, picture.rgba)
    assert not np.shares_memory(np.array(picture), picture.rgba)
    assert np.asarray(picture, dtype=float).dtype == np.float64
    del picture
    gc.collect()
    assert array.shape == (48, 64, 4) and array.any()


def test_a_notebook_gets_png_and_svg() -> None:
    picture = rooms.box_result().render(width=64, height=48)
    png = picture._repr_png_()
    assert png[:8] == b"\x89PNG\r\n\x1a\n" and struct.unpack(">II", png[16:24]) == (64, 48)
    data, at = b"", 8
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at : at + 8])
        data += png[at + 8 : at + 8 + length] if kind == b"IDAT" else b""
        at += 12 + length
    assert len(zlib.decompress(data)) == 48 * (1 + 4 * 64)
    svg = picture._repr_svg_()
    assert svg == picture.svg and svg.lstrip().startswith("<") and "Illuminance" in svg and "lx" in svg


def test_files(tmp_path: Path) -> None:
    picture = rooms.box_result().render(width=64, height=48)
    assert picture.irradiance_unit == "lx"
    (tmp_path / "room.png").write_bytes(b"old")
    picture.save(tmp_path / "room.png")
    picture.save(str(tmp_path / "room.SVG"))
    assert (tmp_path / "room.png").read_bytes() == picture._repr_png_()
    assert (tmp_path / "room.SVG").read_text(encoding="utf-8") == picture.svg
    assert sorted(file.name for file in tmp_path.iterdir()) == ["room.SVG", "room.png"]
    (tmp_path / "other").touch()
    assert (tmp_path / "room.png").stat().st_mode == (tmp_path / "other").stat().st_mode
    with pytest.raises(lichtmc.InputError, match=r"'room.jpg' .allowed: .*\.png or \.svg"):
        picture.save("room.jpg")
    with pytest.raises(lichtmc.InputError, match="path is 3"):
        picture.save(3)
    with pytest.raises(lichtmc.InputError, match="path is None"):
        picture.save(None)
    with pytest.raises(lichtmc.RuntimeError, match="No such file or directory"):
        picture.save(tmp_path / "none" / "room.png")
    (tmp_path / "folder.png").mkdir()
    with pytest.raises(lichtmc.RuntimeError, match="folder.png cannot be written"):
        picture.save(tmp_path / "folder.png")
    assert not list(tmp_path.glob(".*"))


def test_without_tiles_a_picture_is_grey() -> None:
    picture = rooms.box_with_parts().render(width=64, height=48)
    opaque = picture.rgba[picture.rgba[..., 3] == 255].astype(int)
    assert len(opaque) > 0 and np.ptp(opaque[:, :3], axis=1).max() <= 3 or np.isnan(picture.irradiance).mean() < 1


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"view": "below"}, "argument view is 'below' .allowed: 'corner', 'above'"),
        ({"view": 3}, "argument view is 3"),
        ({"width": 8}, "width of the picture in pixels is 8 .allowed: .*16"),
        ({"height": 100.5}, "height of the picture in pixels is 100.5"),
        ({"height": "tall"}, "height of the picture in pixels is 'tall'"),
        ({"threads": -1}, "number of threads is -1"),
        ({"colours": "jet"}, "colours is 'jet' .allowed: 'viridis', 'inferno'"),
        ({"scale": "logarithmic"}, "scale is 'logarithmic' .allowed: 'auto', 'linear', 'log'"),
        ({"scale_max": 0.0}, "0"),
    ],
)
def test_wrong_arguments_are_refused(arguments: dict[str, object], message: str) -> None:
    with pytest.raises(lichtmc.InputError, match=message):
        rooms.box_result().render(**arguments)
