#include <optional>

#include "base/message.hpp"
#include "inspect/finding_text.hpp"
#include "inspect/topics.hpp"
#include "room/emitter_shape.hpp"
#include "room/surface_pieces.hpp"

namespace lichtmc {

void find_area_lights(const Room& room, Inspection& facts) {
  Names bodies;
  for (const Emitter& emitter : room.emitters) {
    const std::optional<std::size_t> number = emitting_surface(emitter);
    if (!number || *number >= room.surfaces.size()) continue;
    const SurfacePieces pieces = pieces_of(room.surfaces[*number]);
    if (!pieces.closed) continue;
    bodies.add(in_quotes(emitter.name) + " (" + in_percent(pieces.facing_down) + " of its area looks down)");
  }
  if (bodies.count() == 0) return;
  add(facts, Severity::note, "emitters",
      to_text(bodies.count(), "area light") + (bodies.count() == 1 ? " is a closed body" : " are closed bodies") +
          " and emit" + (bodies.count() == 1 ? "s" : "") + " from all faces: " + bodies.text() + ".",
      "Nothing to do for a globe. If only one face should emit, give the emissive material to that face alone.");
}

}  // namespace lichtmc
