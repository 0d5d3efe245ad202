"""The command `lichtmc`: the program, from the same code as the module."""

from __future__ import annotations

import os
import sys

from lichtmc import _core


def main() -> int:
    """Runs the program with the words of the command line; returns its exit status."""
    return _core.run_command_line([b"lichtmc", *map(os.fsencode, sys.argv[1:])])
