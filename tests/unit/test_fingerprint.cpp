// The fingerprint of a room: it depends on everything that results depend on, and on nothing else.
#include <functional>
#include <string>
#include <vector>

#include "lichtmc/state.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

// A room with every kind of element.
Room room_of_everything() {
  Room room = unit_cube(0.5, isotropic({0.5, 0.5, 0.5}));
  room.quantity = Quantity::radiometric;
  room.emitters.push_back(lambert({0.4, 0.5, 0.5}, {0, -1, 0}, 2.0));
  room.emitters.push_back({"spot", 1.0, SpotEmitter{{0.3, 0.5, 0.5}, {0, -1, 0}, 0.1, 0.5}});
  room.emitters.push_back(surface_emitter(0, 1.0));
  room.receivers.push_back({"desk", {0.5, 0.2, 0.5}, {0, 1, 0}, 90.0, 1.0});
  Surface& surface = room.surfaces[0];
  surface.uvs.assign(surface.positions.size(), {0.25, 0.5});
  surface.reflectance_map = 0;
  surface.reflectance_uvs.assign(surface.positions.size(), {0.5, 0.5});
  room.reflectance_maps.push_back({"picture", 2, 1, {0.2F, 0.4F}});
  auto& panel = std::get<SurfaceEmitter>(room.emitters.back().shape);
  panel.emission_map = 0;
  panel.emission_uvs.assign(surface.positions.size(), {0.5, 0.5});
  room.emission_maps.push_back({"panel", 2, 1, {0.0F, 1.0F}});
  room.surfaces[2].vertex_colours.assign(room.surfaces[2].positions.size(), {0.5, 0.25, 0.75});
  return room;
}

struct Change {
  std::string of;
  std::function<void(Room&)> make;
};

template <class Shape>
Shape& shape(Room& room, std::size_t k) {
  return std::get<Shape>(room.emitters[k].shape);
}

