// Functions that the tests of extreme cases share.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/rooms.hpp"

namespace lichtmc::test {

inline constexpr Engine both_engines[] = {Engine::cuboid, Engine::embree};
inline constexpr Estimator all_estimators[] = {Estimator::weight, Estimator::collision, Estimator::absorption};

inline double power_on(const Result& result, const std::string& surface) {
  return surface_named(result, surface).power;
}

// A share of independent photons against its probability, with the binomial law's error.
inline Compared share(double measured, double probability, std::uint64_t photons) {
  return {measured, std::sqrt(probability * (1.0 - probability) / static_cast<double>(photons)), probability, 0.0};
}

inline void check_shares(const std::vector<Compared>& shares) {
  const Judgement verdict = compare(shares);
  INFO(verdict.text);
  CHECK(verdict.agrees);
}

inline void check_all_finite(const Result& result) {
  for (const TileResult& tile : result.tiles) {
    REQUIRE(std::isfinite(tile.power));
    REQUIRE(std::isfinite(tile.irradiance));
    REQUIRE(std::isfinite(tile.standard_error));
  }
  CHECK(std::isfinite(result.balance.absorbed));
  CHECK(std::isfinite(result.incident));
  CHECK(result.lost_histories == 0);
}

// The tiles with light.
inline std::vector<std::size_t> lit_tiles(const Result& result) {
  std::vector<std::size_t> lit;
  for (std::size_t k = 0; k < result.tiles.size(); ++k) {
    if (result.tiles[k].hits > 0) lit.push_back(k);
  }
  return lit;
}

// The message with which a room or a setting is refused; empty if it is accepted.
template <class Work>
std::string refusal(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace lichtmc::test
