// The parts that emitters have in the irradiance at the receivers: light is linear, so that any dimming is a weighted
// sum of these parts, and needs no new photons (lichtmc/dimmed_scene.hpp).
//
// E = Σ fᵢ Eᵢ, fᵢ the factor of emitter i. The parts come from the same walks, and their errors are correlated: the
// covariances between parts give the error of a receiver, groups of rounds those of areas. With all factors 1, value
// and error are those of the run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lichtmc {

// A part is the light of the emitters of one name (and, if they differ in it, one maintenance factor). Arrays are in
// the order receiver, part, the last one fastest. Irradiances in W/m² or lx.
struct EmitterParts {
  struct Part {
    std::string name;
    double power = 0.0;               // W or lm, the maintained power of its emitters
    double maintenance_factor = 1.0;  // power / power of new emitters
  };
  std::vector<Part> parts;
  std::size_t receivers = 0;
  std::uint64_t rounds = 0;                 // of the walks, independent of each other
  std::vector<std::uint64_t> group_rounds;  // of each group of rounds
  std::vector<double> direct;               // without reflection
  std::vector<double> direct_error;         // its standard errors, independent of each other
  std::vector<double> reflected;            // reflected at least once
  // Of the reflected light: receiver, part, group of rounds: the mean of the group.
  std::vector<double> of_groups;
  // Covariances of its means: receiver, pair of parts (i, j ≤ i) as number i (i + 1)/2 + j.
  std::vector<double> covariance;

  std::size_t at(std::size_t receiver, std::size_t part) const { return receiver * parts.size() + part; }
  std::size_t pairs() const { return parts.size() * (parts.size() + 1) / 2; }
  // The irradiance at a receiver by a part: direct and reflected.
  double irradiance(std::size_t receiver, std::size_t part) const {
    return direct[at(receiver, part)] + reflected[at(receiver, part)];
  }
};

}  // namespace lichtmc
