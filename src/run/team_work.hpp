// What a team's members do together. A null team is a run alone: nothing is to do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "lichtmc/team.hpp"
#include "walk/backward.hpp"
#include "walk/totals.hpp"

namespace lichtmc {

inline unsigned rank_of(const Team* team) {
  return team == nullptr ? 0 : team->rank();
}
inline unsigned size_of(const Team* team) {
  return team == nullptr ? 1 : team->size();
}

// Everyone gets the first's value: decisions that hang on floating-point numbers or on time must be the same for all.
template <class Value>
requires std::is_trivially_copyable_v<Value>
void share(Team* team, Value& value) {
  if (team != nullptr) team->share(std::as_writable_bytes(std::span(&value, 1)));
}

// How many of the members say so; all hear the same.
std::uint64_t votes_for(Team* team, bool mine);

// A member's part of n things in a row: every thing belongs to one.
struct Part {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
};
Part part_of(const Team* team, std::uint64_t n);

// Everyone gets the sums over all.
void add_up(Team* team, Totals& totals);
void add_up(Team* team, std::vector<ReceiverSums>& sums);
void add_up(Team* team, BackwardCount& count);
// Of things that one member has filled in and the others have left 0: everyone gets what was filled in, bit for bit.
void collect(Team* team, std::vector<DirectIrradiance>& things);

}  // namespace lichtmc
