#include "support/textbook_walk.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>

namespace lichtmc::test {

namespace {

class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : bits_(seed) {}
  double operator()() { return (static_cast<double>(bits_() >> 11) + 0.5) * 0x1p-53; }

 private:
  std::mt19937_64 bits_;
};

// cos θ = u^{1/(m+1)}, φ uniform.
std::array<double, 3> generalized_lambert(Uniform& uniform, double exponent) {
  const double cosine = exponent == 1.0 ? std::sqrt(uniform()) : std::pow(uniform(), 1.0 / (exponent + 1.0));
  const double sine = std::sqrt(1.0 - cosine * cosine);
  const double azimuth = 2.0 * std::numbers::pi * uniform();
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

}  // namespace

std::vector<std::uint64_t> textbook_walk(const TextbookRoom& room, std::uint64_t photons, std::uint64_t seed,
                                         std::uint64_t& impacts) {
  const auto cells = static_cast<std::size_t>(room.cells);
  std::vector<std::uint64_t> hits(6 * cells * cells);
  Uniform uniform(seed);
  for (std::uint64_t photon = 0; photon < photons; ++photon) {
    std::array<double, 3> a = room.emitter;
    const std::array<double, 3> local = generalized_lambert(uniform, room.exponent);
    std::array<double, 3> v{local[0], -local[2], local[1]};
    for (;;) {
      // The nearest of the walls that the photon approaches.
      double lambda = std::numeric_limits<double>::infinity();
      std::size_t axis = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        if (v[k] == 0.0) continue;
        const double to_wall = ((v[k] > 0.0 ? room.size[k] : 0.0) - a[k]) / v[k];
        if (to_wall < lambda) {
          lambda = to_wall;
          axis = k;
        }
      }
      const bool high = v[axis] > 0.0;
      for (std::size_t k = 0; k < 3; ++k) a[k] += lambda * v[k];
      a[axis] = high ? room.size[axis] : 0.0;

      const std::size_t s = (axis + 1) % 3;
      const std::size_t t = (axis + 2) % 3;
      const auto cell = [&](std::size_t k) {
        const double share = a[k] / room.size[k] * room.cells;
        return std::min(static_cast<std::size_t>(std::max(share, 0.0)), cells - 1);
      };
      ++hits[((2 * axis + (high ? 1 : 0)) * cells + cell(s)) * cells + cell(t)];
      ++impacts;

      if (uniform() >= room.reflectance) break;  // absorbed

      const std::array<double, 3> out = generalized_lambert(uniform, 1.0);
      v[s] = out[0];
      v[t] = out[1];
      v[axis] = high ? -out[2] : out[2];
    }
  }
  return hits;
}

}  // namespace lichtmc::test