const std::vector<Change>& changes() {
  static const std::vector<Change> all{
      {"quantity", [](Room& r) { r.quantity = Quantity::photometric; }},
      {"surface left out", [](Room& r) { r.surfaces.pop_back(); }},
      {"order of surfaces", [](Room& r) { std::swap(r.surfaces[1], r.surfaces[2]); }},
      {"surface name", [](Room& r) { r.surfaces[1].name += "x"; }},
      {"material", [](Room& r) { r.surfaces[1].material += "x"; }},
      {"reflectance", [](Room& r) { r.surfaces[1].reflectance += 1e-15; }},
      {"sides", [](Room& r) { r.surfaces[1].sides = Sides::both; }},
      {"position", [](Room& r) { r.surfaces[1].positions[0].x += 1e-12; }},
      {"uv", [](Room& r) { r.surfaces[0].uvs[0].y += 1e-12; }},
      {"uvs left out", [](Room& r) { r.surfaces[0].uvs.clear(); }},
      {"triangle", [](Room& r) { std::swap(r.surfaces[1].triangles[0].x, r.surfaces[1].triangles[0].y); }},
      {"triangle left out", [](Room& r) { r.surfaces[1].triangles.pop_back(); }},
      {"map left out", [](Room& r) { r.surfaces[0].reflectance_map.reset(); }},
      {"place on the map", [](Room& r) { r.surfaces[0].reflectance_uvs[0].x += 1e-12; }},
      {"map's columns", [](Room& r) { std::swap(r.reflectance_maps[0].columns, r.reflectance_maps[0].rows); }},
      {"map's value", [](Room& r) { r.reflectance_maps[0].values[1] = 0.5F; }},
      {"map's wrap in u", [](Room& r) { r.reflectance_maps[0].wrap_u = Wrap::clamp; }},
      {"map's wrap in v", [](Room& r) { r.reflectance_maps[0].wrap_v = Wrap::mirror; }},
      {"vertex colour", [](Room& r) { r.surfaces[2].vertex_colours[0].z += 1e-12; }},
      {"vertex colours left out", [](Room& r) { r.surfaces[2].vertex_colours.clear(); }},
      {"limit of vertex colours", [](Room& r) { r.surfaces[2].highest_reflectance = 0.6; }},
      {"map's colours",
       [](Room& r) {
         r.reflectance_maps[0].colours.assign(2, {0.2F, 0.3F, 0.4F});
       }},
      {"emission map left out", [](Room& r) { shape<SurfaceEmitter>(r, 3).emission_map.reset(); }},
      {"place on the emission map", [](Room& r) { shape<SurfaceEmitter>(r, 3).emission_uvs[0].x += 1e-12; }},
      {"emission map's value", [](Room& r) { r.emission_maps[0].values[1] = 0.5F; }},
      {"emitter left out", [](Room& r) { r.emitters.pop_back(); }},
      {"emitter name", [](Room& r) { r.emitters[0].name += "x"; }},
      {"power", [](Room& r) { r.emitters[0].power += 1e-15; }},
      {"place of a point", [](Room& r) { shape<IsotropicEmitter>(r, 0).position.z += 1e-12; }},
      {"place of a Lambert emitter", [](Room& r) { shape<LambertEmitter>(r, 1).position.z += 1e-12; }},
      {"axis of a Lambert emitter", [](Room& r) { shape<LambertEmitter>(r, 1).axis.x += 1e-12; }},
      {"exponent", [](Room& r) { shape<LambertEmitter>(r, 1).exponent += 1e-12; }},
      {"place of a spot", [](Room& r) { shape<SpotEmitter>(r, 2).position.z += 1e-12; }},
      {"axis of a spot", [](Room& r) { shape<SpotEmitter>(r, 2).axis.x += 1e-12; }},
      {"inner cone", [](Room& r) { shape<SpotEmitter>(r, 2).inner += 1e-12; }},
      {"outer cone", [](Room& r) { shape<SpotEmitter>(r, 2).outer += 1e-12; }},
      {"surface that shines", [](Room& r) { shape<SurfaceEmitter>(r, 3).surface = 1; }},
      {"exponent of a surface", [](Room& r) { shape<SurfaceEmitter>(r, 3).exponent += 1e-12; }},
      {"kind of emitter",
       [](Room& r) {
         r.emitters[1].shape = IsotropicEmitter{{0.4, 0.5, 0.5}};
       }},
      {"receiver left out", [](Room& r) { r.receivers.clear(); }},
      {"receiver name", [](Room& r) { r.receivers[0].name += "x"; }},
      {"receiver's place", [](Room& r) { r.receivers[0].position.x += 1e-12; }},
      {"receiver's normal", [](Room& r) { r.receivers[0].normal.x += 1e-12; }},
      {"field of view", [](Room& r) { r.receivers[0].half_angle_deg -= 1e-12; }},
      {"receiver's area", [](Room& r) { r.receivers[0].area_m2 += 1e-12; }},
  };
  return all;
}

}  // namespace

TEST_CASE("everything that results depend on changes a room's fingerprint") {
  const Room room = room_of_everything();
  const Fingerprint whole = fingerprint(room);
  CHECK(fingerprint(room_of_everything()) == whole);
  for (const Change& change : changes()) {
    INFO(change.of);
    Room other = room;
    change.make(other);
    CHECK(fingerprint(other) != whole);
  }
}

TEST_CASE("the source of a room does not change its fingerprint") {
  Room room = room_of_everything();
  const Fingerprint whole = fingerprint(room);
  room.source = "elsewhere/room.glb";
  room.ignored.push_back({"a camera", Effect::none});
  room.overrides.emplace_back("a reflectance was lowered");
  room.surfaces[0].without_area = 3;
  room.reflectance_maps[0].name = "another picture";
  CHECK(fingerprint(room) == whole);
}
