// lichtmc check: the content of a room file, what will be modelled, and what is probably wrong.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/inspect.hpp"
#include "lichtmc/lay_areas.hpp"
#include "lichtmc/photometry.hpp"
#include "lichtmc/visible_text.hpp"
#include "light_spec.hpp"
#include "progress_line.hpp"
#include "quantities.hpp"
#include "room_options.hpp"

namespace lichtmc::app {

namespace {

struct CheckOptions {
  RoomOptions reading;
  std::string tile = "0.1";
  bool json = false;
  bool strict = false;
};

constexpr int exit_done = 0;
constexpr int exit_warned = 1;
constexpr int exit_unusable = 2;

std::string row(const char* name, const std::string& text) {
  char line[32];
  std::snprintf(line, sizeof line, "  %-12s", name);
  return line + text + "\n";
}

// Large coordinates to the millimetre: four digits would hide the room in them.
std::string coordinate(double value) {
  if (!(std::abs(value) >= 1000.0 && std::abs(value) < 1e9)) return four_digits(value);
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.3f", value);
  std::string text = digits;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string point(const glm::dvec3& p) {
  return "(" + coordinate(p.x) + ", " + coordinate(p.y) + ", " + coordinate(p.z) + ")";
}

// Materials with their reflectances, the sources of these, and areas.
void print_materials(const Inspection& facts) {
  struct Cover {
    double low = 1.0;
    double high = 0.0;
    double area = 0.0;
    std::set<std::string_view> sources;
  };
  std::map<std::string, Cover> covers;
  for (const SurfaceFacts& surface : facts.surfaces) {
    Cover& cover = covers[surface.material];
    cover.low = std::min(cover.low, surface.reflectance);
    cover.high = std::max(cover.high, surface.reflectance);
    cover.area += surface.area_m2;
    cover.sources.insert(reflectance_source_word(surface.reflectance_source));
  }
  std::cout << "\nMaterials (reflectance and its source, area)\n";
  for (const auto& [name, cover] : covers) {
    const bool several = four_digits(cover.low) != four_digits(cover.high);
    std::string sources;
    for (const std::string_view source : cover.sources) sources += (sources.empty() ? "" : ", ") + std::string(source);
    std::cout << "  " << (name.empty() ? "(no name)" : visible_text(name)) << ": "
              << (several ? four_digits(cover.low) + " to " + four_digits(cover.high) : four_digits(cover.high)) << " ("
              << sources << "), " << four_digits(cover.area) << " m^2\n";
  }
}

std::string delay_text(const Emitter& emitter) {
  return emitter.delay_s > 0.0 ? ", delay " + four_digits(1e9 * emitter.delay_s) + " ns" : std::string();
}

std::string maintenance_text(const Emitter& emitter, const std::string& unit) {
  if (!emitter.own_maintenance && emitter.maintenance_factor == 1.0) return "";
  return ", maintenance factor " + four_digits(emitter.maintenance_factor) +
         " (new: " + four_digits(emitter.power / emitter.maintenance_factor) + ' ' + unit + ')';
}

// The photometric file of a luminaire, and the input power that it states.
std::string file_text(const Emitter& emitter) {
  const Photometry* const photometry = std::visit(
      [](const auto& shape) -> const Photometry* {
        if constexpr (requires { shape.photometry; }) return shape.photometry.get();
        return nullptr;
      },
      emitter.shape);
  if (photometry == nullptr) return "";
  const Photometry& file = *photometry;
  std::string text = ", " + visible_text(std::filesystem::path(file.source).filename().string());
  if (file.watts > 0.0) text += ", input " + four_digits(file.watts) + " W";
  return text;
}

void print_emitters(const Room& room) {
  constexpr std::size_t shown = 20;
  const std::string unit(power_unit(room.quantity));
  std::cout << "\nEmitters (" << room.emitters.size() << ", together " << four_digits(total_power(room)) << ' ' << unit
            << ")\n";
  for (std::size_t k = 0; k < std::min(shown, room.emitters.size()); ++k)
    std::cout << "  " << visible_text(room.emitters[k].name) << ": " << four_digits(room.emitters[k].power) << ' '
              << unit << maintenance_text(room.emitters[k], unit) << file_text(room.emitters[k])
              << delay_text(room.emitters[k]) << '\n';
  if (room.emitters.size() > shown)
    std::cout << "  … and " << room.emitters.size() - shown << " more (--json lists all)\n";
}

// The receivers of the file; the points of its areas follow them.
std::vector<Receiver> receivers_of_file(const Room& room) {
  const std::size_t count = room.areas.empty() ? room.receivers.size() : room.areas.front().first_receiver;
  return {room.receivers.begin(), room.receivers.begin() + static_cast<std::ptrdiff_t>(count)};
}

std::string count_of_receivers(const Room& room) {
  const std::size_t own = receivers_of_file(room).size();
  std::string text = std::to_string(own);
  const std::size_t points = room.receivers.size() - own;
  if (points > 0)
    text += ", and " + std::to_string(points) + (points == 1 ? " point" : " points") + " of calculation areas";
  return text;
}

// Only receivers of a file with more than a position and a normal.
void print_receivers(const Room& room) {
  constexpr std::size_t shown = 20;
  const std::vector<Receiver> receivers = receivers_of_file(room);
  const Receiver plain;
  const bool optics = std::any_of(receivers.begin(), receivers.end(), [&plain](const Receiver& r) {
    return r.area_m2 != plain.area_m2 || r.half_angle_deg != plain.half_angle_deg || r.optical_gain() != 1.0 ||
           r.law != plain.law;
  });
  if (!optics) return;
  std::cout << "\nReceivers (" << receivers.size() << "; area, half angle of the field of view)\n";
  for (std::size_t k = 0; k < std::min(shown, receivers.size()); ++k) {
    const Receiver& r = receivers[k];
    const bool is_planar = r.law == ReceiverLaw::planar;
    std::cout << "  " << visible_text(r.name) << ": " << four_digits(r.area_m2) << " m^2, "
              << (is_planar ? four_digits(r.half_angle_deg) + " degrees" : std::string(to_string(r.law)));
    if (r.concentrator_index) std::cout << ", concentrator of index " << four_digits(*r.concentrator_index);
    if (r.filter_gain != 1.0) std::cout << ", filter gain " << four_digits(r.filter_gain);
    if (r.optical_gain() != 1.0) std::cout << "; optical gain " << four_digits(r.optical_gain());
    std::cout << '\n';
  }
  if (receivers.size() > shown) std::cout << "  … and " << receivers.size() - shown << " more (--json lists all)\n";
}

void print_areas(const Room& room) {
  constexpr std::size_t shown = 20;
  if (room.areas.empty()) return;
  std::cout << "\nCalculation areas (" << room.areas.size() << ")\n";
  for (std::size_t k = 0; k < std::min(shown, room.areas.size()); ++k) {
    const AreaProperties& asked = room.areas[k].properties;
    std::cout << "  " << visible_text(description_of(room.areas[k]));
    if (!asked.role.empty()) std::cout << " Role: " << visible_text(asked.role) << '.';
    if (asked.target_lx) std::cout << " Target: " << four_digits(*asked.target_lx) << " lx.";
    if (asked.target_uniformity) std::cout << " Target of U0: " << four_digits(*asked.target_uniformity) << '.';
    std::cout << '\n';
  }
  if (room.areas.size() > shown) std::cout << "  … and " << room.areas.size() - shown << " more\n";
}

void print_facts(const Room& room, const Inspection& facts) {
  const glm::dvec3 size = facts.high - facts.low;
  std::cout << visible_text(room.source) << '\n';
  std::cout << row("Size", four_digits(size.x) + " x " + four_digits(size.y) + " x " + four_digits(size.z) +
                               " m (x, height y, z), from " + point(facts.low) + " to " + point(facts.high));
  std::cout << row("Meshes", std::to_string(facts.triangles) + " triangles in " +
                                 std::to_string(facts.surfaces.size()) + " surfaces" +
                                 (facts.tiles > 0 ? "; " + std::to_string(facts.tiles) + " tiles" : std::string()));
  std::cout << row("Shape", std::string(facts.cuboid ? "empty cuboid, " : "") +
                                (facts.convex ? "convex, " : "not convex, ") +
                                (facts.closed ? "closed" : "not closed"));
  std::cout << row("Receivers", count_of_receivers(room));
  for (const std::string& change : room.overrides) std::cout << row("Override", visible_text(change));
  print_materials(facts);
  print_emitters(room);
  print_receivers(room);
  print_areas(room);
}

// A finding, and below it what to do.
void print_finding(const char* word, const Finding& finding) {
  std::cout << word << ": " << visible_text(finding.text) << "\n    -> " << visible_text(finding.advice) << '\n';
}

void print_findings(const Inspection& facts) {
  constexpr std::size_t most_of_a_topic = 5;
  std::cout << '\n';
  std::map<std::string, std::size_t> notes;  // by topic
  for (const Finding& finding : facts.findings) {
    switch (finding.severity) {
      case Severity::fault:
        print_finding("FAULT", finding);
        break;
      case Severity::warning:
        print_finding("Warning", finding);
        break;
      case Severity::note:
        if (++notes[finding.topic] <= most_of_a_topic) print_finding("Note", finding);
        break;
    }
  }
  for (const auto& [topic, count] : notes) {
    if (count > most_of_a_topic)
      std::cout << "Note: " << count - most_of_a_topic << " more like these (" << topic << "); --json lists all.\n";
  }
  const std::size_t faults = facts.count(Severity::fault);
  const std::size_t warnings = facts.count(Severity::warning);
  std::cout << '\n'
            << (faults > 0 ? "'lichtmc run' would reject this room: "
                           : "'lichtmc run' accepts this room with the same options: ")
            << faults << (faults == 1 ? " fault, " : " faults, ") << warnings
            << (warnings == 1 ? " warning.\n" : " warnings.\n");
}

// Areas without points remain requests: inspect() says what is wrong with them.
void lay_areas_of_file(Room& room) {
  if (room.area_requests.empty()) return;
  Room laid = room;
  try {
    lay_areas(laid);
  } catch (const InputError&) {
    return;
  }
  room = std::move(laid);
}

int check(const CheckOptions& options) {
  const double tile_edge_m = parse_number(options.tile, "--tile");
  StepLine line(ProgressForm::bar);
  line.update("Reading the room");
  Room room = read_room(options.reading);
  lay_areas_of_file(room);
  const Inspection facts =
      inspect(room, tile_edge_m, prepare(room, 0, [&line](std::string_view step) { line.update(step); }));
  line.clear();
  if (options.json) {
    std::cout << inspection_json(room, facts);
  } else {
    print_facts(room, facts);
    print_findings(facts);
  }
  if (facts.count(Severity::fault) > 0) return exit_unusable;
  return options.strict && facts.count(Severity::warning) > 0 ? exit_warned : exit_done;
}

}  // namespace

void add_check_command(CLI::App& program, const Invocation& invocation) {
  CLI::App* command =
      program.add_subcommand("check", "Check a room: what will be modelled, what is probably wrong, what to do");
  auto options = std::make_shared<CheckOptions>();
  add_room_argument(*command, options->reading);
  command->add_flag("--json", options->json, "Write everything as JSON");
  command->add_flag("--strict", options->strict, "Exit with status 1 if there is a warning");
  command->add_option("--tile", options->tile, "Edge of a tile in metres")->type_name("M")->capture_default_str();
  add_room_options(*command, options->reading);
  command->footer(std::string("Several hundred thousand rays are traced, to determine whether light leaves the room "
                              "and which side of each\n"
                              "face it reaches.\n\n") +
                  light_forms +
                  "\nExamples:\n"
                  "  lichtmc check room.glb\n"
                  "  lichtmc check hall.glb --scale 0.01 --light point:5,3,5:8000lm --max-reflectance 0.9\n"
                  "Exit status: 0 the room can be simulated, perhaps with warnings; 1 with --strict: there are "
                  "warnings; 2 the room "
                  "cannot be simulated.");
  command->callback([options, &invocation] { *invocation.status = check(*options); });
}

}  // namespace lichtmc::app
