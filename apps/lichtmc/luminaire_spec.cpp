#include "luminaire_spec.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "lichtmc/error.hpp"
#include "lichtmc/overrides.hpp"
#include "quantities.hpp"
#include "split.hpp"

namespace lichtmc::app {

namespace {

constexpr const char* luminaire_form =
    "ies:FILE:X,Y,Z[:NX,NY,NZ[:ROTATION]][:lm=LM|x=FACTOR|W=WATTS][:set=N][:area][:flip-h]";

[[noreturn]] void refuse_light(const std::string& description, const std::string& fault) {
  throw InputError("The light source '" + description + "' cannot be used: " + fault + " (allowed: " + luminaire_form +
                   ", with a FILE whose name has no ':'). Give it in this form, for example --light "
                   "ies:lamp.ies:2,2.4,1.5.");
}

struct LuminaireSpec {
  std::string file;
  glm::dvec3 position{0.0};
  glm::dvec3 aim{0.0, -1.0, 0.0};
  PhotometryOptions reading;
  LuminaireOptions mounting;
};

// The parts behind the position.
void read_luminaire_options(const std::string& description, const std::vector<std::string_view>& parts,
                            LuminaireSpec& spec) {
  const std::string option = "--light " + description;
  std::size_t places = 0;  // aim, rotation
  std::set<std::string_view> given;
  for (std::size_t k = 3; k < parts.size(); ++k) {
    const std::string_view part = parts[k];
    const std::size_t equals = part.find('=');
    const std::string_view key = part.substr(0, equals);
    const std::string_view value = equals == std::string_view::npos ? std::string_view() : part.substr(equals + 1);
    const bool named = equals != std::string_view::npos || part == "area" || part == "flip-h";
    if (named && !given.insert(key).second) refuse_light(description, "'" + std::string(key) + "' is given twice");
    if (part == "area") {
      spec.mounting.area = true;
    } else if (part == "flip-h") {
      spec.reading.flip_horizontal = true;
    } else if (key == "lm" && named) {
      spec.mounting.lumens = parse_number(value, option);
    } else if (key == "x" && named) {
      spec.mounting.scale = parse_number(value, option);
    } else if (key == "W" && named) {
      spec.mounting.watts = parse_number(value, option);
    } else if (key == "set" && named) {
      spec.reading.lamp_set = parse_count(value, option);
    } else if (named || !given.empty() || places > 1) {
      refuse_light(description, "'" + std::string(part) + "' is not known there");
    } else if (places++ == 0) {
      spec.aim = parse_vector(part, option);
    } else {
      spec.mounting.rotation_deg = parse_number(part, option);
    }
  }
}

LuminaireSpec parse_spec(const std::string& description) {
  const std::vector<std::string_view> parts = split(description, ':');
  if (parts.size() < 3) refuse_light(description, "it has no position");
  LuminaireSpec spec;
  spec.file = std::string(parts[1]);
  if (spec.file.empty()) refuse_light(description, "it names no file");
  if (parts[2].find(',') == std::string_view::npos)
    refuse_light(description, "'" + std::string(parts[2]) + "' is not a position");
  spec.position = parse_vector(parts[2], "--light " + description);
  read_luminaire_options(description, parts, spec);
  spec.reading.needs_flux = !spec.mounting.lumens && !spec.mounting.watts;
  return spec;
}

std::string unused_name(const Room& room, const std::string& name) {
  const auto used = [&room](const std::string& candidate) {
    return std::any_of(room.emitters.begin(), room.emitters.end(),
                       [&candidate](const Emitter& one) { return one.name == candidate; });
  };
  std::string candidate = name;
  for (int n = 2; used(candidate); ++n) candidate = name + "_" + std::to_string(n);
  return candidate;
}

}  // namespace

void LuminaireSpecs::add(Room& room, const std::string& description) {
  const LuminaireSpec spec = parse_spec(description);
  const Key key{spec.file, spec.reading.lamp_set, spec.reading.flip_horizontal, spec.reading.needs_flux};
  std::shared_ptr<const Photometry>& file = files_[key];
  if (file == nullptr) {
    file = std::make_shared<const Photometry>(read_photometry(spec.file, spec.reading));
    for (Ignored& remark : remarks_of(*file)) room.ignored.push_back(std::move(remark));
  }
  LuminaireEmitter mounted =
      mount(file, spec.position, axes_towards(spec.aim), spec.mounting, "The light source '" + description + "'");
  Emitter emitter;
  emitter.name = unused_name(room, std::filesystem::path(spec.file).stem().string());
  emitter.power = mounted.power;
  emitter.shape = std::move(mounted.shape);
  add_emitter(room, std::move(emitter), mounted.quantity);
}

}  // namespace lichtmc::app
