#include "run/receive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "base/message.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/units.hpp"
#include "room/reflectance.hpp"
#include "run/area_figures.hpp"
#include "run/backward_work.hpp"
#include "run/channel_results.hpp"
#include "run/direct_error.hpp"
#include "run/error_measure.hpp"
#include "run/jackknife.hpp"
#include "run/part_estimates.hpp"
#include "run/pilot.hpp"
#include "run/receiver_plan.hpp"
#include "run/rounds.hpp"
#include "run/surface_results.hpp"
#include "run/tile_light.hpp"
#include "walk/backward.hpp"
#include "walk/cell_light.hpp"
#include "walk/channel_memory.hpp"
#include "walk/learn_reach.hpp"
#include "walk/receiver_points.hpp"
#include "walk/receiver_walk.hpp"
#include "walk/tile_faces.hpp"

namespace lichtmc {

namespace {

[[noreturn]] void refuse_on_emitter(const Room& room, std::size_t receiver, std::size_t emitter) {
  throw InputError("Receiver " + std::to_string(receiver) + ", " + in_quotes(room.receivers[receiver].name) + ", of " +
                   room.source + " lies on the emitter " + in_quotes(room.emitters[emitter].name) +
                   " (allowed: some distance from it), where the " + std::string(irradiance_word(room.quantity)) +
                   " is not defined. Move it away.");
}

double error_at(const OriginEstimates& found, std::size_t k) {
  return std::hypot(found.indirect_error(k), (*found.direct)[k].standard_error);
}

// Enlarged, because it is from few rounds.
double receiver_error(const OriginEstimates& found, std::size_t k) {
  const double factor = student_factor(static_cast<double>(found.rounds) - 1.0);
  return std::hypot(factor * found.indirect_error(k), (*found.direct)[k].standard_error);
}

// Whether a receiver is no point of an area, so that its own error counts.
std::vector<bool> receivers_apart(const Room& room) {
  std::vector<bool> apart(room.receivers.size(), true);
  for (const Area& area : room.areas) {
    for (std::size_t k = 0; k < area.cells.size(); ++k) apart[area.first_receiver + k] = false;
  }
  return apart;
}

// The rms of the receivers with an irradiance above 0, as far as `apart` says so.
RunError error_of_receivers(const Settings& settings, const OriginEstimates& found, const std::vector<bool>& apart) {
  std::vector<double> irradiances;
  for (std::size_t k = 0; k < found.sums->size(); ++k)
    irradiances.push_back((*found.direct)[k].value + found.indirect(k));
  RunError error;
  error.floor = receiver_error_floor(settings, irradiances);
  double squares = 0.0;
  double squares_without_floor = 0.0;
  std::size_t lit = 0;
  for (std::size_t k = 0; k < irradiances.size(); ++k) {
    if (!(irradiances[k] > 0.0) || !apart[k]) continue;
    const double standard_error = receiver_error(found, k);
    squares += std::pow(standard_error / std::max(irradiances[k], error.floor), 2);
    squares_without_floor += std::pow(standard_error / irradiances[k], 2);
    ++lit;
  }
  const auto root_of_mean = [lit](double sum) {
    return lit > 0 ? std::sqrt(sum / static_cast<double>(lit)) : std::numeric_limits<double>::quiet_NaN();
  };
  error.relative = root_of_mean(squares);
  error.without_floor = root_of_mean(squares_without_floor);
  return error;
}

// In runs with areas their figures count too: the error is that of the worst, or of the other receivers.
void add_error_of_areas(const Room& room, const EmitterParts& parts, RunError& error) {
  const auto larger = [](double receivers, double areas) {
    return std::isnan(receivers) || std::isnan(areas) ? areas : std::max(receivers, areas);
  };
  const AreaErrors of_areas = largest_errors(room.areas, parts, error.floor);
  error.relative = larger(error.relative, of_areas.relative);
  error.without_floor = larger(error.without_floor, of_areas.without_floor);
}

// Each tile is the sum of its faces.
std::vector<TileResult> tiles_of(const Tiling& tiling, const TileFaces& faces, const OriginEstimates& found) {
  std::vector<TileResult> tiles(tiling.tiles.size());
  for (TileResult& tile : tiles) tile.direct = 0.0;
  for (std::size_t face = 0; face < faces.size(); ++face) {
    TileResult& tile = tiles[faces[face].tile];
    tile.direct += (*found.direct)[face].value;
    tile.irradiance += (*found.direct)[face].value + found.indirect(face);
    tile.standard_error = std::hypot(tile.standard_error, error_at(found, face));
    tile.hits += found.rounds * found.plan.backward;
  }
  for (std::size_t i = 0; i < tiles.size(); ++i) tiles[i].power = tiles[i].irradiance * tiling.tiles[i].area_m2;
  return tiles;
}

// The estimates of different tiles are independent: their variances add up.
std::vector<SurfaceResult> surfaces_of(const Room& room, const Tiling& tiling, const TileFaces& faces,
                                       const OriginEstimates& found, const std::vector<TileResult>& tiles) {
  std::vector<SurfaceResult> results = surface_results(room, tiling, tiles);
  std::vector<double> behind(results.size(), 0.0);
  for (std::size_t face = 0; face < faces.size(); ++face) {
    if (!faces[face].behind) continue;
    const double irradiance = (*found.direct)[face].value + found.indirect(face);
    behind[tiling.tiles[faces[face].tile].map] += irradiance * faces.area_m2(face);
  }
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    SurfaceResult& surface = results[tiling.tiles[i].map];
    surface.power += tiles[i].power;
    surface.standard_error = std::hypot(surface.standard_error, tiles[i].standard_error * tiling.tiles[i].area_m2);
  }
  for (std::size_t m = 0; m < results.size(); ++m) {
    SurfaceResult& surface = results[m];
    if (!(surface.area_m2 > 0.0)) continue;
    surface.mean_irradiance = surface.power / surface.area_m2;
    surface.standard_error /= surface.area_m2;
    if (surface.power > 0.0) surface.behind_share = behind[m] / surface.power;
    if (!has_varying_reflectance(room.surfaces[tiling.maps[m].surface]))
      surface.absorbed = surface.power * (1.0 - surface.reflectance);
  }
  return results;
}

// Only forward walks determine the balance of the flux.
Balance unknown_balance() {
  Balance balance;
  balance.absorbed = balance.escaped = balance.residual = balance.lost = std::numeric_limits<double>::quiet_NaN();
  return balance;
}

void add_incident(TileMeasurement& measured) {
  double variance = 0.0;
  for (const SurfaceResult& surface : measured.surfaces) {
    measured.incident += surface.power;
    variance += std::pow(surface.standard_error * surface.area_m2, 2);
  }
  measured.incident_standard_error = std::sqrt(variance);
}

std::vector<ReceiverResult> receiver_results(const Room& room, const OriginEstimates& found) {
  const double power = total_power(room);
  std::vector<ReceiverResult> results(room.receivers.size());
  for (std::size_t k = 0; k < results.size(); ++k) {
    ReceiverResult& one = results[k];
    one.direct = (*found.direct)[k].value;
    one.indirect = found.indirect(k);
    one.irradiance = one.direct + one.indirect;
    one.standard_error = receiver_error(found, k);
    one.gain = one.irradiance * room.receivers[k].area_m2 * room.receivers[k].optical_gain() / power;
  }
  return results;
}

}  // namespace

