#include <string>

#include "lichtmc/inspect.hpp"
#include "lichtmc/version.hpp"
#include "output/json.hpp"

namespace lichtmc {

namespace {

const char* word_for(Severity severity) {
  switch (severity) {
    case Severity::note:
      return "note";
    case Severity::warning:
      return "warning";
    case Severity::fault:
      return "fault";
  }
  return "";
}

Json surfaces_of(const Inspection& inspection) {
  Json surfaces = Json::array();
  for (const SurfaceFacts& s : inspection.surfaces) {
    Json entry{{"name", s.name},
               {"material", s.material},
               {"reflectance", number(s.reflectance)},
               {"highest_reflectance", number(s.highest_reflectance)},
               {"reflectance_source", reflectance_source_word(s.reflectance_source)},
               {"area", number(s.area_m2)},
               {"two_sided", s.sides == Sides::both},
               {"triangles", s.triangles},
               {"triangles_without_area", s.triangles_without_area},
               {"tiles", s.tiles},
               {"cells_over_area", number(s.cells_over_area)},
               {"seen_from_behind", number(s.seen_from_behind)}};
    if (s.chart == ChartSource::engine) entry["chart"] = "made by lichtmc: " + s.chart_reason;
    surfaces.push_back(entry);
  }
  return surfaces;
}

Json openings_of(const Inspection& inspection) {
  Json openings = Json::array();
  for (const Opening& opening : inspection.openings) {
    openings.push_back({{"side", opening.side},
                        {"share", number(opening.share)},
                        {"place", vector_of(opening.place)},
                        {"from", opening.from}});
  }
  return openings;
}

Json receivers_of(const Room& room) {
  Json receivers = Json::array();
  for (const Receiver& r : room.receivers) {
    receivers.push_back({{"name", r.name},
                         {"position", vector_of(r.position)},
                         {"normal", vector_of(r.normal)},
                         {"fov", number(r.half_angle_deg)},
                         {"area", number(r.area_m2)},
                         {"concentrator_index", r.concentrator_index ? number(*r.concentrator_index) : Json(nullptr)},
                         {"filter_gain", number(r.filter_gain)}});
    add_law(r, receivers.back());
  }
  return receivers;
}

Json areas_of(const Room& room) {
  Json areas = Json::array();
  for (const Area& area : room.areas) {
    Json left_out = Json::array();
    for (const AreaLeftOut& one : area.left_out) left_out.push_back({{"why", one.why}, {"points", one.points}});
    areas.push_back({{"name", area.properties.name},
                     {"role", area.properties.role},
                     {"quantity", std::string(to_string(area.quantity))},
                     {"points", area.cells.size()},
                     {"columns", area.columns},
                     {"rows", area.rows},
                     {"above_floor", area.above_floor_m ? number(*area.above_floor_m) : Json(nullptr)},
                     {"corner", vector_of(area.corner)},
                     {"u", vector_of(area.u)},
                     {"v", vector_of(area.v)},
                     {"left_out", left_out}});
  }
  return areas;
}

Json findings_of(const Inspection& inspection) {
  Json findings = Json::array();
  for (const Finding& finding : inspection.findings) {
    findings.push_back({{"severity", word_for(finding.severity)},
                        {"topic", finding.topic},
                        {"text", finding.text},
                        {"advice", finding.advice}});
  }
  return findings;
}

Json luminaires_of(const Inspection& inspection) {
  Json luminaires = Json::array();
  for (const LuminaireFacts& f : inspection.luminaires) {
    Json entry{{"file", f.file},
               {"version", f.version},
               {"count", f.count},
               {"power", number(f.power)},
               {"watts", f.watts > 0.0 ? number(f.watts) : Json(nullptr)},
               {"opening", std::string(name_of(f.opening.form))},
               {"opening_size", vector_of(f.opening.size_m)},
               {"in_housing", number(f.in_housing)},
               {"as_points", f.as_points},
               {"limit", number(f.limit_m)},
               {"near", number(f.near)},
               {"elsewhere", number(f.elsewhere)}};
    if (!f.nearest_receiver.empty()) {
      entry["nearest_receiver"] = f.nearest_receiver;
      entry["nearest"] = number(f.nearest_m);
      entry["excess_there"] = number(f.excess_there);
    }
    luminaires.push_back(entry);
  }
  return luminaires;
}

Json points_of(const std::vector<glm::dvec3>& list) {
  Json points = Json::array();
  for (const glm::dvec3& p : list) points.push_back(vector_of(p));
  return points;
}

}  // namespace

// One table of keys and values, in the order of the file.
std::string inspection_json(const Room& room, const Inspection& inspection) {
  const Json json{{"version", std::string(version())},
                  {"room", room.source},
                  {"unit", std::string(power_unit(room.quantity))},
                  {"usable", inspection.count(Severity::fault) == 0},
                  {"faults", inspection.count(Severity::fault)},
                  {"warnings", inspection.count(Severity::warning)},
                  {"low", vector_of(inspection.low)},
                  {"high", vector_of(inspection.high)},
                  {"suggested_scale", number(inspection.suggested_scale)},
                  {"suggested_up", inspection.probably_z_up ? "z" : "y"},
                  {"triangles", inspection.triangles},
                  {"triangles_without_area", inspection.triangles_without_area},
                  {"duplicate_triangles", inspection.duplicate_triangles},
                  {"open_edges", inspection.open_edges},
                  {"open_edge_places", points_of(inspection.open_edge_places)},
                  {"cuboid", inspection.cuboid},
                  {"convex", inspection.convex},
                  {"closed", inspection.closed},
                  {"inside", vector_of(inspection.inside)},
                  {"flights", inspection.flights},
                  {"flights_that_left", inspection.flights_that_left},
                  {"openings", openings_of(inspection)},
                  {"tiles", inspection.tiles},
                  {"memory_bytes", number(inspection.memory_bytes)},
                  {"surfaces", surfaces_of(inspection)},
                  {"emitters", emitters_of(room)},
                  {"luminaires", luminaires_of(inspection)},
                  {"receivers", receivers_of(room)},
                  {"areas", areas_of(room)},
                  {"mended", room.overrides},
                  {"findings", findings_of(inspection)}};
  return json_text(json);
}

}  // namespace lichtmc
