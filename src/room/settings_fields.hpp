// The fields of Settings, listed once: for state.h5, for the question whether parts belong to one run, for tables.
#pragma once

#include <array>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/fields.hpp"
#include "base/message.hpp"
#include "lichtmc/settings.hpp"

namespace lichtmc {

template <class F, AllOf<Settings>... Things>
void visit_fields(const F& f, Things&... s) {
  using enum FieldRole;
  f(Field{"seed", same, "seed", "", "--seed"}, s.seed...);
  f(Field{"tile_edge_m", same, "edge of a tile", "m", "--tile"}, s.tile_edge_m...);
  f(Field{"estimator", request, "estimator asked for", "", "--estimator"}, s.estimator...);
  f(Field{"engine", request, "engine asked for", "", "--engine"}, s.engine...);
  f(Field{"measured", same, "measured", "", "--only"}, s.measured...);
  f(Field{"tile_walk", same, "direction of the walk for tiles", "", "--tiles"}, s.tile_walk...);
  f(Field{"receiver_walk", same, "walk for receivers", "", "--receiver-walk"}, s.receiver_walk...);
  f(Field{"direct", same, "direct light of tiles", "", "--direct"}, s.direct...);
  f(Field{"direct_error", same, "error of direct light", "", "--direct-error"}, s.direct_error...);
  f(Field{"max_bounces", same, "flights after which a history ends", "", "--max-bounces"}, s.max_bounces...);
  f(Field{"bin_width_s", same, "width of a time bin", "s", "--impulse-response"}, s.channel.bin_width_s...);
  f(Field{"time_span_s", same, "time span of impulse responses", "s", "--time-span"}, s.channel.time_span_s...);
  f(Field{"orders", same, "reflections kept apart", "", "--orders"}, s.channel.orders...);
  f(Field{"per_emitter", same, "channels of each emitter", "", "--per-emitter"}, s.channel.per_emitter...);
  f(Field{"keeps_parts", same, "parts of each emitter", "", "--per-emitter"}, s.per_emitter...);
  f(Field{"first_frequency_hz", same, "first frequency", "Hz", "--frequencies"}, s.channel.frequencies.first_hz...);
  f(Field{"last_frequency_hz", same, "last frequency", "Hz", "--frequencies"}, s.channel.frequencies.last_hz...);
  f(Field{"frequency_step_hz", same, "step of frequencies", "Hz", "--frequencies"}, s.channel.frequencies.step_hz...);
  f(Field{"squared_weights", same, "delay spread with weights h²", "", "--squared-weights"},
    s.channel.squared_weights...);
  f(Field{"first_history", request, "first history", "", "--histories"}, s.first_history...);
  f(Field{"part", request, "part of a run", "", "--histories"}, s.part...);
  f(Field{"photons", request, "histories asked for", "", "--photons"}, s.photons...);
  f(Field{"error_floor_share", request, "error floor, share of the mean", "", "--error-floor"}, s.error_floor_share...);
  f(Field{"error_floor", request, "error floor instead", "W/m² or lx", "--error-floor"}, s.error_floor...);
  f(Field{"target_error", request, "target error", "", "--target-error"}, s.target_error...);
  f(Field{"max_seconds", request, "time limit", "s", "--max-time"}, s.max_seconds...);
  f(Field{"threads", machine, "threads", "", "--threads"}, s.threads...);
}

// The values of an enumeration that a setting has; each has a word, see to_string().
template <class Choice>
inline constexpr std::array<Choice, 0> all_values{};
template <>
inline constexpr std::array all_values<Estimator>{Estimator::weight, Estimator::collision, Estimator::absorption,
                                                  Estimator::automatic};
template <>
inline constexpr std::array all_values<Engine>{Engine::automatic, Engine::cuboid, Engine::embree, Engine::embree_fast};
template <>
inline constexpr std::array all_values<Measured>{Measured::all, Measured::tiles, Measured::receivers};
template <>
inline constexpr std::array all_values<WalkDirection>{WalkDirection::forward, WalkDirection::backward};
template <>
inline constexpr std::array all_values<ReceiverWalk>{ReceiverWalk::automatic, ReceiverWalk::two_way,
                                                     ReceiverWalk::next_event, ReceiverWalk::backward};
template <>
inline constexpr std::array all_values<Direct>{Direct::sampled, Direct::analytic};

// A setting as text for messages and tables; "none" where an optional one is not given.
inline std::string setting_text(bool value) {
  return value ? "yes" : "no";
}
inline std::string setting_text(double value) {
  return to_text(value);
}
template <std::unsigned_integral Number>
requires(!std::same_as<Number, bool>) std::string setting_text(Number value) {
  return value == no_photon_limit ? "no limit" : std::to_string(value);
}
template <class Choice>
requires std::is_enum_v<Choice> std::string setting_text(Choice value) {
  return std::string(to_string(value));
}
template <class Value>
std::string setting_text(const std::optional<Value>& value) {
  return value ? setting_text(*value) : "none";
}

}  // namespace lichtmc