void check_receiver_rounds(const Room& room, const Settings& settings) {
  check_rounds(settings, most_histories_of_round(room.receivers.size()), "the receivers");
}

void check_receivers_whole(const Room& room, const Settings& settings, const BackwardState& walks) {
  check_whole(settings, walks.plan.histories(room.receivers.size()), walks, "the receivers");
}

ReceiverMeasurement measure_receivers(const RunContext& context) {
  const Room& room = context.room;
  const Tracer& tracer = *context.scene.tracer;
  DirectLight light(room, tracer);
  light.learn_selection(context.scene);
  const std::vector<ReferencePoint> points = receiver_points(room, tracer);
  std::optional<ChannelParts> channels;
  if (context.settings.channel.wanted())
    channels.emplace(ChannelParts{{room, context.settings}, ChannelScale(room), {room, tracer}, points});
  const std::size_t block = channels ? receivers_in_block(channels->axes) : ReceiverBlocks::size;
  const ReceiverBlocks blocks(points, tracer, block);
  // Walks from the receivers have no use for it; it is learned for blocks of the usual size.
  const bool has_reach = context.settings.receiver_walk != ReceiverWalk::backward && block == ReceiverBlocks::size;
  const std::optional<LearnedReach> learned = has_reach ? learn_reach(context.scene, points, blocks) : std::nullopt;
  LightOfParts kept(room, context.settings);
  const ReceiverWalkParts parts{
      room,         context.scene, light, blocks, learned ? &learned->reach : nullptr, channels ? &*channels : nullptr,
      kept.groups()};
  const BackwardScale scale(room);
  const Stream stream(context.settings.seed, WalkDirection::backward);
  BackwardTask task;
  task.stage = Progress::Stage::receivers;
  task.origins = room.receivers.size();
  task.unit = scale.unit;
  task.block = block;
  task.channels = channels ? &channels->axes : nullptr;
  task.parts = kept.size();
  const SamplingAccuracy accuracy{direct_error_of_receivers(context.settings)};
  task.choose = [&](BackwardTask& chosen, const std::vector<DirectIrradiance>& direct) {
    ReceiverPlan found =
        choose_receiver_plan(room, context.scene, light, points, direct, learned ? learned->served_share : 1.0,
                             context.settings, [&] { return context.watch.would_stop(); });
    chosen.plan = found.plan;
    chosen.candidates = {found.estimator};
    chosen.reason = std::move(found.reason);
  };
  task.direct = [&](std::size_t k, TraceCount& count) -> DirectIrradiance {
    const Receiver& receiver = room.receivers[k];
    if (receiver.half_angle_deg == 0.0) return {};  // its field of view is empty
    if (const auto emitter = light.emitter_at(reference_point_of(receiver))) refuse_on_emitter(room, k, *emitter);
    return kept.direct(k, [&](std::vector<DirectIrradiance>* of_emitters) {
      if (receiver.is_cell()) return cell_irradiance(light, tracer, points[k], stream, k, accuracy, count, of_emitters);
      return light.irradiance_at(points[k], stream, k, count, accuracy, of_emitters);
    });
  };
  task.make_walk = [&](const Settings& own, const RoundPlan& plan) {
    return make_receiver_walk(parts, scale, own, plan);
  };
  const std::vector<bool> apart = receivers_apart(room);
  const auto parts_from = [&](const OriginEstimates& found) {
    return estimate_parts(room, *kept.groups(), found, kept.all_direct(context.control.communicator));
  };
  task.error = [&](const OriginEstimates& found) {
    RunError error = error_of_receivers(context.settings, found, apart);
    if (!room.areas.empty()) add_error_of_areas(room, parts_from(found), error);
    return error;
  };
  task.name = "the receivers";
  task.slot = &StateData::receivers;
  BackwardOutcome outcome = walk_backward(context, std::move(task));
  outcome.report.receiver_walk = walk_of(outcome.estimates.plan);
  ReceiverMeasurement measured;
  measured.receivers = receiver_results(room, outcome.estimates);
  measured.report = std::move(outcome.report);
  if (kept.groups() != nullptr) {
    EmitterParts of_emitters = parts_from(outcome.estimates);
    const std::vector<double> undimmed(of_emitters.parts.size(), 1.0);
    measured.areas = area_results(room.areas, of_emitters, undimmed);
    if (context.settings.per_emitter) {
      measured.receivers = receivers_by_parts(of_emitters, room.receivers, undimmed);
      measured.parts = std::move(of_emitters);
    }
  }
  if (channels) {
    measured.channels =
        channel_results({context, channels->axes, channels->scale, light, points, *outcome.estimates.channels,
                         outcome.ranges, measured.receivers, *outcome.estimates.direct});
  }
  return measured;
}

