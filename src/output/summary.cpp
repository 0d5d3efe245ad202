#include <cmath>
#include <concepts>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "lichtmc/output.hpp"
#include "lichtmc/overrides.hpp"
#include "lichtmc/version.hpp"
#include "output/area_json.hpp"
#include "output/channel_json.hpp"
#include "output/json.hpp"
#include "output/luminaire_schedule.hpp"
#include "output/summary.hpp"
#include "output/tile_image.hpp"
#include "room/settings_fields.hpp"

namespace lichtmc {

namespace {

Json surfaces_of(const Result& result, const ResultFiles& written) {
  Json surfaces = Json::array();
  const std::vector<std::string> files = tile_image_names(result.tiling);
  for (std::size_t m = 0; m < result.surfaces.size(); ++m) {
    const SurfaceResult& s = result.surfaces[m];
    const TileMap& map = result.tiling.maps[m];
    Json entry{{"name", s.name},
               {"material", s.material},
               {"reflectance", number(s.reflectance)},
               {"area", number(s.area_m2)},
               {"unreached_area", number(s.unreached_area_m2)},
               {"covered_area", number(s.covered_m2)},
               {"tiles", s.tiles},
               {"columns", map.columns},
               {"rows", map.rows},
               {"mean_irradiance", number(s.mean_irradiance)},
               {"min_irradiance", number(s.min_irradiance)},
               {"max_irradiance", number(s.max_irradiance)},
               {"standard_error", number(s.standard_error)},
               {"direct", number(s.mean_direct)},
               {"power", number(s.power)},
               {"absorbed", number(s.absorbed)},
               {"behind_share", number(s.behind_share)},
               {"hits", s.hits},
               {"file", written.tile_images ? Json("tiles/" + files[m]) : Json(nullptr)}};
    if (map.chart == ChartSource::engine) entry["chart"] = "made by lichtmc: " + map.chart_reason;
    surfaces.push_back(entry);
  }
  return surfaces;
}

Json receiver_of(const Receiver& r, const ReceiverResult& one) {
  Json receiver{{"name", r.name},
                {"position", {number(r.position.x), number(r.position.y), number(r.position.z)}},
                {"normal", {number(r.normal.x), number(r.normal.y), number(r.normal.z)}},
                {"fov", number(r.half_angle_deg)},
                {"area", number(r.area_m2)},
                {"concentrator_index", r.concentrator_index ? number(*r.concentrator_index) : Json(nullptr)},
                {"filter_gain", number(r.filter_gain)},
                {"irradiance", number(one.irradiance)},
                {"direct", number(one.direct)},
                {"indirect", number(one.indirect)},
                {"standard_error", number(one.standard_error)},
                {"gain", number(one.gain)},
                {"gain_db", one.gain > 0.0 ? number(10.0 * std::log10(one.gain)) : Json(nullptr)}};
  add_law(r, receiver);
  return receiver;
}

// The elements of an array, each on a line.
void write_elements(std::size_t count, const std::function<Json(std::size_t)>& element, const Sink& sink) {
  for (std::size_t k = 0; k < count; ++k) {
    sink(k > 0 ? ",\n    " : "\n    ");
    sink(element(k).dump(-1, ' ', false, Json::error_handler_t::replace));
  }
  if (count > 0) sink("\n  ");
}

// Facts of the walk for the receivers; null without receivers.
Json receiver_walk_of(const Result& result) {
  if (result.receiver_results.empty()) return nullptr;
  const WalkReport& b = result.receiver_walk;
  Json json{{"walk", std::string(to_string(b.receiver_walk))},
            {"estimator", std::string(to_string(b.estimator))},
            {"rounds", b.rounds},
            {"photons_per_round", b.photons_per_round},
            {"walks_per_round", b.walks_per_round},
            {"histories", b.histories},
            {"rays", b.rays},
            {"connections", b.connections},
            {"shadow_rays", b.shadow_rays},
            {"seconds", number(b.seconds)},
            {"rms_relative_error", number(b.rms_relative_error)},
            {"rms_relative_error_without_floor", number(b.rms_relative_error_without_floor)},
            {"error_floor", number(b.error_floor)},
            {"figure_of_merit", number(b.figure_of_merit)},
            {"stopped_by", std::string(to_string(b.stopped_by))}};
  if (const std::string repeat = options_to_repeat(result, Measured::receivers); !repeat.empty())
    json["repeat"] = repeat;
  return json;
}

Json texts_of(const std::vector<Ignored>& ignored) {
  Json texts = Json::array();
  for (const Ignored& thing : ignored) texts.push_back(thing.what);
  return texts;
}

// The luminaire schedule; emitters: their numbers.
Json luminaires_of(const Room& room) {
  Json luminaires = Json::array();
  for (const ScheduleRow& row : luminaire_schedule(room)) {
    const Photometry& photometry = *row.photometry;
    const std::optional<double> scale = row.scale(room.quantity);
    const std::optional<double> efficacy = photometry.efficacy();
    const bool watts = photometry.watts > 0.0;
    luminaires.push_back({{"file", photometry.source},
                          {"format", photometry.version},
                          {"manufacturer", photometry.manufacturer},
                          {"luminaire", photometry.luminaire},
                          {"catalogue", photometry.catalogue},
                          {"lamp_set", photometry.lamp_set + 1},
                          {"count", row.emitters.size()},
                          {"power", number(row.power)},
                          {"maintenance_factor", number(row.maintenance_factor)},
                          {"initial_power", number(row.initial_power())},
                          {"scale", scale ? number(*scale) : Json(nullptr)},
                          {"total_power", number(row.count() * row.power)},
                          {"watts", watts ? number(photometry.watts) : Json(nullptr)},
                          {"total_watts", watts ? number(row.count() * photometry.watts) : Json(nullptr)},
                          {"efficacy", efficacy ? number(*efficacy) : Json(nullptr)},
                          {"light_from", row.area ? "opening" : "point"},
                          {"emitters", row.emitters}});
  }
  return luminaires;
}

// The unit of every figure in the summary and the tables.
Json units_of(const Result& result) {
  const std::string power(power_unit(result.quantity));
  const std::string irradiance(irradiance_unit(result.quantity));
  return {{"power", power},
          {"emitted", power},
          {"absorbed", power},
          {"escaped", power},
          {"residual", power},
          {"lost", power},
          {"incident", power},
          {"incident_standard_error", power},
          {"irradiance", irradiance},
          {"standard_error", irradiance},
          {"mean_irradiance", irradiance},
          {"min_irradiance", irradiance},
          {"max_irradiance", irradiance},
          {"direct", irradiance},
          {"indirect", irradiance},
          {"gain", "1"},
          {"gain_db", "dB"},
          {"concentrator_index", "1"},
          {"filter_gain", "1"},
          {"fov", "degrees"},
          {"area", "m^2"},
          {"unreached_area", "m^2"},
          {"covered_area", "m^2"},
          {"x", "m"},
          {"y", "m"},
          {"z", "m"},
          {"tile_edge_m", "m"},
          {"seconds", "s"},
          {"checkpoint_seconds", "s"},
          {"impacts_per_second", "1/s"},
          {"figure_of_merit", "1/s"},
          {"rms_relative_error", "1"},
          {"rms_relative_error_without_floor", "1"},
          {"error_floor", irradiance},
          {"reflectance", "1"},
          {"behind_share", "1"},
          {"total_power", power},
          {"watts", "W"},
          {"total_watts", "W"},
          {"efficacy", "lm/W"},
          {"scale", "1"}};
}

// What was simulated, and how long it took.
void add_run(const Result& result, Json& summary) {
  summary["version"] = std::string(version());
  summary["room"] = result.room;
  summary["unit"] = std::string(power_unit(result.quantity));
  summary["engine"] = std::string(to_string(result.engine));
  summary["estimator"] =
      std::string(to_string(result.tiles.empty() ? result.receiver_walk.estimator : result.walk.estimator));
  summary["seed"] = result.settings.seed;
  summary["threads"] = result.threads;
  summary["histories"] = result.walk.histories;
  summary["impacts"] = result.walk.impacts;
  summary["rays"] = result.walk.rays + result.receiver_walk.rays;
  summary["seconds"] = number(result.walk.seconds);
  summary["impacts_per_second"] = number(static_cast<double>(result.walk.impacts) / result.walk.seconds);
}

void add_balance(const Result& result, Json& summary) {
  const Balance& balance = result.balance;
  summary["emitted"] = number(balance.emitted);
  summary["absorbed"] = number(balance.absorbed);
  summary["escaped"] = number(balance.escaped);
  summary["residual"] = number(balance.residual);
  summary["lost"] = number(balance.lost);
  summary["incident"] = number(result.incident);
  summary["incident_standard_error"] = number(result.incident_standard_error);
}

// `receivers` stays empty here: see write_summary().
void add_results(const Result& result, const ResultFiles& files, Json& summary) {
  summary["rms_relative_error"] = number(result.walk.rms_relative_error);
  summary["figure_of_merit"] = number(result.walk.figure_of_merit);
  summary["stopped_by"] = std::string(to_string(result.walk.stopped_by));
  summary["surfaces"] = surfaces_of(result, files);
  summary["receivers"] = Json::array();
  summary["ignored"] = texts_of(result.ignored);
}

Json json_of(bool value) {
  return value;
}
Json json_of(double value) {
  return number(value);
}
template <std::unsigned_integral Number>
requires(!std::same_as<Number, bool>) Json json_of(Number value) {
  return value;
}
template <class Choice>
requires std::is_enum_v<Choice> Json json_of(Choice value) {
  return std::string(to_string(value));
}
template <class Value>
Json json_of(const std::optional<Value>& value) {
  return value ? json_of(*value) : Json(nullptr);
}

// Every setting as asked for, by the names of its fields.
Json settings_of(const Settings& settings) {
  Json json;
  visit_fields(
      [&json](const Field& field, const auto& value) {
        if (field.role != FieldRole::machine) json[field.name] = json_of(value);
      },
      settings);
  return json;
}

// Details added to the format later, after the keys above.
void add_details(const Room& room, const Result& result, const ResultFiles& files, Json& summary) {
  summary["processes"] = result.processes;
  summary["checkpoint_seconds"] = number(result.checkpoint_seconds);
  summary["tiles_by"] = std::string(to_string(result.settings.tile_walk));
  summary["direct"] = std::string(to_string(direct_is_apart(result) ? Direct::analytic : Direct::sampled));
  summary["shadow_rays"] = result.walk.shadow_rays + result.receiver_walk.shadow_rays;
  summary["rms_relative_error_without_floor"] = number(result.walk.rms_relative_error_without_floor);
  summary["error_floor"] = number(result.walk.error_floor);
  if (const std::string repeat = options_to_repeat(result, Measured::tiles); !repeat.empty())
    summary["repeat"] = repeat;
  summary["choices"] = result.choices;
  summary["receiver_walk"] = receiver_walk_of(result);
  summary["backward"] = receiver_walk_of(result);  // the name in earlier versions
  summary["warnings"] = result.warnings;
  for (const std::string& note : files_left_out(result)) summary["warnings"].push_back(note);
  summary["mended"] = result.overrides;
  summary["emitters"] = emitters_of(room);
  const std::optional<double> maintenance = common_maintenance_factor(room);
  summary["maintenance_factor"] = maintenance ? number(*maintenance) : Json(nullptr);
  summary["luminaires"] = luminaires_of(room);
  summary["tile_edge_m"] = result.settings.tile_edge_m;
  summary["tiles_count"] = result.tiles.size();
  summary["tiles_without_hits"] = result.tiles_without_hits;
  summary["unreached_tiles"] = result.unreached_tiles;
  summary["max_bounces"] = result.settings.max_bounces ? Json(*result.settings.max_bounces) : Json(nullptr);
  summary["retraced"] = result.walk.retraced;
  summary["lost_histories"] = result.lost_histories;
  summary["units"] = units_of(result);
  if (result.channels) {
    // The names of times and frequencies end in their units.
    for (const char* name : {"line_of_sight", "diffuse", "rician_k", "beyond_time_span"}) summary["units"][name] = "1";
  }
  summary["areas"] = areas_of(result);
  if (!result.areas.empty()) {
    for (const char* name : {"em", "em_se", "emin", "emin_se", "emax", "emax_se", "em_initial", "em_initial_se",
                             "emin_initial", "emin_initial_se", "emax_initial", "emax_initial_se", "lowest", "highest"})
      summary["units"][name] = std::string(irradiance_unit(result.quantity));
    for (const char* name : {"u0", "u0_se", "ud", "ud_se", "target_uniformity"}) summary["units"][name] = "1";
    for (const char* name : {"spacing", "margin", "above_floor"}) summary["units"][name] = "m";
  }
  summary["settings"] = settings_of(result.settings);
  if (!files.tile_images) summary["tile_images"] = false;
  if (result.channels) {
    summary["impulse_responses"] = impulse_responses_of(result);
    summary["channels"] = Json::array();  // stays empty here, as `receivers`
  }
}

}  // namespace

void write_summary(const Room& room, const Result& result, const ResultFiles& files, const Sink& sink) {
  Json summary;
  add_run(result, summary);
  add_balance(result, summary);
  add_results(result, files, summary);
  add_details(room, result, files, summary);
  // There may be very many receivers and channels: they are written one by one in place of the empty arrays.
  const std::string text = json_text(summary);
  std::string_view rest = text;
  const auto write_array = [&](const std::string& key, std::size_t count,
                               const std::function<Json(std::size_t)>& element) {
    const std::string place = "\n  \"" + key + "\": [";
    const std::size_t cut = rest.find(place) + place.size();
    sink(rest.substr(0, cut));
    write_elements(count, element, sink);
    rest.remove_prefix(cut);
  };
  write_array("receivers", result.receiver_results.size(),
              [&](std::size_t k) { return receiver_of(result.receivers[k], result.receiver_results[k]); });
  if (result.channels)
    write_array("channels", result.channels->channels.size(), [&](std::size_t k) { return channel_of(result, k); });
  sink(rest);
}

std::string summary_json(const Room& room, const Result& result, const ResultFiles& files) {
  std::string text;
  write_summary(room, result, files, [&text](std::string_view piece) { text += piece; });
  return text;
}

}  // namespace lichtmc
