#include "run/warnings.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>

#include <glm/common.hpp>

#include "base/message.hpp"
#include "room/bounds.hpp"
#include "room/emitter_place.hpp"
#include "room/emitter_shape.hpp"
#include "room/reflectance.hpp"
#include "run/channel_warnings.hpp"
#include "run/cover_warnings.hpp"
#include "run/outside.hpp"

namespace lichtmc {

namespace {

// Whether the emitter also emits in directions opposite to its axis.
bool emits_backwards(const Emitter& emitter) {
  constexpr double hemisphere = 0.5 * std::numbers::pi * (1.0 + 1e-6);  // π/2 as a float may be rounded up
  return std::visit([](const auto& law) { return law.extent().half_angle; }, law_of(emitter)) > hemisphere;
}

std::string place_text(const glm::dvec3& p) {
  return "(" + position_text(p.x) + ", " + position_text(p.y) + ", " + position_text(p.z) + ") m";
}

// Whether a surface, or a point of one, has the reflectance 1.
bool reflects_all(const Room& room) {
  const HighestReflectance highest(room);
  return std::any_of(room.surfaces.begin(), room.surfaces.end(),
                     [&highest](const Surface& surface) { return highest.of(surface) == 1.0; });
}

// Receivers whose standard error is far above that of most: rare large scores, from surfaces close to a receiver or to
// an emitter. Their errors are known only when such scores have come.
std::optional<Advised> uncertain_errors(const Result& result) {
  constexpr double far_above = 5.0;
  constexpr double noticeable = 0.01;
  constexpr std::size_t few = 8;  // receivers, of which none is like most
  std::vector<double> relative;
  std::vector<double> sorted;
  for (const ReceiverResult& one : result.receiver_results) {
    relative.push_back(one.irradiance > 0.0 ? one.standard_error / one.irradiance : 0.0);
    if (one.irradiance > 0.0) sorted.push_back(relative.back());
  }
  if (sorted.size() < few) return std::nullopt;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
  const double limit = std::max(noticeable, far_above * sorted[sorted.size() / 2]);
  const auto worst = std::max_element(relative.begin(), relative.end());
  const auto count = static_cast<std::size_t>(
      std::count_if(relative.begin(), relative.end(), [limit](double error) { return error > limit; }));
  if (count == 0) return std::nullopt;
  const std::string name = in_quotes(result.receivers[static_cast<std::size_t>(worst - relative.begin())].name);
  return Advised{to_text(count, "receiver") + " (of the largest error: " + name + ", " + percent(*worst) + ") " +
                     (count == 1 ? "has" : "have") +
                     " more than five times the standard error of most: rare large contributions from surfaces within "
                     "centimetres of the receiver, or of an emitter.",
                 "Such errors become reliable only in longer runs; with --receiver-walk two-way they are smallest."};
}

// Files contain floats: an emitter at the ceiling may be above it by rounding. Coordinates count with at most the
// extent of the room, as for the tracers (tracer/touch.hpp): a translation far from the origin counts as exact.
double rounding_of(const Bounds& bounds) {
  const glm::dvec3 farthest = glm::max(glm::abs(bounds.low), glm::abs(bounds.high));
  const glm::dvec3 size = bounds.high - bounds.low;
  return 4.0 * 0x1p-24 * std::min(std::max({farthest.x, farthest.y, farthest.z}), std::max({size.x, size.y, size.z}));
}

// "outside the room, which extends from x, y, z = 0 to 5, 0 to 3, 0 to 4 m"
std::string outside_text(const Bounds& bounds) {
  std::string range;
  for (int c = 0; c < 3; ++c)
    range += (c > 0 ? ", " : "") + position_text(bounds.low[c]) + " to " + position_text(bounds.high[c]);
  return "outside the room, which extends from x, y, z = " + range + " m";
}

}  // namespace

std::vector<Advised> emitters_outside(const Room& room, const Enclosure* enclosure) {
  std::vector<Advised> outside;
  const Bounds bounds = bounds_of(room);
  const double slack = rounding_of(bounds);
  const std::vector<bool> beyond_walls = emitters_beyond_walls(room, enclosure);
  for (std::size_t k = 0; k < room.emitters.size(); ++k) {
    const Emitter& emitter = room.emitters[k];
    const glm::dvec3 p = place_of(room, emitter);
    const std::string which = "Emitter " + in_quotes(emitter.name) + " at " + place_text(p) + " ";
    const bool is_area = emitting_surface(emitter).has_value();
    if (!is_area && !bounds.holds(p, slack)) {
      outside.push_back({which + "lies " + outside_text(bounds) + ".", "Check its position; Y is up."});
    } else if (beyond_walls[k]) {
      outside.push_back(
          {which + (is_area ? "emits" : "lies") + " outside the walls of the closed room: its light does not get in.",
           is_area ? "Reverse its faces: a surface emits from its front." : "Check its position; Y is up."});
    } else if (!is_area && emits_backwards(emitter) && !bounds.holds(p, -slack)) {
      outside.push_back(
          {which + "lies on the boundary of the room: the light that it emits outwards escapes without an impact.",
           "Move it some centimetres inwards."});
    }
  }
  constexpr std::size_t most = 3;
  if (outside.size() <= most) return outside;
  return {{to_text(outside.size(), "emitter") + " of " + std::to_string(room.emitters.size()) +
               " lie outside the room or on its boundary. The first: " + outside.front().what,
           "Check their positions; Y is up."}};
}

std::vector<Advised> receivers_outside(const Room& room, const Enclosure* enclosure,
                                       const std::vector<ReceiverResult>* results) {
  std::vector<Advised> misplaced;
  if (room.receivers.empty()) return misplaced;
  const std::vector<Separation> separation = separation_of_receivers(room, enclosure);
  const Bounds bounds = bounds_of(room);
  const double slack = rounding_of(bounds);
  const auto report = [&](const auto& is_misplaced, const std::string& where, const char* one, const char* many) {
    std::size_t first = 0;
    std::size_t count = 0;
    for (std::size_t k = 0; k < room.receivers.size(); ++k) {
      if (is_misplaced(k) && count++ == 0) first = k;
    }
    if (count == 0) return;
    const Receiver& receiver = room.receivers[first];
    const std::string which = in_quotes(receiver.name) + " at " + place_text(receiver.position);
    misplaced.push_back({count == 1 ? "Receiver " + which + " lies " + where + one + "."
                                    : to_text(count, "receiver") + " of " + std::to_string(room.receivers.size()) +
                                          " lie " + where + many + ". The first: " + which + ".",
                         "Check the positions: they are in metres on the axes of glTF, Y is up."});
  };
  const auto separated = [&](Separation kind, const std::string& where) {
    report([&](std::size_t k) { return separation[k] == kind; }, where, ": no light reaches it",
           ": no light reaches them");
  };
  separated(Separation::outside, "outside the closed walls around the emitters");
  separated(Separation::inside, "inside closed walls or bodies without an emitter");
  report(
      [&](std::size_t k) {
        return separation[k] == Separation::none && !bounds.holds(room.receivers[k].position, slack) &&
               (results == nullptr || (*results)[k].irradiance == 0.0);
      },
      outside_text(bounds), "", "");
  return misplaced;
}

std::optional<Advised> high_reflectances(const Room& room) {
  constexpr double doubtful = 0.95;  // reflectance of fresh snow; white paint has 0.85
  const HighestReflectance highest(room);
  std::map<std::string, double> high;
  for (const Surface& surface : room.surfaces) {
    const double reflectance = highest.of(surface);
    if (!(reflectance > doubtful)) continue;
    double& most = high[surface.material];
    most = std::max(most, reflectance);
  }
  if (high.empty()) return std::nullopt;
  Names names;
  for (const auto& [material, reflectance] : high)
    names.add(in_quotes(material) + " (" + short_number(reflectance) + ")");
  return Advised{
      to_text(high.size(), "material") + (high.size() == 1 ? " reflects" : " reflect") +
          " more than 95 % of the light, everywhere or in some places; hardly any real surface does (white, 1, is "
          "glTF's default): " +
          names.text() + ".",
      "Set the custom property 'reflectance', or give --reflectance NAME=R or --max-reflectance 0.9. The " +
          std::string(irradiance_word(room.quantity)) +
          " is proportional to 1/(1 − ρ) if all surfaces have the reflectance ρ: from 0.9 to 0.99 it increases "
          "tenfold."};
}

namespace {

// Targets are for maintained values: a comparison of initial ones is too favourable.
std::optional<std::string> targets_without_maintenance(const Room& room, const Result& result) {
  const bool has_target = std::any_of(result.areas.begin(), result.areas.end(),
                                      [](const AreaResult& one) { return one.area.properties.target_lx.has_value(); });
  const bool maintained = std::any_of(room.emitters.begin(), room.emitters.end(), [](const Emitter& emitter) {
    return emitter.maintenance_factor != 1.0 || emitter.own_maintenance;
  });
  if (!has_target || maintained) return std::nullopt;
  return "The target of a calculation area is a maintained illuminance, but no maintenance factor is given: the "
         "figures "
         "are those of new luminaires. Give --maintenance-factor, for example 0.8.";
}

}  // namespace

std::vector<std::string> warnings_of(const Room& room, const Result& result, const Enclosure* enclosure) {
  std::vector<std::string> warnings;
  const Balance& balance = result.balance;
  for (const Advised& outside : emitters_outside(room, enclosure))
    warnings.push_back(outside.what + " " + outside.advice);
  if (!result.receiver_results.empty()) {
    for (const Advised& outside : receivers_outside(room, enclosure, &result.receiver_results))
      warnings.push_back(outside.what + " " + outside.advice);
  }
  if (result.settings.measured == Measured::tiles && !room.areas.empty()) {
    Names names;
    for (const Area& area : room.areas) names.add(in_quotes(area.properties.name));
    warnings.push_back(to_text(room.areas.size(), "calculation area") + " (" + names.text() + ") " +
                       (room.areas.size() == 1 ? "is" : "are") +
                       " not measured: only tiles were requested. Leave out --only tiles to measure their points.");
  }
  if (result.settings.measured != Measured::receivers && result.walk.impacts == 0) {
    warnings.push_back(
        "No photon hit a surface. Check the positions and directions of the emitters; a surface emits light from its "
        "front only.");
  }
  const bool roulette = result.walk.estimator == Estimator::weight && !result.settings.max_bounces;
  constexpr double noticeable = 0.001;
  if (!roulette && balance.residual > noticeable * balance.emitted) {
    warnings.push_back(percent(balance.residual / balance.emitted) +
                       " of the emitted power was cut off as residual: every figure is too low by about as much. "
                       "Allow more bounces or time, or lower "
                       "the highest reflectances (--max-reflectance 0.9).");
  }
  if (result.lost_histories > 0) {
    warnings.push_back(to_text(result.lost_histories, "photon") + " of " + std::to_string(result.walk.histories) +
                       " left a closed room by a numerical error: their power is reported as lost.");
  }
  if (auto initial = targets_without_maintenance(room, result)) warnings.push_back(std::move(*initial));
  for (std::string& one : channel_warnings(result)) warnings.push_back(std::move(one));
  if (const auto uncertain = uncertain_errors(result)) warnings.push_back(uncertain->what + " " + uncertain->advice);
  for (const CoverWarning& covered : covered_emitters(room, result.covers))
    warnings.push_back(covered.what + " " + covered.advice);
  for (const CoverWarning& tie :
       undecided_covers(room, result.covers, result.walk.undecided + result.receiver_walk.undecided,
                        result.walk.impacts + result.receiver_walk.impacts))
    warnings.push_back(tie.what + " " + tie.advice);
  if (reflects_all(room)) {
    if (const auto high = high_reflectances(room)) warnings.push_back(high->what + " " + high->advice);
  }
  return warnings;
}

}  // namespace lichtmc
