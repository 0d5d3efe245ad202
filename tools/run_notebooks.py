#!/usr/bin/env python3
"""Executes the notebooks of docs/notebooks and compares what they print with what is stored in them.

Usage: tools/run_notebooks.py [--write] [NOTEBOOK ...]

--write stores the outputs in the notebooks instead. Needs lichtmc, nbclient, ipykernel, matplotlib and scipy in the same
Python. Every notebook is executed in a temporary folder beside links to scenes/ and tests/, so that it writes nothing
into the source tree. python/tests/test_notebooks.py calls this.
"""

from __future__ import annotations

import argparse
import contextlib
import pathlib
import sys
import tempfile
from collections.abc import Iterator

import nbformat
from nbclient import NotebookClient

ROOT = pathlib.Path(__file__).resolve().parent.parent
NOTEBOOKS = ROOT / "docs/notebooks"
sys.path.insert(0, str(ROOT / "python/tests"))

from printed import arithmetic, difference  # noqa: E402


@contextlib.contextmanager
def folder_of_notebooks() -> Iterator[pathlib.Path]:
    """A temporary folder from which ../../scenes and ../../tests are those of the source tree."""
    with tempfile.TemporaryDirectory() as name:
        top = pathlib.Path(name)
        for linked in ("scenes", "tests"):
            (top / linked).symlink_to(ROOT / linked)
        folder = top / "docs/notebooks"
        folder.mkdir(parents=True)
        yield folder


def execute(file: pathlib.Path) -> nbformat.NotebookNode:
    """The notebook with the outputs of this machine. An exception in a cell is raised (CellExecutionError)."""
    notebook = nbformat.read(file, as_version=4)
    with folder_of_notebooks() as folder:
        NotebookClient(
            notebook,
            timeout=300,
            kernel_name="python3",
            coalesce_streams=True,
            extra_arguments=["--log-level=ERROR"],
            resources={"metadata": {"path": str(folder)}},
        ).execute()
    return notebook


def printed(cell: nbformat.NotebookNode, stream: str = "stdout") -> str:
    """What a cell has printed, with the text of its value; pictures do not count."""
    texts = []
    for output in cell.get("outputs", []):
        if output["output_type"] == "stream":
            if output["name"] == stream:
                texts.append(output["text"])
        elif stream != "stdout":
            continue
        elif "image/png" not in output.get("data", {}):
            texts.append(output.get("data", {}).get("text/plain", ""))
    return "\n".join(texts)


def check(file: pathlib.Path) -> list[str]:
    """Executes a notebook; gives a sentence for every cell whose text is not the stored one."""
    stored = nbformat.read(file, as_version=4)
    exact = stored.metadata.get("lichtmc", {}).get("arithmetic") == arithmetic()
    faults = []
    for number, (old, new) in enumerate(zip(stored.cells, execute(file).cells, strict=True), start=1):
        if warning := printed(new, "stderr"):
            faults.append(f"{file.name}, cell {number} warns: {warning}")
        if fault := difference(printed(old), printed(new), exact=exact):
            faults.append(f"{file.name}, cell {number}: {fault}")
    return faults


def write(file: pathlib.Path) -> None:
    """Executes a notebook and stores its outputs in it, without times and other things that change with every run."""
    notebook = execute(file)
    for cell in notebook.cells:
        cell.metadata.clear()
    notebook.metadata = nbformat.from_dict(
        {
            "kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"},
            "language_info": {"name": "python"},
            "lichtmc": {"arithmetic": arithmetic()},
        }
    )
    nbformat.validate(notebook)
    nbformat.write(notebook, file)


def main() -> int:
    parser = argparse.ArgumentParser(description="Executes the notebooks of docs/notebooks and compares their outputs.")
    parser.add_argument("--write", action="store_true", help="store the outputs in the notebooks")
    parser.add_argument("notebooks", nargs="*", type=pathlib.Path, metavar="NOTEBOOK")
    arguments = parser.parse_args()
    failed = False
    for file in arguments.notebooks or sorted(NOTEBOOKS.glob("*.ipynb")):
        if arguments.write:
            write(file)
            print(f"{file.name}: outputs stored")
            continue
        faults = check(file)
        failed = failed or bool(faults)
        print("\n".join(faults) if faults else f"{file.name}: as stored")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
