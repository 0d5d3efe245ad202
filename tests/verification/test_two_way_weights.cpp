// Histories from the emitters and walks from a receiver, with the weights that combine them.
//
// In a cube whose floor alone reflects, E of a receiver that looks down has one path: emitter, floor, receiver. The
// histories from the emitters are written here, as plainly as possible, with the forward weight; the walks are those of
// the engine. Their sum must be that of the walks alone, and the integral over the floor.
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include <glm/geometric.hpp>

#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/verdict.hpp"
#include "walk/backward.hpp"
#include "walk/receiver_points.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double reflectance = 0.5;
constexpr std::uint64_t rounds = 4000;

// A unit cube with a reflecting floor (y = 0).
Room cube_with(std::vector<Emitter> emitters, const Receiver& receiver) {
  Room room = make_cuboid({1, 1, 1}, {0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  room.surfaces[surface_number(room, "floor")].reflectance = reflectance;
  room.emitters = std::move(emitters);
  room.receivers = {receiver};
  return room;
}

// Isotropic emitters with the probability that a light sample takes each of them.
struct Lamps {
  std::vector<glm::dvec3> positions;
  std::vector<double> powers;

  double power() const {
    double sum = 0.0;
    for (const double one : powers) sum += one;
    return sum;
  }
  double chance(std::size_t i) const { return positions.size() <= 4 ? 1.0 : powers[i] / power(); }
  // Irradiance on the floor.
  double irradiance(std::size_t i, const glm::dvec3& at) const {
    const glm::dvec3 way = positions[i] - at;
    return powers[i] / (4.0 * pi) * way.y / std::pow(glm::length(way), 3);
  }
  std::vector<Emitter> emitters() const {
    std::vector<Emitter> all;
    for (std::size_t i = 0; i < positions.size(); ++i) all.push_back(isotropic(positions[i], powers[i]));
    return all;
  }
};

// The receiver, looking down, and what it sees of the floor.
struct FieldOfView {
  Receiver receiver;

  double squared_sine() const { return std::pow(std::sin(receiver.half_angle_deg * pi / 180.0), 2); }
  // cos θ cos ψ/(π r²), 0 outside the field of view.
  double exchange(const glm::dvec3& at) const {
    const glm::dvec3 way = receiver.position - at;
    const double r = glm::length(way);
    if (way.y / r < std::cos(receiver.half_angle_deg * pi / 180.0)) return 0.0;
    return way.y * way.y / (pi * r * r * r * r);
  }
};

struct Mean {
  double value = 0.0;
  double variance = 0.0;  // of the mean
};

Mean mean_of(const std::vector<double>& samples) {
  Mean mean;
  for (const double one : samples) mean.value += one / static_cast<double>(samples.size());
  for (const double one : samples) mean.variance += (one - mean.value) * (one - mean.value);
  mean.variance /= static_cast<double>(samples.size()) * static_cast<double>(samples.size() - 1);
  return mean;
}

// Rounds of plan.forward histories from the lamps; forward_weight(i, p_F, p_r) of a path from lamp i.
template <class Weight>
Mean forward(const Lamps& lamps, const FieldOfView& view, const RoundPlan& plan, const Weight& forward_weight) {
  std::mt19937_64 bits(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::discrete_distribution<std::size_t> choose(lamps.powers.begin(), lamps.powers.end());
  std::vector<double> samples(rounds, 0.0);
  for (double& sum : samples) {
    for (std::uint32_t n = 0; n < plan.forward; ++n) {
      const std::size_t i = choose(bits);
      const double down = 2.0 * unit(bits) - 1.0;
      const double azimuth = 2.0 * pi * unit(bits);
      if (down <= 0.0) continue;
      const double out = std::sqrt(1.0 - down * down) * lamps.positions[i].y / down;
      const glm::dvec3 at(lamps.positions[i].x + out * std::cos(azimuth), 0.0,
                          lamps.positions[i].z + out * std::sin(azimuth));
      if (at.x < 0.0 || at.x > 1.0 || at.z < 0.0 || at.z > 1.0) continue;
      const double exchange = view.exchange(at);
      if (exchange == 0.0) continue;
      const double weight = forward_weight(i, lamps.irradiance(i, at) / lamps.power(), exchange / view.squared_sine());
      sum += weight * lamps.power() / plan.forward * reflectance * exchange;
    }
  }
  return mean_of(samples);
}

// The same from the ceiling (y = 1), an area light of 1 W by Lambert's law.
Mean forward_from_ceiling(const FieldOfView& view, const RoundPlan& plan) {
  std::mt19937_64 bits(12);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<double> samples(rounds, 0.0);
  for (double& sum : samples) {
    for (std::uint32_t n = 0; n < plan.forward; ++n) {
      const double squared = unit(bits);
      const double azimuth = 2.0 * pi * unit(bits);
      const double out = std::sqrt(squared / (1.0 - squared));
      const glm::dvec3 at(unit(bits) + out * std::cos(azimuth), 0.0, unit(bits) + out * std::sin(azimuth));
      if (at.x < 0.0 || at.x > 1.0 || at.z < 0.0 || at.z > 1.0) continue;
      const double exchange = view.exchange(at);
      if (exchange == 0.0) continue;
      // Exitance 1 W/m² over 1 m²: the density with which a flight from the floor hits x₀ is also e₀/ΣΦ; that of light
      // samples is 1/m².
      const double p_hit = (1.0 - squared) * (1.0 - squared) / pi;
      const double forward = plan.forward * p_hit;
      const double backward = plan.backward * exchange / view.squared_sine() * (1.0 + p_hit);
      sum += forward / (forward + backward) / plan.forward * reflectance * exchange;
    }
  }
  return mean_of(samples);
}

Mean backward(const Room& room, const RoundPlan& plan, Estimator estimator) {
  const Tiling tiling = make_tiling(room, 0.5);
  const Scene scene(room, tiling, Engine::cuboid);
  const DirectLight light(room, *scene.tracer);
  const std::vector<ReferencePoint> points = receiver_points(room, *scene.tracer);
  const ReceiverOrigins origins(points, *scene.tracer);
  const Settings settings = settings_of(estimator, Engine::cuboid, 1e4, 5);
  const auto walk = make_backward_walk(scene, light, origins, BackwardScale(room), settings, plan);
  std::vector<double> samples(rounds, 0.0);
  BackwardCount count;
  // In two parts: rounds are numbered from the first of the work.
  for (const std::uint64_t part : {0U, 1U}) {
    std::vector<double> some(rounds / 2, 0.0);
    walk->collect({0, 1, part * rounds / 2 * plan.backward, (part + 1) * rounds / 2 * plan.backward}, some, count,
                  [] { return false; });
    std::copy(some.begin(), some.end(), samples.begin() + static_cast<std::ptrdiff_t>(part * rounds / 2));
  }
  return mean_of(samples);
}

// ∫ ρ e(x) cos θ cos ψ/(π r²) dA by midpoints: with 400² of them, of a smooth integrand, far below the errors; at the
// rim of a field of view, of 30 % of E, below 10⁻⁴ of it.
template <class Irradiance>
double over_floor(const FieldOfView& view, const Irradiance& irradiance) {
  constexpr int n = 400;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      const glm::dvec3 at((i + 0.5) / n, 0.0, (k + 0.5) / n);
      sum += reflectance * irradiance(at) * view.exchange(at) / n / n;
    }
  }
  return sum;
}

Compared sum_of(const Mean& a, const Mean& b, double expected) {
  return {a.value + b.value, std::sqrt(a.variance + b.variance), expected, 0.0};
}

const Lamps one_lamp{{{0.3, 0.7, 0.4}}, {1.0}};
// More than are sampled one by one, of different powers; the last is close to the floor.
const Lamps six_lamps{
    {{0.2, 0.9, 0.2}, {0.8, 0.8, 0.3}, {0.5, 0.9, 0.9}, {0.1, 0.5, 0.8}, {0.9, 0.4, 0.9}, {0.6, 0.05, 0.5}},
    {1.0, 2.0, 0.5, 1.5, 0.7, 0.3}};
const FieldOfView all_around{{"", {0.55, 0.3, 0.6}, {0, -1, 0}, 90.0, 1.0}};
const FieldOfView narrow{{"", {0.55, 0.3, 0.6}, {0, -1, 0}, 35.0, 1.0}};
const FieldOfView near_floor{{"", {0.6, 0.02, 0.55}, {0, -1, 0}, 90.0, 1.0}};

}  // namespace

