#include "run/lit_space.hpp"

#include <limits>

#include "room/bounds.hpp"
#include "room/room_check.hpp"
#include "walk/inside.hpp"

namespace lichtmc {

namespace {

const Room& checked(const Room& room) {
  check_surfaces(room);
  return room;
}

// The room, with an emitter if it has none.
Room lit_room(const Room& room, const Tiling& tiling) {
  Room lit = room;
  lit.receivers.clear();
  lit.areas.clear();
  lit.area_requests.clear();
  if (lit.emitters.empty()) {
    const Bounds bounds = bounds_of(room);
    const InsidePoint inside = find_inside(room, *make_embree_tracer(room, tiling), bounds.low, bounds.high);
    lit.emitters = {{"inside", 1.0, IsotropicEmitter{inside.place}}};
  }
  check_room(lit);
  return lit;
}

}  // namespace

LitSpace::LitSpace(const Room& given)
    : tiling(make_tiling(checked(given), std::numeric_limits<double>::max())),
      room(lit_room(given, tiling)),
      scene(room, tiling, Engine::embree),
      tracer(room, *scene.tracer),
      rooms(scene, tracer) {}

}  // namespace lichtmc
