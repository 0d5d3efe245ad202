// The lists of fields: each names every field of its struct.
#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "base/fields.hpp"
#include "room/settings_fields.hpp"
#include "run/state_data.hpp"
#include "support/catch.hpp"
#include "walk/backward.hpp"
#include "walk/totals.hpp"

using namespace lichtmc;

namespace {

struct Extent {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t alignment = 1;
};

// Bytes of a struct that no field of its list covers and that are more than the padding before the next field. A small
// field that lies where padding would be goes unnoticed.
template <class Thing>
std::vector<Extent> gaps_in(const Thing& thing) {
  const auto* start = reinterpret_cast<const char*>(&thing);
  std::vector<Extent> extents;
  visit_fields(
      [&](const Field& /*field*/, const auto& value) {
        const auto begin = static_cast<std::size_t>(reinterpret_cast<const char*>(&value) - start);
        extents.push_back({begin, begin + sizeof value, alignof(decltype(value))});
      },
      thing);
  std::sort(extents.begin(), extents.end(), [](const Extent& a, const Extent& b) { return a.begin < b.begin; });
  extents.push_back({sizeof thing, sizeof thing, alignof(Thing)});
  std::vector<Extent> gaps;
  std::size_t end = 0;
  for (const Extent& extent : extents) {
    if (extent.begin - end >= extent.alignment) gaps.push_back({end, extent.begin, extent.alignment});
    end = extent.end;
  }
  return gaps;
}

struct Forgetful {
  double first = 0.0;
  double second = 0.0;
  double third = 0.0;
};

template <class F, AllOf<Forgetful>... Things>
void visit_fields(const F& f, Things&... things) {
  f(Field{"first"}, things.first...);
  f(Field{"third"}, things.third...);
}

}  // namespace

TEST_CASE("every field of a struct is in its list") {
  CHECK(gaps_in(TraceCount{}).empty());
  CHECK(gaps_in(Moments{}).empty());
  CHECK(gaps_in(Ends{}).empty());
  CHECK(gaps_in(Totals{}).empty());
  CHECK(gaps_in(BackwardSums{}).empty());
  CHECK(gaps_in(BackwardCount{}).empty());
  CHECK(gaps_in(Settings{}).empty());
  CHECK(gaps_in(Counted{}).empty());
  CHECK(gaps_in(BackwardState{}).empty());
  CHECK(gaps_in(MomentSums{}).empty());
  CHECK(gaps_in(ChannelSums{}).empty());
  CHECK(gaps_in(StateData{}).empty());
  CHECK(gaps_in(Forgetful{}).size() == 1);  // the check itself
}

TEST_CASE("fields are added one by one, lists element by element") {
  Totals a(2, 1, Hits::apart);
  Totals b(2, 1, Hits::are_the_score);  // no list of hits
  a.histories = 1024;
  b.histories = 2048;
  a.ends.lost = -3;
  b.ends.lost = 5;
  a.hits = {7, 8};
  b.tiles[1].sum = 4;
  b.traced.shadow_rays = 6;
  b.traced.undecided = 13;
  a.add(b);
  CHECK(a.histories == 3072);
  CHECK(a.ends.lost == 2);
  CHECK(a.hits == std::vector<std::uint64_t>{7, 8});
  CHECK(a.tiles[1].sum == 4);
  CHECK(a.traced.shadow_rays == 6);
  CHECK(a.traced.undecided == 13);
}
