"""The Python code of docs/python.md and of the README runs, and prints what stands below it.

The ```python blocks of a page are executed one after the other in one namespace, in a temporary folder beside links to
scenes/ and tests/. A ```text block that follows one directly is what it prints (numbers: see printed.py).
"""

from __future__ import annotations

import contextlib
import io
import re
import warnings
from pathlib import Path

from printed import difference

ROOT = Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"^```python\n(.*?)^```\n(?:\n?^```text\n(.*?)^```\n)?", re.MULTILINE | re.DOTALL)


def blocks(text: str) -> list[tuple[int, str, str]]:
    """(line, code, what it prints) of each block."""
    return [(text.count("\n", 0, found.start(1)) + 1, found[1], found[2] or "") for found in BLOCK.finditer(text)]


def execute(page: Path, text: str, folder: Path) -> list[str]:
    """Runs the blocks of a page; gives a sentence for every one that prints something else than the page says."""
    for linked in ("scenes", "tests"):
        (folder / linked).symlink_to(ROOT / linked)
    first_line = page.read_text(encoding="utf-8").index(text)
    offset = page.read_text(encoding="utf-8").count("\n", 0, first_line)
    names: dict[str, object] = {"__name__": "page"}
    faults = []
    with contextlib.chdir(folder):
        for line, code, expected in blocks(text):
            shown = io.StringIO()
            # Lines of the page in tracebacks.
            source = compile("\n" * (offset + line - 1) + code, str(page), "exec")
            with contextlib.redirect_stdout(shown), warnings.catch_warnings():
                warnings.simplefilter("ignore")
                exec(source, names)  # noqa: S102
            if expected and (fault := difference(expected, shown.getvalue(), exact=False)):
                faults.append(f"{page.name}, line {offset + line}: {fault}")
    return faults


def readme_section() -> str:
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    found = re.search(r"^## In Python$.*?(?=^## )", text, re.MULTILINE | re.DOTALL)
    assert found, "README.md has no section 'In Python'."
    return found[0]


def test_code_of_the_page(tmp_path: Path) -> None:
    page = ROOT / "docs/python.md"
    assert execute(page, page.read_text(encoding="utf-8"), tmp_path) == []


def test_code_of_the_readme(tmp_path: Path) -> None:
    assert execute(ROOT / "README.md", readme_section(), tmp_path) == []


def test_the_readme_has_ten_lines_that_print_something() -> None:
    (_, code, expected), *_ = blocks(readme_section())
    assert len([line for line in code.splitlines() if line.strip()]) <= 10
    assert expected


def test_a_wrong_number_in_a_page_is_found(tmp_path: Path) -> None:
    section = readme_section()
    floor = re.search(r"^floor: (\d+\.\d+)", section, re.MULTILINE)
    assert floor
    wrong = section.replace(floor[1], f"{float(floor[1]) + 1:.2f}")
    # The text must be part of the page for the numbers of its lines: a copy of the page with it.
    page = tmp_path / "page.md"
    page.write_text(wrong, encoding="utf-8")
    (tmp_path / "run").mkdir()
    faults = execute(page, wrong, tmp_path / "run")
    assert len(faults) == 1
    assert floor[1] in faults[0]
