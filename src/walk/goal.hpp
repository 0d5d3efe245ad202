// Goals: the purpose of a wave. The kernel moves the photons; a goal determines where they start and what is recorded.
//
// A goal is a class derived from GoalBase that redefines the steps it needs; the others do nothing. The kernel is a
// template over it, so that a step that does nothing costs nothing.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>

#include "tracer/tracer.hpp"
#include "walk/totals.hpp"
#include "walk/wave.hpp"

namespace lichtmc {

class GoalBase {
 public:
  // The history of photon k of the batch is number first_history + k: it selects the photon's random words.
  explicit GoalBase(std::uint64_t first_history = 0) : first_history_(first_history) {}

  // The treatment of a flight that hits no surface; the counter of rays.
  static Misses misses() { return Misses::escape; }
  TraceCount& traced() { return traced_; }
  // The balance of the photons, in units of the score.
  Ends& ends() { return ends_; }

  // Sets the histories' numbers of all photons.
  void number_histories(Wave& wave) const {
    for (std::size_t i = 0; i < wave.rays.size; ++i) wave.history[i] = first_history_ + wave.photon[i];
  }

  // The steps of a flight, in the order in which the kernel calls them.
  void cover(const Wave& /*wave*/, std::size_t /*i*/) {}   // photon i starts on a covered part of a surface: it ends
  void escape(const Wave& /*wave*/, std::size_t /*i*/) {}  // photon i hit no surface
  void split(Wave& /*wave*/) {}        // after the flight: photons may be split into several, or removed from the end
  void land(Wave& /*wave*/) {}         // all photons have landed
  void score(const Wave& /*wave*/) {}  // all score; land() has prefetched the memory
  void absorb(const Wave& /*wave*/, std::size_t /*i*/, double /*reflectance*/) {}  // photon i ends on its surface
  // The same for n photons at the places `at`.
  void absorb_all(const Wave& /*wave*/, const std::uint32_t* /*at*/, std::size_t /*n*/) {}
  // Photon i has lost this many units of the score (≥ 0) to its surface, whether it ends there or not; see
  // counts_absorption.
  void count_absorbed(std::size_t /*i*/, int128 /*units*/) {}
  void reflect(const Wave& /*wave*/, std::uint32_t /*flight*/) {}  // all remaining photons have been reflected
  void cut_off(const Wave& /*wave*/, std::size_t /*i*/) {}         // the walk ends for photon i

  // Photon `from` moves to position `to`; the wave has already moved its own data for the next flight.
  void move(Wave& /*wave*/, std::size_t /*from*/, std::size_t /*to*/) {}
  // Array for the cosines of the angles at which photons leave surfaces, filled by the kernel; or null.
  float* cosines() { return nullptr; }

  // Whether the kernel calls absorb(); and whether it may process survival in lanes. Then move() is called for photons
  // that others have left by escape only: it moves what land() reads, and no data of the wave for the next flight;
  // absorb_all() is called instead of absorb(), and land() must set Wave::surface if the policy reads it, as those of
  // the estimators do.
  static constexpr bool watches_absorption = false;
  static constexpr bool in_lanes = false;
  // Whether the kernel calls count_absorbed() in rooms with reflectance maps; in others the power that a surface
  // absorbs follows from its reflectance.
  static constexpr bool counts_absorption = false;

 protected:
  std::uint64_t first_history_;

 private:
  TraceCount traced_;
  Ends ends_;
};

// start(wave, n) sets the starts of the first n photons: direction, and start point or position on a facet. It may
// change their order (Wave::photon) and their number.
template <class Goal>
concept WalkGoal = std::derived_from<Goal, GoalBase> && requires(Goal goal, Wave wave, std::uint32_t n, std::size_t i) {
  { goal.start(wave, n) } -> std::same_as<void>;
  { goal.misses() } -> std::same_as<Misses>;
  { goal.traced() } -> std::same_as<TraceCount&>;
  { goal.ends() } -> std::same_as<Ends&>;
  { goal.number_histories(wave) } -> std::same_as<void>;
  { goal.cover(wave, i) } -> std::same_as<void>;
  { goal.escape(wave, i) } -> std::same_as<void>;
  { goal.split(wave) } -> std::same_as<void>;
  { goal.land(wave) } -> std::same_as<void>;
  { goal.score(wave) } -> std::same_as<void>;
  { goal.absorb(wave, i, 0.5) } -> std::same_as<void>;
  { goal.absorb_all(wave, &n, i) } -> std::same_as<void>;
  { goal.count_absorbed(i, int128{}) } -> std::same_as<void>;
  { goal.reflect(wave, n) } -> std::same_as<void>;
  { goal.cut_off(wave, i) } -> std::same_as<void>;
  { goal.move(wave, i, i) } -> std::same_as<void>;
  { goal.cosines() } -> std::same_as<float*>;
  { Goal::watches_absorption } -> std::convertible_to<bool>;
  { Goal::in_lanes } -> std::convertible_to<bool>;
  { Goal::counts_absorption } -> std::convertible_to<bool>;
};

// A goal that ends photons by roulette before their next flight, after reflect(): play() changes the weights and sets
// marks, 1 for photons that fly on, else 0. An array of whole_lanes() elements.
template <class Goal>
concept PlaysBeforeFlight = requires(Goal goal, Wave wave, std::uint8_t* marks) {
  { goal.play(wave, marks) } -> std::same_as<void>;
};

}  // namespace lichtmc
