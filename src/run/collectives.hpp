// What a team's members do together. A null team is a run alone: nothing is to do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "lichtmc/communicator.hpp"
#include "walk/backward.hpp"
#include "walk/totals.hpp"

namespace lichtmc {

inline unsigned rank_of(const Communicator* communicator) {
  return communicator == nullptr ? 0 : communicator->rank();
}
inline unsigned size_of(const Communicator* communicator) {
  return communicator == nullptr ? 1 : communicator->size();
}

// Everyone gets the first's value: decisions that hang on floating-point numbers or on time must be the same for all.
template <class Value>
requires std::is_trivially_copyable_v<Value>
void broadcast(Communicator* communicator, Value& value) {
  if (communicator != nullptr) communicator->broadcast(std::as_writable_bytes(std::span(&value, 1)));
}

// How many of the members say so; all hear the same.
std::uint64_t count_votes(Communicator* communicator, bool mine);

// A member's part of n things in a row: every thing belongs to one.
struct Part {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
};
Part part_of(const Communicator* communicator, std::uint64_t n);

// Everyone gets the sums over all.
void reduce(Communicator* communicator, Totals& totals);
void reduce(Communicator* communicator, std::vector<BackwardSums>& sums);
void reduce(Communicator* communicator, BackwardCount& count);
// Of things that one member has filled in and the others have left 0: everyone gets what was filled in, bit for bit.
void combine(Communicator* communicator, std::vector<DirectIrradiance>& things);

}  // namespace lichtmc
