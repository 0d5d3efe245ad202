// Loops whose passes are shared by several threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

namespace lichtmc {

// The processors that this process may use: batch systems and mpirun bind processes to some of them. At least 1.
unsigned usable_processors();

// Calls use(k) once for every k in 0 … count − 1, on up to `threads` (≥ 1) threads; the calling thread is one of them.
// The threads take the numbers in order. What use(k) does must not depend on the others, so that the result is the same
// for any number of threads. If a call throws, no others begin, and of the exceptions that with the smallest number is
// rethrown. Fewer threads than asked for do the work if the system cannot start more.
void for_each_on_threads(unsigned threads, std::size_t count, const std::function<void(std::size_t)>& use);

// Calls use(first, last) for consecutive ranges of 0 … count − 1 of `length` (≥ 1) numbers each, as above.
template <class Use>
void for_each_range(unsigned threads, std::size_t count, std::size_t length, const Use& use) {
  for_each_on_threads(threads, (count + length - 1) / length,
                      [&](std::size_t k) { use(k * length, std::min(count, (k + 1) * length)); });
}

}  // namespace lichtmc
