// The members of a result, for archives, as in fields_of_room.hpp; without its state, which has a format of its own.
#pragma once

#include "fields_of_room.hpp"
#include "lichtmc/result.hpp"

#include <cereal/types/complex.hpp>  // needs the macros of cereal.hpp, which it does not include

namespace lichtmc {

template <class Archive>
void serialize(Archive& archive, Figure& figure) {
  auto& [value, standard_error] = figure;
  archive(value, standard_error);
}

template <class Archive>
void serialize(Archive& archive, FrequencyRange& range) {
  auto& [first, last, step] = range;
  archive(first, last, step);
}

template <class Archive>
void serialize(Archive& archive, ChannelSettings& settings) {
  auto& [bin_width, time_span, orders, per_emitter, squared_weights, frequencies] = settings;
  archive(bin_width, time_span, orders, per_emitter, squared_weights, frequencies);
}

template <class Archive>
void serialize(Archive& archive, Settings& settings) {
  auto& [estimator, photons, first_history, part, error_floor_share, error_floor, target_error, max_seconds, measured,
         tile_walk, receiver_walk, direct, direct_error, max_bounces, tile_edge, seed, channel, per_emitter, threads,
         engine] = settings;
  archive(estimator, photons, first_history, part, error_floor_share, error_floor, target_error, max_seconds, measured,
          tile_walk, receiver_walk, direct, direct_error, max_bounces, tile_edge, seed, channel, per_emitter, threads,
          engine);
}

template <class Archive>
void serialize(Archive& archive, ConvergencePoint& point) {
  auto& [histories, seconds, error] = point;
  archive(histories, seconds, error);
}

template <class Archive>
void serialize(Archive& archive, WalkReport& report) {
  auto& [estimator, choice, receiver_walk, rounds, photons_per_round, walks_per_round, stopped_by, histories, impacts,
         rays, connections, shadow_rays, retraced, undecided, seconds, direct_seconds, error, error_without_floor,
         error_floor, figure_of_merit, histories_to_target, convergence] = report;
  archive(estimator, choice, receiver_walk, rounds, photons_per_round, walks_per_round, stopped_by, histories, impacts,
          rays, connections, shadow_rays, retraced, undecided, seconds, direct_seconds, error, error_without_floor,
          error_floor, figure_of_merit, histories_to_target, convergence);
}

template <class Archive>
void serialize(Archive& archive, Balance& balance) {
  auto& [emitted, absorbed, escaped, residual, lost] = balance;
  archive(emitted, absorbed, escaped, residual, lost);
}

template <class Archive>
void serialize(Archive& archive, Cover& cover) {
  auto& [over, under, behind, area, undecided] = cover;
  archive(over, under, behind, area, undecided);
}

template <class Archive>
void serialize(Archive& archive, TileResult& tile) {
  auto& [power, irradiance, standard_error, hits, direct] = tile;
  archive(power, irradiance, standard_error, hits, direct);
}

template <class Archive>
void serialize(Archive& archive, SurfaceResult& surface) {
  auto& [name, material, reflectance, area, tiles, mean, minimum, maximum, standard_error, power, behind_share, hits,
         mean_direct, absorbed, unreached_area, covered] = surface;
  archive(name, material, reflectance, area, tiles, mean, minimum, maximum, standard_error, power, behind_share, hits,
          mean_direct, absorbed, unreached_area, covered);
}

template <class Archive>
void serialize(Archive& archive, TileMap& map) {
  auto& [name, surface, side, chart, chart_reason, columns, rows, uv_min, uv_max, tile_of_cell] = map;
  archive(name, surface, side, chart, chart_reason, columns, rows, uv_min, uv_max, tile_of_cell);
}

template <class Archive>
void serialize(Archive& archive, Tile& tile) {
  auto& [map, column, row, triangle, point, area] = tile;
  archive(map, column, row, triangle, point, area);
}

template <class Archive>
void serialize(Archive& archive, Tiling& tiling) {
  auto& [maps, tiles, cells] = tiling;
  archive(maps, tiles, cells);
}

template <class Archive>
void serialize(Archive& archive, ReceiverResult& receiver) {
  auto& [irradiance, direct, indirect, standard_error, gain] = receiver;
  archive(irradiance, direct, indirect, standard_error, gain);
}

template <class Archive>
void serialize(Archive& archive, AreaResult& result) {
  auto& [area, mean, minimum, maximum, uniformity, diversity, lowest, highest, lowest_cell, highest_cell, initial_mean,
         initial_minimum, initial_maximum, mean_verdict, uniformity_verdict, verdict] = result;
  archive(area, mean, minimum, maximum, uniformity, diversity, lowest, highest, lowest_cell, highest_cell, initial_mean,
          initial_minimum, initial_maximum, mean_verdict, uniformity_verdict, verdict);
}

template <class Archive>
void serialize(Archive& archive, EmitterParts::Part& part) {
  auto& [name, power, maintenance_factor] = part;
  archive(name, power, maintenance_factor);
}

template <class Archive>
void serialize(Archive& archive, EmitterParts& parts) {
  auto& [of, receivers, rounds, group_rounds, direct, direct_error, reflected, of_groups, covariance] = parts;
  archive(of, receivers, rounds, group_rounds, direct, direct_error, reflected, of_groups, covariance);
}

template <class Archive>
void serialize(Archive& archive, Channel& channel) {
  auto& [emitter, receiver, gain, line_of_sight, diffuse, rician_k, first_arrival, first_arrival_is_exact,
         first_reflection, mean_delay, mean_excess_delay, rms_spread, diffuse_mean_delay, diffuse_rms_spread,
         squared_rms_spread, squared_diffuse_rms_spread, electrical, optical, beyond] = channel;
  archive(emitter, receiver, gain, line_of_sight, diffuse, rician_k, first_arrival, first_arrival_is_exact,
          first_reflection, mean_delay, mean_excess_delay, rms_spread, diffuse_mean_delay, diffuse_rms_spread,
          squared_rms_spread, squared_diffuse_rms_spread, electrical, optical, beyond);
}

template <class Archive>
void serialize(Archive& archive, ImpulseResponses& responses) {
  auto& [bin_width, bins, time_span_was_chosen, orders, emitters, powers, delays, receivers, h, standard_error, h_all,
         standard_error_all, order_gain, order_beyond, order_first, frequencies, from_bins, response, magnitude_error,
         channels, groups] = responses;
  archive(bin_width, bins, time_span_was_chosen, orders, emitters, powers, delays, receivers, h, standard_error, h_all,
          standard_error_all, order_gain, order_beyond, order_first, frequencies, from_bins, response, magnitude_error,
          channels, groups);
}

template <class Archive>
void serialize(Archive& archive, Result& result) {
  auto& [room, quantity, settings, engine, walk, receiver_walk, choices, threads, processes, checkpoint_seconds,
         lost_histories, balance, incident, incident_standard_error, tiles_without_hits, unreached, unreached_tiles,
         covers, tiles, surfaces, tiling, receivers, receiver_results, areas, parts, channels, ignored, overrides,
         state, warnings] = result;
  static_cast<void>(state);
  archive(room, quantity, settings, engine, walk, receiver_walk, choices, threads, processes, checkpoint_seconds,
          lost_histories, balance, incident, incident_standard_error, tiles_without_hits, unreached, unreached_tiles,
          covers, tiles, surfaces, tiling, receivers, receiver_results, areas, parts, channels, ignored, overrides,
          warnings);
}

}  // namespace lichtmc