TileMeasurement measure_tiles_backward(const RunContext& context, const TileErrorMeasure& measure) {
  const Tiling& tiling = context.tiling;
  const TileLight light(context.room, tiling, context.scene, context.settings, WalkDirection::backward);
  const BackwardScale scale(context.room);
  BackwardTask task;
  task.stage = Progress::Stage::tiles;
  task.origins = light.faces().size();
  task.plan = {0, TileFaces::group};
  task.group = TileFaces::group;
  task.candidates = candidates_for(context.room, context.settings);
  task.unit = scale.unit;
  task.direct = [&](std::size_t face, TraceCount& count) { return light.mean(face, count); };
  task.make_walk = [&](const Settings& own, const RoundPlan& /*plan*/) {
    return make_backward_walk(context.scene, light.direct_light(), light.faces(), scale, own);
  };
  task.error = [&](const OriginEstimates& found) { return measure.of(tiles_of(tiling, light.faces(), found), {}); };
  task.floor = [&](const std::vector<double>& of_faces) {
    std::vector<double> of_tiles(tiling.tiles.size(), 0.0);
    for (std::size_t face = 0; face < of_faces.size(); ++face) of_tiles[light.faces()[face].tile] += of_faces[face];
    return measure.floor(of_tiles);
  };
  for (std::size_t face = 0; face < task.origins; ++face) task.weights.push_back(light.faces().area_m2(face));
  task.name = "the tiles";
  task.slot = &StateData::tile_walks;
  BackwardOutcome outcome = walk_backward(context, std::move(task));

  TileMeasurement measured;
  measured.report = std::move(outcome.report);
  measured.balance = unknown_balance();
  measured.tiles = tiles_of(tiling, light.faces(), outcome.estimates);
  measured.surfaces = surfaces_of(context.room, tiling, light.faces(), outcome.estimates, measured.tiles);
  add_incident(measured);
  return measured;
}

}  // namespace lichtmc
