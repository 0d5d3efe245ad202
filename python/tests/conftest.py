"""For all tests: Ctrl-C works, also where the tests run in the background."""

import signal

# A shell starts programs in the background with SIGINT ignored, and Python then leaves it so, as do the programs that
# it starts.
signal.signal(signal.SIGINT, signal.default_int_handler)
