#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "base/lanes.hpp"
#include "chance/directions.hpp"
#include "chance/draw_many.hpp"
#include "chance/lane_math.hpp"
#include "chance/philox.hpp"
#include "chance/sobol.hpp"
#include "chance/stream.hpp"
#include "lichtmc/emitter_law.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

TEST_CASE("Philox gives the published words") {
  // Random123 1.14, kat_vectors: philox4x32, 10 rounds.
  CHECK(philox4x32_10({0, 0, 0, 0}, {0, 0}) == Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
  constexpr std::uint32_t ones = 0xffffffff;
  CHECK(philox4x32_10({ones, ones, ones, ones}, {ones, ones}) == Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
  CHECK(philox4x32_10({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
        Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("words differ with every part of their address") {
  const Stream stream(1);
  const Words words = stream.draw(7, 3, Purpose::flight);
  CHECK(words == Stream(1).draw(7, 3, Purpose::flight));
  CHECK(words != Stream(2).draw(7, 3, Purpose::flight));
  CHECK(words != Stream(1 + (std::uint64_t{1} << 32)).draw(7, 3, Purpose::flight));
  CHECK(words != stream.draw(8, 3, Purpose::flight));
  CHECK(words != stream.draw(7 + (std::uint64_t{1} << 32), 3, Purpose::flight));
  CHECK(words != stream.draw(7, 4, Purpose::flight));
  CHECK(words != stream.draw(7, 3, Purpose::emission));
}

TEST_CASE("the first 2^k points of Sobol's sequence are stratified in every dimension, shifted or not") {
  for (const std::uint32_t shift : {0U, 0x9E3779B9U}) {
    for (std::size_t dimension = 0; dimension < sobol_dimensions; ++dimension) {
      std::array<int, 64> in_stratum{};
      for (std::uint32_t k = 0; k < 64; ++k) ++in_stratum[(sobol(k, dimension) ^ shift) >> 26];
      CHECK(std::all_of(in_stratum.begin(), in_stratum.end(), [](int count) { return count == 1; }));
    }
  }
}

TEST_CASE("Sobol's first two dimensions form a (0, 6, 2)-net") {
  for (int bits = 0; bits <= 6; ++bits) {  // boxes of 2^-bits by 2^-(6 - bits)
    std::array<int, 64> in_box{};
    for (std::uint32_t k = 0; k < 64; ++k) {
      const std::uint64_t x = std::uint64_t{sobol(k, 0)} >> (32 - bits);
      const std::uint64_t y = std::uint64_t{sobol(k, 1)} >> (26 + bits);
      ++in_box[x << (6 - bits) | y];
    }
    CHECK(std::all_of(in_box.begin(), in_box.end(), [](int count) { return count == 1; }));
  }
}

TEST_CASE("Sobol's points follow from the direction numbers of Joe and Kuo") {
  // Point 3 is the sum without carries of the first two direction numbers, m₁/2 and m₂/4.
  const std::array<double, sobol_dimensions> third{0.75, 0.25, 0.25, 0.25, 0.75, 0.75};
  for (std::size_t dimension = 0; dimension < sobol_dimensions; ++dimension)
    CHECK(sobol(3, dimension) * 0x1p-32 == third[dimension]);
}

TEST_CASE("uniform numbers stay in their intervals") {
  CHECK(unit_open(0) == 0x1p-33);
  CHECK(unit_open(0xffffffff) == 1.0 - 0x1p-33);
  CHECK(unit_fine(0, 0) == 0.0);
  CHECK(unit_fine(0xffffffff, 0xffffffff) == 1.0 - 0x1p-53);
}

TEST_CASE("sine and cosine of a turn are accurate to float rounding") {
  double worst = 0.0;
  for (int i = 0; i <= 1 << 16; ++i) {
    const float turns = static_cast<float>(i) * 0x1p-16F;
    float sine = 0.0F;
    float cosine = 0.0F;
    sine_cosine(turns, sine, cosine);
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(turns);
    worst = std::max({worst, std::abs(sine - std::sin(angle)), std::abs(cosine - std::cos(angle))});
  }
  // The angle in a quadrant is rounded once and multiplied by a rounded π/2: two roundings of up to π/4 · 2⁻²⁴ and
  // those of the polynomial, which Moshier gives as 2⁻²³ together.
  CHECK(worst < 1.5e-7);
}

namespace {

// χ² of sampled cosines in 50 equal bins against the integral of a density over the bin, by midpoints of 200 slices.
template <class Sample, class Density>
Judgement cosines_against_density(Sample&& sample, Density&& density) {
  constexpr std::size_t bins = 50;
  constexpr int samples = 1'000'000;
  std::vector<double> counts(bins);
  std::vector<double> expected(bins);
  const Stream stream(11);
  for (int i = 0; i < samples; ++i) {
    const double cosine = sample(stream.draw(static_cast<std::uint64_t>(i), 1, Purpose::flight));
    const double place = (cosine + 1.0) / 2.0 * bins;
    counts[std::min(bins - 1, static_cast<std::size_t>(place))] += 1.0;
  }
  constexpr int slices = 200;
  for (std::size_t b = 0; b < bins; ++b) {
    for (int k = 0; k < slices; ++k) {
      const double cosine = -1.0 + 2.0 * (static_cast<double>(b) + (k + 0.5) / slices) / bins;
      expected[b] += samples * 2.0 * std::numbers::pi * density(cosine) * 2.0 / bins / slices;
    }
  }
  return compare_counts(counts, expected);
}

}  // namespace

TEST_CASE("sampled directions follow their densities") {
  const auto check = [](const char* name, auto&& sample, auto&& density) {
    const Judgement verdict = cosines_against_density(sample, density);
    INFO(name << ": " << verdict.text);
    CHECK(verdict.agrees);
  };
  check(
      "Lambert", [](const Words& w) { return static_cast<double>(sample_lambert(w[0], w[1]).z); }, pdf_lambert);
  check(
      "sphere", [](const Words& w) { return IsotropicLaw{}.sample(unit_open(w[0]), unit_open(w[1])).z; },
      [](double) { return IsotropicLaw{}.density({}); });
  for (const double m : {0.0, 0.5, 1.0, 5.0}) {
    check(
        "generalized Lambert", [m](const Words& w) { return LambertLaw{m}.sample(unit_open(w[0]), unit_open(w[1])).z; },
        [m](double c) { return LambertLaw{m}.density_at(c); });
  }
  check(
      "spot",
      [](const Words& w) {
        return SpotLaw{0.4, 1.2}.sample(unit_open(w[0]), unit_open(w[1])).z;
      },
      [](double c) {
        return SpotLaw{0.4, 1.2}.density({0.0, 0.0, c});
      });
}

TEST_CASE("a density that is one percent off is rejected") {
  const auto lambert = [](const Words& w) { return static_cast<double>(sample_lambert(w[0], w[1]).z); };
  // Exponent 1.02 in place of 1: the smallest mutation of Lambert's law that 10⁶ samples must tell.
  CHECK_FALSE(cosines_against_density(lambert, [](double c) { return LambertLaw{1.02}.density_at(c); }).agrees);
  CHECK_FALSE(cosines_against_density(lambert, [](double c) { return c > 0.0 ? 0.5 / std::numbers::pi : 0.0; }).agrees);
}

TEST_CASE("angles in lanes are those of the C library") {
  const Stream stream(14);
  double worst = 0.0;
  for (std::uint64_t i = 0; i < 200'000; ++i) {
    const Words w = stream.draw(i, 1, Purpose::flight);
    // All quadrants, and ratios from 10⁻⁹ to 10⁹.
    const double y = (w[0] % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, 18.0 * unit_open(w[1]) - 9.0);
    const double x = w[0] % 4 < 2 ? 1.0 : -1.0;
    worst = std::max(worst, std::abs(lane_atan2(y, x) - std::atan2(y, x)));
  }
  CHECK(worst < 1e-15);
  for (const double x : {0.0, -0.0, 1.0, -1.0}) {
    for (const double y : {0.0, -0.0, 1.0, -1.0}) CHECK(lane_atan2(y, x) == std::atan2(y, x));
  }
}

TEST_CASE("azimuths are uniform") {
  std::vector<double> counts(64);
  const Stream stream(12);
  constexpr int samples = 200'000;
  for (int i = 0; i < samples; ++i) {
    const Words w = stream.draw(static_cast<std::uint64_t>(i), 1, Purpose::flight);
    const glm::vec3 v = sample_lambert(w[0], w[1]);
    const double turns =
        std::atan2(static_cast<double>(v.y), static_cast<double>(v.x)) / (2.0 * std::numbers::pi) + 0.5;
    counts[std::min<std::size_t>(63, static_cast<std::size_t>(turns * 64.0))] += 1.0;
  }
  const Judgement verdict = compare_counts(counts, std::vector<double>(64, samples / 64.0));
  INFO(verdict.text);
  CHECK(verdict.agrees);
}

TEST_CASE("narrow beams keep their width at every exponent") {
  // E sin²θ = 2/(m+3); its relative standard error from n samples is √(E s⁴/E² s² − 1)/√n < 1/√n · √(1 + …) ≈ 1/√n for
  // large m.
  constexpr int samples = 100'000;
  for (const double m : {1e3, 1e6, 1e8, 1e12}) {
    const Stream stream(13);
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < samples; ++i) {
      const Words w = stream.draw(static_cast<std::uint64_t>(i), 1, Purpose::flight);
      const glm::dvec3 v = LambertLaw{m}.sample(unit_open(w[0]), unit_open(w[1]));
      const double s = v.x * v.x + v.y * v.y;
      sum += s;
      squares += s * s;
    }
    const double mean = sum / samples;
    const double error = std::sqrt((squares / samples - mean * mean) / samples);
    const Judgement verdict = compare({{mean, error, 2.0 / (m + 3.0), 0.0}});
    INFO("m = " << m << ": " << verdict.text);
    CHECK(verdict.agrees);
  }
}

TEST_CASE("an infinite exponent is a pencil beam") {
  const glm::dvec3 v = LambertLaw{std::numeric_limits<double>::infinity()}.sample(unit_open(5), unit_open(6));
  CHECK(v == glm::dvec3(0.0, 0.0, 1.0));
}

TEST_CASE("no sampled direction is parallel to the surface") {
  for (const std::uint32_t word : {0U, 1U, 0xffffffffU}) {
    const glm::vec3 v = sample_lambert(word, 0x80000000U);
    CHECK(v.z > 0.0F);
    CHECK(v.z <= 1.0F);
    CHECK(std::isfinite(v.x));
  }
}

TEST_CASE("words drawn for many photons equal those drawn one by one") {
  for (const WalkDirection direction : {WalkDirection::forward, WalkDirection::backward}) {
    const Stream stream(0x123456789ABCDEFULL, direction);
    for (const std::size_t n : {1U, 3U, 4U, 7U, 64U, 1023U}) {
      const std::size_t whole = whole_lanes(n);
      std::vector<std::uint64_t> history(whole), chance(whole + 1, 78);
      std::vector<std::uint32_t> polar(whole + 1, 76), azimuth(whole + 1, 77);
      for (std::size_t i = 0; i < n; ++i) history[i] = (std::uint64_t{1} << 32) - 3 + i * 0x100000001ULL;
      draw_many(stream, n, history.data(), 5, Purpose::flight, polar.data(), azimuth.data(), chance.data());
      for (std::size_t i = 0; i < n; ++i) {
        const Words words = stream.draw(history[i], 5, Purpose::flight);
        REQUIRE(polar[i] == words[0]);
        REQUIRE(azimuth[i] == words[1]);
        REQUIRE(static_cast<double>(chance[i] >> 11) * 0x1p-53 == unit_fine(words[2], words[3]));
      }
      REQUIRE(polar[whole] == 76);
      REQUIRE(azimuth[whole] == 77);
      REQUIRE(chance[whole] == 78);
    }
  }
}

TEST_CASE("logarithm and exponential for vectorised loops agree with the C library within some roundings") {
  double worst_log = 0.0;
  double worst_exp = 0.0;
  const auto try_log = [&](std::uint32_t word) {
    worst_log = std::max(worst_log, std::abs(lane_log_unit(word) / std::log((word + 0.5) * 0x1p-32) - 1.0));
  };
  const auto try_exp = [&](float x) {
    worst_exp = std::max(worst_exp, std::abs(lane_expm1(x) / std::expm1(double{x}) - 1.0));
  };
  for (std::uint32_t k = 0; k < 200'000; ++k) {
    try_log(k * 21474U);
    try_log(~k);
    try_log(3037000499U + 100'000U - k);  // about √½
    try_exp(-22.9F * static_cast<float>(k + 1) / 200'000.0F);
  }
  for (const float x : {-1e-38F, -1e-18F, -1e-9F, -0.3465F, -0.3466F, -79.0F}) try_exp(x);
  CHECK(worst_log < 4.0 * 0x1p-24);
  CHECK(worst_exp < 4.0 * 0x1p-24);
  CHECK(lane_expm1(0.0F) == 0.0F);
}
