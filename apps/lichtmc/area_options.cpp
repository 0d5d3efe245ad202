#include "area_options.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "lichtmc/error.hpp"
#include "lichtmc/lay_areas.hpp"
#include "quantities.hpp"
#include "split.hpp"

namespace lichtmc::app {

const char* const area_forms =
    "Calculation areas (--plane, --area, --area-on) may be followed by properties, each after a colon:\n"
    "  spacing=M  margin=M  target_lx=E  target_uniformity=U0  role=TEXT  name=TEXT  cells\n"
    "  quantity=normal|horizontal|cylindrical|semicylindrical  direction=X,Y,Z\n"
    "for example --plane 0.75:0.5:spacing=0.5:target_lx=500:target_uniformity=0.6\n";

void add_area_options(CLI::App& command, AreaOptions& options) {
  const std::string group = "Calculation areas, in addition to those of the file";
  const auto add = [&](const char* name, std::vector<std::string>& values, const char* help, const char* type) {
    command.add_option(name, values, help)->type_name(type)->expected(1)->take_all()->group(group);
  };
  add("--plane", options.planes,
      "Working planes H metres above the floors, less a margin along walls [0.5 m]: one for each room (repeatable)",
      "H[:MARGIN]");
  add("--area", options.areas,
      "Area with this corner and these two edges, measured from above if it is level, else on the side of U x V "
      "(repeatable)",
      "NAME:X,Y,Z:UX,UY,UZ:VX,VY,VZ");
  add("--area-on", options.surfaces,
      "Area on a surface, or on those of a material or pattern, less a margin along its edges [0] (repeatable)",
      "SURFACE[:MARGIN]");
}

namespace {

constexpr const char* allowed_properties =
    "spacing=M, margin=M, target_lx=E, target_uniformity=U0, role=TEXT, name=TEXT, quantity=normal, horizontal, "
    "cylindrical or semicylindrical, direction=X,Y,Z, cells";

AreaQuantity parse_quantity(std::string_view text, const std::string& option) {
  for (const AreaQuantity quantity :
       {AreaQuantity::normal, AreaQuantity::horizontal, AreaQuantity::cylindrical, AreaQuantity::semicylindrical}) {
    if (to_string(quantity) == text) return quantity;
  }
  throw InputError("The quantity '" + std::string(text) + "' of " + option +
                   " is not known (allowed: normal, horizontal, cylindrical, semicylindrical). Give one of these.");
}

// One "name=value", or "cells".
void set_property(std::string_view part, const std::string& option, AreaProperties& properties) {
  const std::size_t equals = part.find('=');
  const std::string_view name = part.substr(0, equals);
  const std::string_view value = equals == std::string_view::npos ? "" : part.substr(equals + 1);
  const std::string where = option + ", " + std::string(name);
  const std::array<std::pair<std::string_view, std::optional<double>*>, 4> numbers{
      {{"spacing", &properties.spacing_m},
       {"margin", &properties.margin_m},
       {"target_lx", &properties.target_lx},
       {"target_uniformity", &properties.target_uniformity}}};
  const auto number = std::find_if(numbers.begin(), numbers.end(), [&](const auto& one) { return one.first == name; });
  if (number != numbers.end()) {
    if (*number->second)
      throw InputError("The property '" + std::string(name) + "' is given twice in " + option +
                       " (allowed: once). Leave one out.");
    *number->second = parse_number(value, where);
  } else if (name == "role") {
    properties.role = value;
  } else if (name == "name") {
    properties.name = value;
  } else if (name == "quantity") {
    properties.quantity = parse_quantity(value, option);
  } else if (name == "direction") {
    properties.direction = parse_vector(value, where);
  } else if (part == "cells") {
    properties.cells = true;
  } else {
    throw InputError("The property '" + std::string(name) + "' of " + option +
                     " is not known (allowed: " + allowed_properties + "). Give one of these.");
  }
}

bool is_property(std::string_view part) {
  return part == "cells" || part.find('=') != std::string_view::npos;
}

bool looks_like_margin(std::string_view part) {
  return !part.empty() && part.find_first_not_of("0123456789.+-eE") == std::string_view::npos &&
         part.find_first_of("0123456789") != std::string_view::npos;
}

// "WHAT[:MARGIN][:name=value]…": sets the properties and returns WHAT.
std::string parse_tail(const std::string& text, const std::string& option, AreaProperties& properties) {
  std::vector<std::string_view> parts = split(text, ':');
  auto first = parts.end();
  while (first != parts.begin() + 1 && is_property(*(first - 1))) --first;
  auto margin = first;
  if (first != parts.begin() + 1 && looks_like_margin(*(first - 1))) {
    --margin;
    properties.margin_m = parse_number(*margin, option + ", margin");
  }
  for (auto part = first; part != parts.end(); ++part) set_property(*part, option, properties);
  std::string what;
  for (auto part = parts.begin(); part != margin; ++part) what += (what.empty() ? "" : ":") + std::string(*part);
  return what;
}

void lay_plane(const std::string& text, bool several, Room& room) {
  const std::string option = "--plane " + text;
  AreaProperties properties;
  const std::string height = parse_tail(text, option, properties);
  if (properties.name.empty()) properties.name = several ? "plane_" + height : "plane";
  lay_working_planes(room, parse_number(height, option), properties);
}

AreaRequest parse_area(const std::string& text) {
  const std::string option = "--area " + text;
  const std::vector<std::string_view> parts = split(text, ':');
  if (parts.size() < 4 || parts[0].empty()) {
    throw InputError("The value '" + text +
                     "' of --area cannot be used (allowed: NAME:X,Y,Z:UX,UY,UZ:VX,VY,VZ, a corner and two edges in "
                     "metres, then properties). Give it in that form, for example desk:1,0.75,1:1.6,0,0:0,0,0.8.");
  }
  AreaRequest request;
  request.properties.name = parts[0];
  const glm::dvec3 corner = parse_vector(parts[1], option);
  const glm::dvec3 u = parse_vector(parts[2], option);
  const glm::dvec3 v = parse_vector(parts[3], option);
  for (std::size_t k = 4; k < parts.size(); ++k) set_property(parts[k], option, request.properties);
  request.triangles = {{corner, corner + u, corner + u + v}, {corner, corner + u + v, corner + v}};
  return request;
}

}  // namespace

void lay_all_areas(const AreaOptions& options, Room& room, std::vector<std::string>& notes) {
  for (const std::string& text : options.areas) room.area_requests.push_back(parse_area(text));
  lay_areas(room);
  for (const std::string& text : options.planes) lay_plane(text, options.planes.size() > 1, room);
  for (const std::string& text : options.surfaces) {
    AreaProperties properties;
    const std::string surface = parse_tail(text, "--area-on " + text, properties);
    lay_area_on(room, surface, properties);
  }
  constexpr std::size_t shown = 20;
  for (std::size_t k = 0; k < std::min(shown, room.areas.size()); ++k) notes.push_back(description_of(room.areas[k]));
  if (room.areas.size() > shown)
    notes.push_back(std::to_string(room.areas.size() - shown) + " more calculation areas, see areas.csv.");
}

}  // namespace lichtmc::app
