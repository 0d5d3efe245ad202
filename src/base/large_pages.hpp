// Arrays in large pages of memory, for random access.
//
// An array of some hundred kilobytes occupies a hundred pages of the usual size, more than the processor's first table
// of addresses holds, and these pages lie anywhere in memory, so that they may displace each other from the
// second-level cache. One large page needs one entry, and is contiguous. Where the system has none, the array is as
// usual.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace lichtmc {

template <class T>
struct LargePages {
  using value_type = T;

  LargePages() = default;
  template <class U>
  LargePages(const LargePages<U>& /*other*/) {}

  T* allocate(std::size_t n) {
    constexpr std::size_t page = std::size_t{1} << 21;
    // Smaller arrays stay in the first-level cache or close to it.
    constexpr std::size_t fewest = std::size_t{1} << 17;
    const std::size_t bytes = n * sizeof(T);
    const bool large = bytes >= fewest;
    const std::size_t unit = large ? page : std::max(alignof(T), alignof(std::max_align_t));
    void* memory = std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit);
    if (memory == nullptr) throw std::bad_alloc();
#if defined(__linux__)
    if (large) madvise(memory, (bytes + page - 1) / page * page, MADV_HUGEPAGE);  // a request
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t /*n*/) {
    std::free(memory);
  }

  template <class U>
  bool operator==(const LargePages<U>& /*other*/) const {
    return true;
  }
};

}  // namespace lichtmc
