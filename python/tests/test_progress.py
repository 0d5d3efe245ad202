"""progress=True: on a terminal, in a notebook, in a file."""

from __future__ import annotations

import os
import pty
import re
import subprocess
import sys
import termios
from types import SimpleNamespace

import lichtmc
import pytest
from lichtmc import _progress
from rooms import ENVIRONMENT, SCENES, cube, living_room

# Ended by the time, half of which each walk has: some reports of both come on machines of any speed. Runs of more than two
# seconds would also tell their end.
RUN = f"""
import lichtmc
room = lichtmc.Room.from_gltf({str(SCENES / "living_room.glb")!r})
print(lichtmc.simulate(room, photons=10**9, max_time=1, tile=0.5, progress=True).stopped_by)
"""
WITHOUT_TQDM = "import sys; sys.modules['tqdm'] = None\n"


def at(**values: object) -> SimpleNamespace:
    """A Progress with these values."""
    usual = {"stage": "tiles", "step": "", "histories": 0, "target": 10**6, "seconds": 1.0}
    unknown = {"rms_relative_error": float("nan"), "seconds_to_target": float("nan")}
    return SimpleNamespace(**{**usual, **unknown, **values})


def on_a_terminal(program: str, *, stdout: int | None = None, **variables: str) -> str:
    """What a program shows on a terminal of 60 columns; its stdout may be elsewhere."""
    ours, theirs = pty.openpty()
    termios.tcsetwinsize(ours, (24, 60))
    environment = {name: value for name, value in ENVIRONMENT.items() if name not in ("COLUMNS", "LINES")}
    with subprocess.Popen(
        [sys.executable, "-c", program],
        stdout=theirs if stdout is None else stdout,
        stderr=theirs,
        env={**environment, **variables},
    ) as process:
        os.close(theirs)
        shown = b""
        while True:
            try:
                piece = os.read(ours, 65536)
            except OSError:  # the terminal was closed at the other end
                break
            if not piece:
                break
            shown += piece
    os.close(ours)
    assert process.returncode == 0, shown
    return shown.decode()


def lines_of(shown: str) -> list[str]:
    """The lines that replaced each other; each fits into the terminal."""
    lines = shown.split("\r")
    assert any("of 1G histories for the tiles" in line for line in lines)
    assert all(len(line.replace("\x1b[K", "").rstrip("\n")) < 60 for line in lines)
    return lines


def test_a_line_on_a_terminal():
    lines = lines_of(on_a_terminal(WITHOUT_TQDM + RUN))
    assert "\x1b[Kmax-time" in lines[-2] + lines[-1]  # the line is removed; what is printed follows


def test_a_line_has_the_width_of_the_terminal_of_stderr():
    lines_of(on_a_terminal(WITHOUT_TQDM + RUN, stdout=subprocess.DEVNULL))
    lines_of(on_a_terminal(WITHOUT_TQDM + RUN, COLUMNS="200"))


def test_a_line_on_an_unknown_terminal():
    replace = "import io\nclass Own(io.StringIO):\n    def isatty(self): return True\nsys.stderr = Own()\n"
    shown = on_a_terminal(WITHOUT_TQDM + replace + RUN + "print('histories for the tiles' in sys.stderr.getvalue())")
    assert shown.split() == ["max-time", "True"]


def test_a_bar_on_a_terminal():
    pytest.importorskip("tqdm")
    shown = on_a_terminal(RUN)
    assert "tiles: " in shown and "/1.00G" in shown and "receivers: " in shown


def test_lines_in_a_file():
    code = "from lichtmc import _progress; _progress._LINE_INTERVAL = 0.05\n" + RUN
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=ENVIRONMENT, timeout=60)
    assert done.stdout == "max-time\n"
    assert "\r" not in done.stderr and "\x1b" not in done.stderr
    assert "histories for the tiles" in done.stderr


def test_an_output_of_a_notebook():
    shown = []

    class Handle:
        def update(self, data, raw):
            shown.append(data["text/plain"])

    def display(data, raw, display_id):
        shown.append(data["text/plain"])
        return Handle()

    line = _progress._NotebookLine(display, None)
    line(at(stage="preparation", step="Laying out tiles"))
    line(at(histories=250_000, rms_relative_error=0.012))
    line.close()
    assert shown == ["Laying out tiles", "250k of 1M histories for the tiles, error 1.2 %, about 3 s left", ""]


def test_the_time_that_is_left():
    text = _progress._text
    assert text(at(histories=1000, target=2**62), None) == "1k histories for the tiles"
    assert text(at(histories=1000, target=2**62, seconds_to_target=7300.0), None).endswith("about 2 h 1 min left")
    assert text(at(histories=1000, target=2**62, seconds_to_target=90.0), 31.0).endswith("about 30 s left")
    assert text(at(stage="direct light", histories=5, target=10), None) == "direct light of 5 of 10"
    assert text(at(stage="pilot"), None) == "choosing the estimator"


def test_no_progress_prints_nothing(capfd):
    for progress in (None, False):
        lichtmc.simulate(cube(), photons=5000, tile=0.5, progress=progress)
    captured = capfd.readouterr()
    assert captured.out == captured.err == ""


def test_progress_is_readable() -> None:
    seen: list[str] = []
    lichtmc.simulate(living_room(), photons=10**9, max_time=1, only="tiles", progress=lambda p: seen.append(repr(p)))
    assert any(text.startswith("preparation: ") for text in seen)
    pattern = r"tiles: [0-9.e+]+ of 1e\+09, \d+\.\d s(, error [0-9.e+]+ %)?"
    walks = [text for text in seen if text.startswith("tiles: ")]
    assert walks and all(re.fullmatch(pattern, text) for text in walks)


def test_without_a_limit_there_is_none_in_the_text() -> None:
    seen: list[str] = []
    lichtmc.simulate(living_room(), max_time=1.5, progress=lambda p: seen.append(repr(p)))
    walks = [text for text in seen if text.startswith("tiles: ")]
    assert walks and not any(" of " in text for text in walks)


def printed(max_time: float) -> str:
    program = f"""
import lichtmc
room = lichtmc.Room.from_gltf({str(SCENES / "cube_paper.gltf")!r})
result = lichtmc.simulate(room, max_time={max_time}, progress=True)
"""
    done = subprocess.run(
        [sys.executable, "-c", program], env=ENVIRONMENT, check=True, capture_output=True, text=True, timeout=120
    )
    assert done.stdout == ""
    return done.stderr


def test_the_end_of_a_run_is_told_in_a_file() -> None:
    lines = printed(max_time=2.2).splitlines()
    assert re.fullmatch(
        r"[\d ]+ tiles: rms relative standard error [0-9.e-]+ % after [\d ]+ histories \(collision, 2\.\d s, ended by "
        r"max-time\)",
        lines[-1],
    ), lines
    assert printed(max_time=0.1) == ""
