#include "output/json.hpp"

#include <cmath>
#include <variant>

namespace lichtmc {

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

std::string_view kind_of(const Emitter& emitter) {
  struct Kind {
    std::string_view operator()(const IsotropicEmitter&) const { return "isotropic"; }
    std::string_view operator()(const LambertEmitter&) const { return "lambert"; }
    std::string_view operator()(const SpotEmitter&) const { return "spot"; }
    std::string_view operator()(const SurfaceEmitter&) const { return "surface"; }
  };
  return std::visit(Kind{}, emitter.shape);
}

Json emitters_of(const Room& room) {
  Json emitters = Json::array();
  for (const Emitter& emitter : room.emitters) {
    emitters.push_back(
        {{"name", emitter.name}, {"kind", std::string(kind_of(emitter))}, {"power", number(emitter.power)}});
  }
  return emitters;
}

std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lichtmc
