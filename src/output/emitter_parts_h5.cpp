#include "output/emitter_parts_h5.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "base/message.hpp"
#include "lichtmc/area_drawing.hpp"
#include "lichtmc/emitter_parts_file.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/version.hpp"
#include "output/area_layout_json.hpp"
#include "output/h5_reader.hpp"
#include "output/h5_writer.hpp"

namespace lichtmc {

namespace {

constexpr const char* layout_title = "lichtmc parts of emitters, layout 1";

// Of each receiver.
constexpr std::size_t receiver_numbers = 19;
std::vector<double> numbers_of(const Receiver& one) {
  return {one.position.x,     one.position.y, one.position.z,
          one.normal.x,       one.normal.y,   one.normal.z,
          one.half_angle_deg, one.area_m2,    one.concentrator_index.value_or(0.0),
          one.filter_gain,    one.cell_u.x,   one.cell_u.y,
          one.cell_u.z,       one.cell_v.x,   one.cell_v.y,
          one.cell_v.z,       one.facing.x,   one.facing.y,
          one.facing.z};
}

Receiver receiver_from(const double* n, double law) {
  Receiver one;
  one.position = {n[0], n[1], n[2]};
  one.normal = {n[3], n[4], n[5]};
  one.half_angle_deg = n[6];
  one.area_m2 = n[7];
  if (n[8] > 0.0) one.concentrator_index = n[8];
  one.filter_gain = n[9];
  one.cell_u = {n[10], n[11], n[12]};
  one.cell_v = {n[13], n[14], n[15]};
  one.facing = {n[16], n[17], n[18]};
  one.law = law == 1.0 ? ReceiverLaw::cylindrical : law == 2.0 ? ReceiverLaw::semicylindrical : ReceiverLaw::planar;
  return one;
}

// The lines of the room's section at each level area: two points each.
std::vector<double> section_lines(const Room& room, const Result& result) {
  std::vector<double> lines;
  for (std::size_t k = 0; k < result.areas.size(); ++k) {
    const AreaDrawing drawing = draw_area(room, result, k);
    const Area& area = result.areas[k].area;
    const glm::dvec3 plane = glm::dot(area.corner, area.normal) * area.normal;
    for (const SheetLine& line : drawing.section) {
      for (const glm::dvec2& at : line) {
        const glm::dvec3 point = at.x * drawing.right + at.y * drawing.down + plane;
        lines.insert(lines.end(), {point.x, point.y, point.z});
      }
    }
  }
  return lines;
}

// Strips of 2 mm about the lines: their section at the height of the lines are the lines.
Room strips_about(const std::vector<double>& lines) {
  constexpr glm::dvec3 half{0.0, 1e-3, 0.0};
  Room room;
  if (lines.empty()) return room;
  Surface strips;
  strips.name = "section";
  for (std::size_t k = 0; k + 6 <= lines.size(); k += 6) {
    const glm::dvec3 a{lines[k], lines[k + 1], lines[k + 2]};
    const glm::dvec3 b{lines[k + 3], lines[k + 4], lines[k + 5]};
    const auto first = static_cast<glm::uint>(strips.positions.size());
    for (const glm::dvec3& corner : {a - half, b - half, b + half, a + half}) strips.positions.push_back(corner);
    strips.triangles.push_back({first, first + 1, first + 2});
    strips.triangles.push_back({first, first + 2, first + 3});
  }
  room.surfaces.push_back(std::move(strips));
  return room;
}

void write_arrays(const Result& result, H5Writer& writer) {
  const EmitterParts& parts = *result.parts;
  const std::string unit(irradiance_unit(result.quantity));
  const std::size_t receivers = parts.receivers;
  const std::size_t count = parts.parts.size();
  const auto write = [&](const std::string& name, const std::string& of_unit, const std::string& dimensions,
                         const std::string& description, std::vector<std::size_t> sizes,
                         const std::vector<double>& values) {
    writer.array({name, of_unit, dimensions, description, std::move(sizes), {}, values});
  };
  std::vector<double> powers;
  std::vector<double> factors;
  for (const EmitterParts::Part& part : parts.parts) {
    powers.push_back(part.power);
    factors.push_back(part.maintenance_factor);
  }
  const std::vector<double> rounds(parts.group_rounds.begin(), parts.group_rounds.end());
  write("power", std::string(power_unit(result.quantity)), "part", "maintained power of the emitters of a part",
        {count}, powers);
  write("maintenance_factor", "1", "part", "power over that of new emitters", {count}, factors);
  write("group_rounds", "1", "group", "rounds of each group of rounds", {rounds.size()}, rounds);
  write("direct", unit, "receiver, part", "light without reflection", {receivers, count}, parts.direct);
  write("direct_standard_error", unit, "receiver, part", "its standard error; all are independent", {receivers, count},
        parts.direct_error);
  write("reflected", unit, "receiver, part", "light reflected at least once", {receivers, count}, parts.reflected);
  write("reflected_by_group", unit, "receiver, part, group", "the same from the rounds of each group",
        {receivers, count, rounds.size()}, parts.of_groups);
  write("covariance", unit + " squared", "receiver, pair of parts",
        "covariances of the means of reflected light; parts i and j <= i are pair i (i + 1)/2 + j",
        {receivers, parts.pairs()}, parts.covariance);
  std::vector<double> places;
  std::vector<double> laws;
  for (const Receiver& one : result.receivers) {
    const std::vector<double> numbers = numbers_of(one);
    places.insert(places.end(), numbers.begin(), numbers.end());
    laws.push_back(static_cast<double>(one.law));
  }
  write("receiver_numbers", "", "receiver, number",
        "position, normal, half angle of the field of view in degrees, area in m2, index of the concentrator or 0, "
        "gain of "
        "the filter, edges of the cell, direction of a half cylinder",
        {receivers, receiver_numbers}, places);
  write("receiver_law", "1", "receiver", "0 planar, 1 cylindrical, 2 semicylindrical", {receivers}, laws);
}

}  // namespace

KeptParts kept_parts(const Room& room, const Result& result) {
  KeptParts kept{result.room, result.quantity, *result.parts, result.receivers, {}, {}};
  for (const AreaResult& one : result.areas) kept.areas.push_back(one.area);
  kept.section = strips_about(section_lines(room, result));
  kept.section.source = kept.room;
  return kept;
}

void write_emitter_parts(const Room& room, const Result& result, const Sink& sink) {
  const EmitterParts& parts = *result.parts;
  try {
    H5Writer writer(sizeof(double) * (parts.of_groups.size() + parts.covariance.size() + 4 * parts.direct.size()));
    writer.attribute("/", "title", std::string(layout_title));
    writer.attribute("/", "program", "lichtmc");
    writer.attribute("/", "version", std::string(version()));
    writer.attribute("/", "room", result.room);
    writer.attribute("/", "power_unit", std::string(power_unit(result.quantity)));
    writer.attribute("/", "rounds", parts.rounds);
    writer.attribute("/", "receivers", std::uint64_t{parts.receivers});
    std::vector<std::string> names;
    for (const EmitterParts::Part& part : parts.parts) names.push_back(part.name);
    writer.names("part", "part", "names of the emitters of each part", names);
    names.clear();
    for (const Receiver& one : result.receivers) names.push_back(one.name);
    writer.names("receiver", "receiver", "names of the receivers", names);
    names.clear();
    for (const AreaResult& one : result.areas) names.push_back(layout_of(one.area).dump());
    writer.names("area", "area", "grids of the calculation areas, as JSON", names);
    write_arrays(result, writer);
    const std::vector<double> lines = section_lines(room, result);
    writer.attribute("/", "section_lines", std::uint64_t{lines.size() / 6});
    writer.array({"section",
                  "m",
                  "line, end, x y z",
                  "lines of the room at the height of level areas",
                  {lines.size() / 6, 2, 3},
                  {},
                  lines});
    sink(writer.image());
  } catch (const Hdf5Error& error) {
    throw RuntimeError(std::string("Cannot write ") + emitter_parts_file + " (" + error.what() +
                       "). There may be too little memory: use fewer emitters of different names, or fewer points.");
  }
}

namespace {

// Points that an area has must be receivers, its cells within its grid.
void check_layout(const Area& area, std::size_t receivers) {
  const std::size_t grid = std::size_t{area.columns} * area.rows;
  const bool inside =
      std::all_of(area.cells.begin(), area.cells.end(), [grid](std::uint32_t cell) { return cell < grid; });
  if (!inside || area.first_receiver > receivers || area.cells.size() > receivers - area.first_receiver)
    throw Hdf5Error("area '" + area.properties.name + "' has points that are no receivers");
}

KeptParts read_layout(const H5Reader& file) {
  if (file.text("title") != layout_title)
    throw Hdf5Error("it is '" + file.text("title") + "' (allowed: '" + layout_title + "')");
  KeptParts kept;
  kept.room = file.text("room");
  kept.quantity = file.text("power_unit") == "W" ? Quantity::radiometric : Quantity::photometric;
  EmitterParts& parts = kept.parts;
  parts.rounds = file.number("rounds");
  parts.receivers = file.number("receivers");
  const std::vector<std::string> names = file.names("part");
  const std::size_t count = names.size();
  const std::vector<double> powers = file.array("power", count);
  const std::vector<double> factors = file.array("maintenance_factor", count);
  for (std::size_t p = 0; p < count; ++p) parts.parts.push_back({names[p], powers[p], factors[p]});
  const std::vector<std::string> receivers = file.names("receiver");
  if (receivers.size() != parts.receivers) throw Hdf5Error("it has names of " + to_text(receivers.size(), "receiver"));
  constexpr std::size_t groups = 32;
  for (const double rounds : file.array("group_rounds", groups))
    parts.group_rounds.push_back(static_cast<std::uint64_t>(rounds));
  parts.direct = file.array("direct", parts.receivers * count);
  parts.direct_error = file.array("direct_standard_error", parts.receivers * count);
  parts.reflected = file.array("reflected", parts.receivers * count);
  parts.of_groups = file.array("reflected_by_group", parts.receivers * count * groups);
  parts.covariance = file.array("covariance", parts.receivers * parts.pairs());
  const std::vector<double> numbers = file.array("receiver_numbers", parts.receivers * receiver_numbers);
  const std::vector<double> laws = file.array("receiver_law", parts.receivers);
  for (std::size_t k = 0; k < receivers.size(); ++k) {
    kept.receivers.push_back(receiver_from(numbers.data() + k * receiver_numbers, laws[k]));
    kept.receivers.back().name = receivers[k];
  }
  for (const std::string& layout : file.names("area")) {
    kept.areas.push_back(area_from(Json::parse(layout)));
    check_layout(kept.areas.back(), parts.receivers);
  }
  kept.section = strips_about(file.array("section", 6 * file.number("section_lines")));
  kept.section.source = kept.room;
  return kept;
}

}  // namespace

KeptParts read_emitter_parts(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / emitter_parts_file;
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown))
    throw InputError("There is no " + std::string(emitter_parts_file) + " in " + in_quotes(folder.string()) +
                     " (allowed: the folder of a run that kept the parts of its emitters). Run the room again with "
                     "--per-emitter and calculation areas or receivers, for example --plane 0.75.");
  const auto damaged = [&](const std::string& why) {
    return InputError("Cannot read " + in_quotes(file.string()) + " (" + why +
                      "). Run the room again with --per-emitter.");
  };
  try {
    return read_layout(H5Reader(file));
  } catch (const Hdf5Error& error) {
    throw damaged(error.what());
  } catch (const Json::exception& error) {
    throw damaged(error.what());
  }
}

}  // namespace lichtmc
