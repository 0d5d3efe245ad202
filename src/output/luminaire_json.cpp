// The figures of a luminaire as JSON.
#include <string>

#include "lichtmc/luminaire_figures.hpp"
#include "lichtmc/output.hpp"
#include "lichtmc/version.hpp"
#include "output/json.hpp"

namespace lichtmc {

namespace {

Json optional_number(const std::optional<double>& value) {
  return value ? number(*value) : Json(nullptr);
}

Json angles_of(const AngleRange& range) {
  return {{"count", range.count},
          {"from", number(range.from)},
          {"to", number(range.to)},
          {"least_step", number(range.least_step)},
          {"greatest_step", number(range.greatest_step)}};
}

Json lamp_sets_of(const Photometry& photometry) {
  Json sets = Json::array();
  for (const LampSet& set : photometry.lamp_sets) {
    sets.push_back({{"lamps", set.lamps},
                    {"flux", number(set.flux_lm)},
                    {"type", set.type},
                    {"colour", set.colour},
                    {"rendering_index", set.rendering_index},
                    {"watts", number(set.watts)}});
  }
  return sets;
}

Json width_of(const BeamWidth& width) {
  return {{"width", number(width.width_deg())},
          {"from", number(width.from_deg)},
          {"to", number(width.to_deg)},
          {"lobes", width.lobes}};
}

Json planes_of(const LuminaireFigures& figures) {
  Json planes = Json::array();
  for (const LuminairePlane& plane : figures.planes) {
    const IntensityPoint highest = highest_of(plane.cut);
    planes.push_back({{"name", plane.name},
                      {"maximum", number(highest.candela)},
                      {"maximum_at", number(highest.angle_deg)},
                      {"beam_angle", width_of(plane.beam)},
                      {"field_angle", width_of(plane.field)}});
  }
  return planes;
}

Json zones_of(const LuminaireFigures& figures) {
  Json zones = Json::array();
  for (const FluxZone& zone : figures.zones)
    zones.push_back({{"from", zone.from_deg}, {"to", zone.to_deg}, {"flux", number(zone.flux)}});
  return zones;
}

// The factors that the format has; the others are null.
void add_factors(const Photometry& photometry, Json& json) {
  const bool ies = photometry.format == PhotometryFormat::ies;
  const bool early = photometry.version == "LM-63-1986" || photometry.version == "LM-63-1991";
  json["factor"] = number(photometry.factor);
  json["candela_multiplier"] = ies ? number(photometry.multiplier) : Json(nullptr);
  json["ballast_factor"] = ies ? number(photometry.ballast) : Json(nullptr);
  json["ballast_lamp_factor"] = early ? number(photometry.ballast_lamp) : Json(nullptr);
  json["conversion_factor"] = ies ? Json(nullptr) : number(photometry.conversion);
  json["tilt_factors"] = photometry.tilt_factors
                             ? Json{number(photometry.tilt_factors->first), number(photometry.tilt_factors->second)}
                             : Json(nullptr);
}

void add_flux(const Photometry& photometry, const LuminaireFigures& figures, Json& json) {
  json["absolute"] = photometry.absolute;
  json["lamp_set"] = photometry.lamp_set + 1;
  json["lamp_sets"] = lamp_sets_of(photometry);
  json["flux"] = number(figures.flux);
  json["flux_unit"] = figures.flux_unit;
  json["stated_flux"] = optional_number(photometry.stated_lm);
  json["over_stated"] = optional_number(figures.over_stated);
  json["lamp_flux"] = optional_number(photometry.lamp_lm);
  json["output_ratio"] = optional_number(figures.output_ratio);
  json["stated_output_ratio"] = optional_number(photometry.output_ratio);
  json["share_towards_aim"] = number(figures.share_towards_aim);
  json["share_away"] = number(1.0 - figures.share_towards_aim);
  json["stated_downward_share"] = optional_number(photometry.downward_share);
  json["zones"] = zones_of(figures);
  json["watts"] = photometry.watts > 0.0 ? number(photometry.watts) : Json(nullptr);
  json["efficacy"] = optional_number(photometry.efficacy());
}

Json opening_of(const LuminousOpening& opening) {
  return {{"form", std::string(name_of(opening.form))},
          {"size", {number(opening.size_m.x), number(opening.size_m.y), number(opening.size_m.z)}},
          {"text", opening_text(opening)}};
}

}  // namespace

std::string luminaire_json(const Photometry& photometry) {
  const LuminaireFigures figures = luminaire_figures(photometry);
  const CandelaTable& table = *photometry.candela;
  const PeakIntensity& peak = table.peak();
  Json json{{"version", std::string(version())},
            {"file", photometry.source},
            {"format", photometry.version},
            {"manufacturer", photometry.manufacturer},
            {"luminaire", photometry.luminaire},
            {"catalogue", photometry.catalogue},
            {"test", photometry.test},
            {"photometric_type", std::string(name_of(table.grid().type))},
            {"symmetry", std::string(name_of(table.grid().symmetry))},
            {"flipped_horizontal", table.grid().flip_horizontal},
            {"horizontal_angles", angles_of(figures.horizontal)},
            {"vertical_angles", angles_of(figures.vertical)}};
  add_factors(photometry, json);
  add_flux(photometry, figures, json);
  json["intensity_unit"] = photometry.intensity_unit;
  json["maximum"] = {{"intensity", number(peak.candela)},
                     {"horizontal", number(peak.horizontal_deg)},
                     {"vertical", number(peak.vertical_deg)}};
  json["planes"] = planes_of(figures);
  json["opening"] = opening_of(photometry.opening);
  json["texts"] = Json::array();
  for (const auto& [name, text] : photometry.texts) json["texts"].push_back({{"name", name}, {"text", text}});
  json["notes"] = photometry.notes;
  json["warnings"] = photometry.warnings;
  return json_text(json);
}

}  // namespace lichtmc
