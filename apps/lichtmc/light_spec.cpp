#include "light_spec.hpp"

#include <string_view>

#include "lichtmc/error.hpp"
#include "lichtmc/overrides.hpp"
#include "luminaire_spec.hpp"
#include "quantities.hpp"
#include "split.hpp"

namespace lichtmc::app {

const char* const light_help = "Add a light source (repeatable), in one of the forms below";

const char* const light_forms =
    "Light sources (--light), positions in metres with Y up, power in lm (luminous flux) or W (radiant flux):\n"
    "  point:X,Y,Z:POWER                the same intensity in every direction, for example point:2,2.4,1.5:1000lm\n"
    "  lambert:X,Y,Z:DX,DY,DZ:M:POWER   generalized Lambert emitter cos^M about a direction, for example\n"
    "                                   lambert:0.5,0.5,0.5:0,-1,0:5:1W (M = 1: Lambert; large M: narrow beam)\n"
    "  ies:FILE:X,Y,Z[:NX,NY,NZ[:ROTATION]][:lm=LM|x=FACTOR|W=WATTS][:set=N][:area][:flip-h]\n"
    "                                   luminaire with an IES or EULUMDAT file, whose name has no ':'. Aim NX,NY,NZ\n"
    "                                   [0,-1,0: down, C0 towards +X], ROTATION in degrees from C0 towards C90;\n"
    "                                   scaled to a flux in lm, by a factor, or to a radiant flux in W; lamp set N of "
    "a\n"
    "                                   EULUMDAT file; light from all over its opening; for example\n"
    "                                   ies:lamp.ies:2,2.4,1.5 or ies:lamp.ldt:2,2.4,1.5:0,-1,0:90:lm=3500:area\n";

namespace {

Emitter parse_light(const std::string& description, Quantity& quantity) {
  const std::string option = "--light " + description;
  const std::vector<std::string_view> part = split(description, ':');
  Emitter emitter;
  emitter.name = description;
  emitter.power = parse_power(part.back(), option, quantity);
  if (part.front() == "point" && part.size() == 3) {
    emitter.shape = IsotropicEmitter{parse_vector(part[1], option)};
  } else if (part.front() == "lambert" && part.size() == 5) {
    emitter.shape =
        LambertEmitter{parse_vector(part[1], option), parse_vector(part[2], option), parse_number(part[3], option)};
  } else {
    throw InputError("The light source '" + description +
                     "' cannot be used (allowed: point:X,Y,Z:POWER, lambert:X,Y,Z:DX,DY,DZ:M:POWER or ies:FILE:X,Y,Z). "
                     "Give it in one of these forms, for example --light point:2,2.4,1.5:1000lm.");
  }
  return emitter;
}

}  // namespace

void add_lights(Room& room, const std::vector<std::string>& descriptions) {
  LuminaireSpecs luminaires;
  for (const std::string& description : descriptions) {
    if (description.starts_with("ies:")) {
      luminaires.add(room, description);
      continue;
    }
    Quantity quantity = Quantity::photometric;
    Emitter emitter = parse_light(description, quantity);
    add_emitter(room, std::move(emitter), quantity);
  }
}

}  // namespace lichtmc::app
