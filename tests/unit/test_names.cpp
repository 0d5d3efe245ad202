// Patterns of names, and similar names.
#include <string>
#include <vector>

#include "base/names.hpp"
#include "support/catch.hpp"

using namespace lichtmc;

TEST_CASE("a pattern fits names as in a shell") {
  CHECK(matches_pattern("Wall", "Wall"));
  CHECK(!matches_pattern("Wall", "wall"));
  CHECK(!matches_pattern("Wall", "Wall.001"));
  CHECK(matches_pattern("Wall*", "Wall"));
  CHECK(matches_pattern("Wall*", "Wall.001"));
  CHECK(matches_pattern("*/top", "desk_1/top"));
  CHECK(matches_pattern("*", ""));
  CHECK(!matches_pattern("", "a"));
  CHECK(matches_pattern("W?nd", "Wänd"));  // one character of two bytes
  CHECK(!matches_pattern("W?nd", "Wnd"));
  CHECK(matches_pattern("top_[0-9]", "top_7"));
  CHECK(!matches_pattern("top_[0-9]", "top_a"));
  CHECK(matches_pattern("top_[!0-9]", "top_a"));
  CHECK(matches_pattern("[äö]", "ö"));
  CHECK(matches_pattern("a[b", "a[b"));
  CHECK(matches_pattern("[x]", "[x]"));  // the name itself
  CHECK(matches_pattern("[x]", "x"));
  CHECK(matches_pattern("\xFF*", "\xFF\xFE"));  // not UTF-8
  // Many stars need no time that grows exponentially.
  CHECK(!matches_pattern("*a*a*a*a*a*a*a*a*a*a*b", std::string(2000, 'a')));
}

TEST_CASE("the distance of two names counts their edits") {
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("power", "Power") == 0);
  CHECK(edit_distance("power", "powre") == 1);
  CHECK(edit_distance("reflectance", "reflectence") == 1);
  CHECK(edit_distance("reflectance", "reflektanz") == 3);
}

TEST_CASE("similar names are listed, else the first ones") {
  CHECK(nearest_names("Wal", {"Wall", "Floor", "Walls", "Wall"}) == "'Wall', 'Walls'");
  CHECK(nearest_names("xyzw", {"b", "a"}) == "'a', 'b'");
  CHECK(nearest_names("x", {}) == "none");
}
