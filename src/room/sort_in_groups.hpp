// A sort by a small number first.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/parallel.hpp"

namespace lichtmc {

// Sorts by a number below `count` that key() returns, then by `less`. If few have the same number, as few edges begin
// at the same corner, this takes a fraction of the time of a sort of all. The groups are sorted on up to `threads` (≥
// 1) threads.
template <class Thing, class Key, class Less>
void sort_in_groups(std::vector<Thing>& things, std::size_t count, const Key& key, const Less& less,
                    unsigned threads = 1) {
  std::vector<std::size_t> place(count + 1, 0);  // next place of each number: at first the start of its group
  for (const Thing& thing : things) ++place[key(thing) + 1];
  for (std::size_t k = 0; k < count; ++k) place[k + 1] += place[k];
  std::vector<Thing> sorted(things.size());
  for (const Thing& thing : things) sorted[place[key(thing)]++] = thing;
  constexpr std::size_t at_a_time = 65536;
  for_each_range(threads, count, at_a_time, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {  // place[k] is now the end of group k
      const std::size_t first = k == 0 ? 0 : place[k - 1];
      std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(first),
                sorted.begin() + static_cast<std::ptrdiff_t>(place[k]), less);
    }
  });
  things = std::move(sorted);
}

}  // namespace lichtmc
