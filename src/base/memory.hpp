// The memory that this process may use.
#pragma once

namespace lichtmc {

// Bytes: the machine's memory, or less if a limit is set on the process (ulimit -v) or on its group (containers and
// batch systems: Linux control groups). Infinity if nothing is known.
double memory_limit();

}  // namespace lichtmc