TEST_CASE("two-way walks: both directions together have the mean of the walks from the receiver") {
  std::vector<Compared> figures;
  for (const Lamps& lamps : {one_lamp, six_lamps}) {
    for (const FieldOfView& view : {all_around, narrow, near_floor}) {
      const Room room = cube_with(lamps.emitters(), view.receiver);
      const double exact = over_floor(view, [&](const glm::dvec3& at) {
        double sum = 0.0;
        for (std::size_t i = 0; i < lamps.positions.size(); ++i) sum += lamps.irradiance(i, at);
        return sum;
      });
      for (const RoundPlan& plan : {RoundPlan{0, 5}, RoundPlan{7, 3}, RoundPlan{50, 1}}) {
        const auto weight = [&](std::size_t i, double p_forward, double p_receiver) {
          const double ahead = plan.forward * p_forward;
          return ahead / (ahead + plan.backward * p_receiver * lamps.chance(i));
        };
        const Mean ahead = plan.forward > 0 ? forward(lamps, view, plan, weight) : Mean{};
        figures.push_back(sum_of(ahead, backward(room, plan, Estimator::weight), exact));
      }
    }
  }
  check("point emitters", compare(figures));
}

TEST_CASE("two-way walks: with an area light both techniques of the walk and the histories share one path") {
  std::vector<Compared> figures;
  for (const FieldOfView& view : {all_around, narrow, near_floor}) {
    Room room = cube_with({}, view.receiver);
    room.emitters.push_back(surface_emitter(surface_number(room, "ceiling"), 1.0));
    const Lamps none;
    // The irradiance on the floor by the ceiling: π times the mean radiance, 1/π W/(m² sr), times the form factor.
    const auto irradiance = [](const glm::dvec3& at) {
      const auto corner = [](double a, double b) {
        const double u = a / std::sqrt(1.0 + a * a);
        const double v = b / std::sqrt(1.0 + b * b);
        return (u * std::atan(b / std::sqrt(1.0 + a * a)) + v * std::atan(a / std::sqrt(1.0 + b * b))) / (2.0 * pi);
      };
      return corner(at.x, at.z) + corner(1.0 - at.x, at.z) + corner(at.x, 1.0 - at.z) + corner(1.0 - at.x, 1.0 - at.z);
    };
    const double exact = over_floor(view, irradiance);
    for (const RoundPlan& plan : {RoundPlan{0, 5}, RoundPlan{7, 3}, RoundPlan{50, 1}}) {
      const Mean ahead = plan.forward > 0 ? forward_from_ceiling(view, plan) : Mean{};
      for (const Estimator estimator : {Estimator::weight, Estimator::absorption})
        figures.push_back(sum_of(ahead, backward(room, plan, estimator), exact));
    }
  }
  check("a luminous ceiling", compare(figures));
}

TEST_CASE("two-way walks: a density that forgets the probability of the emitter is detected") {
  std::vector<Compared> figures;
  for (const FieldOfView& view : {all_around, near_floor}) {
    const Room room = cube_with(six_lamps.emitters(), view.receiver);
    const double exact = over_floor(view, [&](const glm::dvec3& at) {
      double sum = 0.0;
      for (std::size_t i = 0; i < six_lamps.positions.size(); ++i) sum += six_lamps.irradiance(i, at);
      return sum;
    });
    const RoundPlan plan{50, 1};
    const auto weight = [&](std::size_t, double p_forward, double p_receiver) {
      return plan.forward * p_forward / (plan.forward * p_forward + plan.backward * p_receiver);
    };
    figures.push_back(sum_of(forward(six_lamps, view, plan, weight), backward(room, plan, Estimator::weight), exact));
  }
  CHECK_FALSE(compare(figures).agrees);
}
