// Collective operations of the ranks of a run. A null communicator means a single process: they do nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "base/fields.hpp"
#include "lichtmc/communicator.hpp"
#include "walk/backward.hpp"
#include "walk/channel_sums.hpp"
#include "walk/totals.hpp"

namespace lichtmc {

inline unsigned rank_of(const Communicator* communicator) {
  return communicator == nullptr ? 0 : communicator->rank();
}
inline unsigned size_of(const Communicator* communicator) {
  return communicator == nullptr ? 1 : communicator->size();
}

// Broadcast from rank 0: a decision that depends on floating-point numbers or on time must be the same for all ranks.
template <class Value>
requires std::is_trivially_copyable_v<Value>
void broadcast(Communicator* communicator, Value& value) {
  if (communicator != nullptr) communicator->broadcast(std::as_writable_bytes(std::span(&value, 1)));
}

// The number of ranks for which `mine` is true; all ranks get the same number.
std::uint64_t count_votes(Communicator* communicator, bool mine);

// Sums the fields of structs over all ranks, see base/fields.hpp.
class Reduction {
 public:
  explicit Reduction(Communicator& communicator) : communicator_(communicator) {}

  void add(std::uint64_t& number) { words_.push_back(&number); }
  void add(int128& number) { wide_.push_back(reinterpret_cast<std::uint64_t*>(&number)); }
  void add(uint128& number) { wide_.push_back(reinterpret_cast<std::uint64_t*>(&number)); }
  void add(std::vector<std::uint64_t>& list) {
    if (!list.empty()) communicator_.sum(list);
  }
  template <RowOfWords Element>
  void add(std::vector<Element>& list) {
    if (list.empty()) return;
    communicator_.sum_wide({reinterpret_cast<std::uint64_t*>(list.data()), list.size() * sizeof(Element) / word});
  }
  // The shortest of all ranks.
  void add(std::vector<Earliest>& list);
  template <HasFields Thing>
  void add(Thing& thing) {
    visit_fields([this](const Field& /*field*/, auto& value) { this->add(value); }, thing);
  }
  // Sends the single numbers.
  void finish();

 private:
  static constexpr std::size_t word = sizeof(std::uint64_t);

  Communicator& communicator_;
  std::vector<std::uint64_t*> words_;
  std::vector<std::uint64_t*> wide_;  // two words each
};

// The part of a rank: elements first … last − 1 of n. Every element belongs to one rank.
struct Part {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
};
Part part_of(const Communicator* communicator, std::uint64_t n);

// Reduction: every rank gets the sums over all ranks. Single numbers are sent together, lists one by one.
template <class Thing>
void reduce(Communicator* communicator, Thing& thing) {
  if (communicator == nullptr) return;
  Reduction reduction(*communicator);
  reduction.add(thing);
  reduction.finish();
}

// Combines vectors of which each element was set by one rank and is 0 on the others: all ranks get the elements that
// were set, bit for bit.
void combine(Communicator* communicator, std::vector<DirectIrradiance>& things);

}  // namespace lichtmc
