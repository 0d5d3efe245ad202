// Fields of a struct, listed once: what adds, exchanges, stores, compares or describes a struct visits its fields.
//
// A struct that takes part has a function beside it,
//
//   template <class F, AllOf<Ends>... Things>
//   void visit_fields(const F& f, Things&... ends) {
//     f(Field{"absorbed"}, ends.absorbed...);
//     …
//   }
//
// which calls f once per field with the fields of any number of objects of that type. A field that is added there is
// added everywhere; one that is forgotten there is missed by the test of these lists (tests/unit/test_fields.cpp).
#pragma once

#include <cassert>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "base/wide.hpp"

namespace lichtmc {

// What a field is for.
enum class FieldRole {
  sum,      // counted: added up over batches, threads, ranks and parts of a run
  same,     // a setting that must be the same in all parts of a run
  request,  // a setting that may differ between parts: stop rules, a choice left to the program
  record,   // how long and by what it was computed: stored, not compared
  machine,  // how the machine is used: neither stored nor compared
};

struct Field {
  const char* name;  // in state.h5 and summary.json
  FieldRole role = FieldRole::sum;
  const char* label = "";   // for tables of settings
  const char* unit = "";    // of the value in such a table
  const char* option = "";  // of the command line
};

template <class Thing, class Struct>
concept AllOf = std::same_as<std::remove_const_t<Thing>, Struct>;

template <class Thing>
concept HasFields = requires(Thing& thing) {
  visit_fields([](const Field&, auto&) {}, thing);
};

template <class Thing>
inline constexpr bool is_list = false;
template <class Element>
inline constexpr bool is_list<std::vector<Element>> = true;

// Adds b to a, field by field; lists element by element. A list of b may be empty where a's is not.
template <class Thing>
void add_fields(Thing& a, const Thing& b) {
  if constexpr (is_list<Thing>) {
    assert(b.empty() || a.size() == b.size());
    for (std::size_t i = 0; i < b.size(); ++i) add_fields(a[i], b[i]);
  } else if constexpr (HasFields<Thing>) {
    visit_fields([](const Field& /*field*/, auto& x, const auto& y) { add_fields(x, y); }, a, b);
  } else {
    a += b;
  }
}

// Structs and integers that are stored and sent as one row of 64-bit words, the low word of 128 bits first.
template <class Thing>
inline constexpr bool is_row = std::same_as<Thing, int128> || std::same_as<Thing, uint128>;

template <class Thing>
concept RowOfWords = is_row<Thing> && std::is_trivially_copyable_v<Thing> && sizeof(Thing) % sizeof(std::uint64_t) == 0;

}  // namespace lichtmc
