#!/usr/bin/env python3
"""Writes the pages of the Python interface: python3 tools/python_pages.py FOLDER.

They describe what `from lichtmc import *` gives, and RuntimeError, which it leaves out because Python has that name too.
"""

import sys
from pathlib import Path

import lichtmc
import pdoc

lichtmc.__all__.append("RuntimeError")
pdoc.render.configure(docformat="restructuredtext")
pdoc.pdoc("lichtmc", output_directory=Path(sys.argv[1]))
