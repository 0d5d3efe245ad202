// How a luminaire is mounted: its directions in the world, and what it is scaled to.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "base/message.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/photometry.hpp"
#include "lichtmc/visible_text.hpp"

namespace lichtmc {

namespace {

struct Range {
  double least = 0.0;
  bool least_allowed = false;
  const char* allowed = "";
};
constexpr Range above_zero{0.0, false, "a finite number above 0"};
constexpr Range not_negative{0.0, true, "a finite number, 0 or more"};

void require_number(double value, const Range& range, const char* what, const char* unit, const char* remedy,
                    const std::string& where) {
  const bool inside = range.least_allowed ? value >= range.least : value > range.least;
  if (inside && std::isfinite(value)) return;
  throw InputError(where + ": " + what + " is " + to_text(value) + unit + " (allowed: " + range.allowed + "). " +
                   remedy);
}

void check_options(const LuminaireOptions& options, const std::string& where) {
  const int scalings = (options.lumens ? 1 : 0) + (options.scale ? 1 : 0) + (options.watts ? 1 : 0);
  if (scalings > 1) {
    throw InputError(where +
                     ": more than one number scales the luminaire (allowed: one of its luminous flux in lm, a factor "
                     "and its radiant flux in W). Give one of them.");
  }
  if (options.lumens)
    require_number(*options.lumens, above_zero, "its luminous flux", " lm", "Give the lumens of the luminaire.", where);
  if (options.watts) {
    require_number(*options.watts, above_zero, "its radiant flux", " W",
                   "Give the watts of its radiation, not those of the mains.", where);
  }
  if (options.scale) {
    require_number(*options.scale, not_negative, "the factor of its intensity", "",
                   "Give 1 for the intensity of the file.", where);
  }
  if (!std::isfinite(options.rotation_deg)) {
    throw InputError(where + ": its rotation is " + to_text(options.rotation_deg) +
                     " degrees (allowed: a finite number). Give the angle about its aim from C0 towards C90.");
  }
}

// Sine and cosine of an angle in degrees; those of a quarter turn exactly.
std::pair<double, double> sine_and_cosine(double degrees) {
  const double turns = std::remainder(degrees, 360.0);
  const double quarters = std::nearbyint(turns / 90.0);
  const double rest = (turns - 90.0 * quarters) * std::numbers::pi / 180.0;
  const double sine = std::sin(rest);
  const double cosine = std::cos(rest);
  switch (static_cast<int>(quarters) & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

}  // namespace

std::vector<Ignored> remarks_of(const Photometry& photometry) {
  const std::string of =
      "Photometric file " + in_quotes(std::filesystem::path(photometry.source).filename().string()) + ": ";
  std::vector<Ignored> remarks;
  for (const std::string& warning : photometry.warnings) {
    remarks.push_back({of + warning, Effect::figures,
                       "Compare the luminaire with the maker's data; 'lichtmc luminaire' shows what was read."});
  }
  for (const std::string& note : photometry.notes) remarks.push_back({of + note, Effect::none});
  return remarks;
}

LuminaireAxes axes_towards(const glm::dvec3& aim) {
  const double largest = std::max({std::abs(aim.x), std::abs(aim.y), std::abs(aim.z)});
  if (!(largest > 0.0) || !std::isfinite(largest)) {
    throw InputError("The aim of the luminaire is (" + to_text(aim.x) + ", " + to_text(aim.y) + ", " + to_text(aim.z) +
                     ") (allowed: finite numbers, not all 0). Give a direction, for example 0,-1,0 for downwards.");
  }
  const glm::dvec3 to = glm::normalize(aim / largest);
  LuminaireAxes axes;
  // The shortest rotation turns the middle direction, halfway between both, by half of its angle: two reflections, in
  // the planes across the first direction and across the middle one.
  const glm::dvec3 sum = axes.aim + to;
  const double length = glm::length(sum);
  // Half a turn about X: the limit for directions towards ±Z next to it.
  const glm::dvec3 middle = length > 0.0 ? sum / length : glm::dvec3(0.0, 0.0, 1.0);
  const glm::dvec3 from = axes.aim;
  const auto turned = [&](const glm::dvec3& v) {
    const glm::dvec3 reflected = v - 2.0 * glm::dot(v, from) * from;
    return reflected - 2.0 * glm::dot(reflected, middle) * middle;
  };
  const glm::dvec3 c0 = turned(axes.c0);
  axes.aim = to;
  // Perpendicular to the aim beyond rounding.
  axes.c0 = glm::normalize(c0 - glm::dot(c0, to) * to);
  axes.c90 = glm::cross(axes.c0, to);
  return axes;
}

LuminaireEmitter mount(std::shared_ptr<const Photometry> photometry, const glm::dvec3& position,
                       const LuminaireAxes& axes, const LuminaireOptions& options, const std::string& where) {
  check_options(options, where);
  const Photometry& file = *photometry;
  if (file.intensity_unit != "cd" && !options.watts) {
    throw InputError(
        where + ": the intensities of " + file.source + " are in " + visible_text(file.intensity_unit) +
        ", not in cd (allowed: cd, unless its radiant flux is given). Give W=…, its radiant flux in W; in a "
        "glTF file 'watts' in the custom property 'ies'.");
  }
  LuminaireEmitter mounted;
  if (options.area) {
    if (file.opening.form == OpeningForm::point) {
      throw InputError(where + ": " + file.source +
                       " states no size of the luminous opening, so that its light cannot start all over it (allowed: "
                       "the luminaire as a point). Leave 'area' out.");
    }
    mounted.shape.opening = file.opening;
  }
  const auto [sine, cosine] = sine_and_cosine(options.rotation_deg);
  mounted.shape.position = position;
  mounted.shape.axis = axes.aim;
  mounted.shape.c0 = cosine * axes.c0 + sine * axes.c90;
  mounted.shape.c90 = cosine * axes.c90 - sine * axes.c0;
  mounted.power = options.watts    ? *options.watts
                  : options.lumens ? *options.lumens
                                   : file.flux() * options.scale.value_or(1.0);
  mounted.quantity = options.watts ? Quantity::radiometric : Quantity::photometric;
  mounted.shape.photometry = std::move(photometry);
  return mounted;
}

}  // namespace lichtmc
