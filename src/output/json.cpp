#include "output/json.hpp"

#include <cmath>

#include "base/decimal_shift.hpp"
#include "room/emitter_place.hpp"
#include "room/emitter_shape.hpp"

namespace lichtmc {

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json number_or_null(const std::optional<double>& value) {
  return value ? number(*value) : Json(nullptr);
}

Json vector_of(const glm::dvec3& v) {
  return {number(v.x), number(v.y), number(v.z)};
}

std::string_view kind_of(const Emitter& emitter) {
  return visit_shape(
      emitter, [](const auto& point) { return point.law().name(); },
      [](const auto& /*area_light*/) { return std::string_view("surface"); });
}

Json emitters_of(const Room& room) {
  Json emitters = Json::array();
  for (const Emitter& emitter : room.emitters) {
    const Photometry* photometry = photometry_of(emitter);
    emitters.push_back({{"name", emitter.name},
                        {"kind", std::string(kind_of(emitter))},
                        {"file", photometry != nullptr ? Json(photometry->source) : Json(nullptr)},
                        {"power", number(emitter.power)},
                        {"delay_ns", number(shift_decimals(emitter.delay_s, 9))},
                        {"maintenance_factor", number(emitter.maintenance_factor)},
                        {"initial_power", number(emitter.power / emitter.maintenance_factor)}});
  }
  return emitters;
}

void add_law(const Receiver& receiver, Json& object) {
  if (receiver.law == ReceiverLaw::planar) return;
  object["quantity"] = std::string(to_string(receiver.law));
  const glm::dvec3& facing = receiver.facing;
  if (receiver.law == ReceiverLaw::semicylindrical)
    object["facing"] = {number(facing.x), number(facing.y), number(facing.z)};
}

std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lichtmc
