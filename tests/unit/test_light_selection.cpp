// Which emitter a light sample takes: cells of a room's surfaces, and the probabilities in them.
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

#include "support/catch.hpp"
#include "walk/light_selection.hpp"
#include "walk/place_tree.hpp"

using namespace lichtmc;

namespace {

constexpr glm::dvec3 up{0, 1, 0};

// Points on the floors of two rooms, 0 ≤ x < 5 and 5.2 ≤ x < 10, and on both sides of the wall between them.
std::vector<Place> two_floors(std::size_t n) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform;
  std::vector<Place> places;
  for (std::size_t k = 0; k < n; ++k) {
    const double x = 9.8 * uniform(random);
    places.push_back({{x < 5.0 ? x : x + 0.2, 0.0, 4.0 * uniform(random)}, up});
    const bool right = k % 2 == 0;
    places.push_back({{right ? 5.2 : 5.0, 3.0 * uniform(random), 4.0 * uniform(random)}, {right ? 1 : -1, 0, 0}});
  }
  return places;
}

LightSelection random_selection(const std::vector<double>& fluxes, const std::vector<Place>& places) {
  PlaceTree cells(places, 6, 64);
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform;
  const auto table = [&] {
    std::vector<LightSelection::Weight> weights;
    for (std::uint32_t k = 0; k < fluxes.size(); ++k) {
      const double u = uniform(random);
      if (u < 0.6 || k == 0) weights.push_back({k, k == 0 ? 1.0 : u * u * u});
    }
    return weights;
  };
  LightSelection::Tables tables;
  for (std::size_t k = 0; k < cells.size(); ++k) tables.of_cells.push_back({table(), uniform(random)});
  for (std::size_t k = 0; k < cells.regions(); ++k) tables.of_regions.push_back(table());
  tables.of_cells[3] = {};       // a dark cell
  tables.of_regions[0].clear();  // a dark region
  for (std::uint32_t k = 0; k < cells.size(); ++k) {
    if (cells.region_of(k) == 0) tables.of_cells[k] = {};
  }
  return {fluxes, cells, tables};
}

}  // namespace

TEST_CASE("light selection: cells hold their points, and no more than asked for") {
  const std::vector<Place> places = two_floors(1000);
  const PlaceTree tree(places, 6, 100);
  std::size_t members = 0;
  for (std::uint32_t cell = 0; cell < tree.size(); ++cell) {
    CHECK(tree.members(cell).size() <= 6);
    CHECK(!tree.members(cell).empty());
    members += tree.members(cell).size();
    for (const std::uint32_t k : tree.members(cell)) CHECK(tree.cell_of(places[k].point, places[k].normal) == cell);
  }
  CHECK(members == places.size());
  for (std::uint32_t region = 0; region < tree.regions(); ++region) {
    const PlaceTree::Range cells = tree.cells_of_region(region);
    CHECK(tree.members(cells).size() >= 100);
    for (std::uint32_t cell = cells.begin; cell < cells.end; ++cell) CHECK(tree.region_of(cell) == region);
    for (const std::uint32_t other : tree.neighbours(region)) CHECK(other != region);
  }
}

TEST_CASE("light selection: cells end at a wall between rooms, and at its two sides") {
  const std::vector<Place> places = two_floors(1000);
  const PlaceTree tree(places, 6, 100);
  for (std::uint32_t cell = 0; cell < tree.size(); ++cell) {
    std::set<bool> rooms;
    for (const std::uint32_t k : tree.members(cell)) rooms.insert(places[k].point.x > 5.1);
    CHECK(rooms.size() == 1);
  }
  // Along the wall, a millimetre from it.
  for (double z = 0.01; z < 4.0; z += 0.03) CHECK(tree.cell_of({4.999, 0, z}, up) != tree.cell_of({5.201, 0, z}, up));
  CHECK(tree.cell_of({5.0, 1, 1}, {-1, 0, 0}) != tree.cell_of({5.0, 1, 1}, {1, 0, 0}));
  CHECK(tree.cell_of({5.0, 1, 1}, {0, 0, 1}) == tree.size());  // no sample point faces +z
}

TEST_CASE("light selection: points that coincide, few points, none") {
  const PlaceTree one(std::vector<Place>(50, Place{{1, 2, 3}, up}), 6, 100);
  CHECK(one.size() == 1);
  CHECK(one.regions() == 1);
  CHECK(one.neighbours(0).empty());
  CHECK(one.members(0).size() == 50);
  std::vector<Place> beside(50, Place{{1, 2, 3}, up});
  beside.push_back({{1, 2, 3.5}, up});
  CHECK(PlaceTree(beside, 6, 100).size() == 2);
  const PlaceTree none({}, 6, 100);
  CHECK(none.size() == 0);
  CHECK(none.cell_of({1, 2, 3}, up) == 0);
}

TEST_CASE("light selection: probabilities sum to 1, none is 0, and emitters are taken with them") {
  const std::vector<double> fluxes{1500, 1, 300, 1e-3, 700, 1500, 20};
  const LightSelection selection = random_selection(fluxes, two_floors(40));
  std::set<std::uint32_t> seen;
  for (const Place& place : two_floors(40)) seen.insert(selection.cell_of(place.point, place.normal));
  seen.insert(selection.cell_of({0, 0, 0}, {0, 0, 1}));  // in no cell
  CHECK(seen.size() > 10);
  for (const std::uint32_t cell : seen) {
    double sum = 0.0;
    for (std::size_t k = 0; k < fluxes.size(); ++k) {
      CHECK(selection.probability(cell, k) > 0.0);
      sum += selection.probability(cell, k);
    }
    CHECK(sum == Approx(1.0).epsilon(1e-14));
    // Each emitter is taken by the numbers of three intervals at most, so that of n numbers in equal steps three more
    // or less than n q can belong to it.
    constexpr std::uint32_t n = 20'000;
    std::vector<double> taken(fluxes.size(), 0.0);
    for (std::uint32_t i = 0; i < n; ++i) {
      const LightSelection::Choice choice = selection.choose(cell, (i + 0.5) / n);
      REQUIRE(choice.emitter < fluxes.size());
      CHECK(choice.probability == selection.probability(cell, choice.emitter));
      ++taken[choice.emitter];
    }
    for (std::size_t k = 0; k < fluxes.size(); ++k)
      CHECK(std::abs(taken[k] - n * selection.probability(cell, k)) <= 3.0);
    selection.choose(cell, 0.0);
    selection.choose(cell, 1.0 - 0x1p-53);
  }
}

TEST_CASE("light selection: without tables the choice is by flux") {
  const std::vector<double> fluxes{3, 1, 4};
  const LightSelection selection(fluxes);
  const std::uint32_t cell = selection.cell_of({1, 2, 3}, up);
  for (std::size_t k = 0; k < fluxes.size(); ++k) CHECK(selection.probability(cell, k) == Approx(fluxes[k] / 8.0));
  CHECK(selection.choose(cell, 0.3).emitter == 0);
  CHECK(selection.choose(cell, 0.4).emitter == 1);
  CHECK(selection.choose(cell, 0.6).emitter == 2);
}
