"""`python -m lichtmc` is the program lichtmc."""

import sys

from lichtmc._command_line import main

sys.exit(main())
