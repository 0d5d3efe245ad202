#include <algorithm>
#include <cmath>

#include "base/message.hpp"
#include "inspect/finding_text.hpp"
#include "inspect/topics.hpp"

namespace lichtmc {

namespace {

std::string length_text(double length) {
  return short_number(length) + " m";
}

std::string input_of(const LuminaireFacts& facts) {
  if (!(facts.watts > 0.0)) return "";
  return ", input " + short_number(facts.watts) + " W each as its file states";
}

// Where C0 lies.
std::string side_of_c0(const LuminousOpening& opening) {
  const double along = opening.size_m.x;
  const double across = opening.size_m.y;
  if (opening.form == OpeningForm::point) return "Its file states no luminous opening.";
  const std::string name = "Its luminous opening (" + std::string(name_of(opening.form)) + ") is " +
                           length_text(along) + " long towards C0 and " + length_text(across) + " towards C90";
  if (along == across) return name + ".";
  return name + ": C0 lies along its " + (along > across ? "longer" : "shorter") + " side.";
}

// Usual luminaires lose nothing: their files were measured outside of their housings.
constexpr double noticeable_in_housing = 0.2;
// Light that lands near is noticed from this share on: walls beside a pendant are not.
constexpr double noticeable_near = 0.05;

bool is_named(const LuminaireFacts& facts, const Inspection& inspection) {
  return std::any_of(inspection.findings.begin(), inspection.findings.end(), [&facts](const Finding& finding) {
    return finding.topic == "emitter-light" && finding.text.find(in_quotes(facts.housed)) != std::string::npos;
  });
}

void find_housing(const LuminaireFacts& file, Inspection& facts) {
  // A lamp that is shut in has a warning already.
  if (!(file.in_housing > noticeable_in_housing) || is_named(file, facts)) return;
  add(facts, Severity::warning, "luminaire-housing",
      in_percent(file.in_housing) + " of the light of luminaire " + in_quotes(file.housed) + " (photometric file " +
          in_quotes(file.file) + ") ends within " + length_text(file.housing_m) +
          " of it: probably in the mesh of its own housing, whose effect its file already contains.",
      "Leave the housing out (--without NAME), or move the luminaire to where its light leaves the housing.");
}

void find_near_light(const LuminaireFacts& file, Inspection& facts) {
  const bool receiver = !file.nearest_receiver.empty();
  if (file.as_points == 0 || (!(file.near > noticeable_near) && !receiver)) return;
  const bool one = file.as_points == 1;
  std::string text = (one ? "The luminaire" : "The " + to_text(file.as_points, "luminaire")) +
                     " with the photometric file " + in_quotes(file.file) +
                     (one ? " is taken for a point" : " are taken for points") +
                     ", but light lands nearer than five times the largest dimension of its opening, " +
                     length_text(file.limit_m) + ":";
  if (file.near > 0.0)
    text += " " + in_percent(file.near) + (one ? " of its light" : " of their light") +
            "; without shadows, the opening would put " + in_percent(file.elsewhere) + " of that elsewhere";
  if (receiver) {
    text += std::string(file.near > 0.0 ? ". " : " ") + "At receiver " + in_quotes(file.nearest_receiver) + ", " +
            length_text(file.nearest_m) +
            (one ? " from it, its direct light is " : " from one of them, the direct light of that one is ") +
            (std::isfinite(file.excess_there)
                 ? in_percent(std::abs(file.excess_there)) + (file.excess_there < 0.0 ? " too low" : " too high")
                 : std::string("there only because it is a point"));
  }
  add(facts, Severity::warning, "luminaire-size", text + ".",
      "Let light start all over the opening: end --light ies:… with :area, or set \"opening\" to \"area\" in the "
      "custom property 'ies'.");
}

}  // namespace

void find_luminaires(const Room& room, Inspection& facts) {
  for (const LuminaireFacts& file : facts.luminaires) {
    find_housing(file, facts);
    find_near_light(file, facts);
  }
  const std::string unit(power_unit(room.quantity));
  for (const LuminaireFacts& file : facts.luminaires) {
    add(facts, Severity::note, "luminaires",
        to_text(file.count, "luminaire") + " with the photometric file " + in_quotes(file.file) + " (" + file.version +
            "), " + (file.count > 1 ? "together " : "") + short_number(file.power) + " " + unit + input_of(file) +
            ". " + side_of_c0(file.opening),
        "If C0 should lie along the other side, give a rotation of 90 degrees: files are never turned. In American "
        "files 0° often lies along a linear luminaire, in European ones C0 across it.");
  }
}

}  // namespace lichtmc
