// The memory that this process may use.
#pragma once

namespace lichtmc {

// Bytes: the machine's memory, or less if a limit is set on the process (ulimit -v) or on its group (containers and
// batch systems: Linux control groups). Infinity if nothing is known.
double memory_limit();

// Bytes that this process can get in addition to what it has, without making the machine swap: what the machine, the
// limit of the process and those of its group leave. Infinity if nothing is known.
double memory_available();

// Bytes of memory that this process has; 0 if that is not known.
double memory_used();

}  // namespace lichtmc
