#include <fstream>
#include <iterator>
#include <string>

#include <glm/geometric.hpp>

#include "lichtmc/cuboid.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/gltf.hpp"
#include "support/catch.hpp"
#include "support/gltf_text.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

// A room with everything that can be written; its coordinates are exact in float.
Room full_room() {
  Room room = make_cuboid({2.0, 1.5, 4.0}, {0.3, 0.85, 0.5, 0.5, 0.61, 0.7});
  room.quantity = Quantity::radiometric;
  room.surfaces[2].sides = Sides::both;
  for (const glm::dvec3& axis :
       {glm::dvec3(0, -1, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1), glm::dvec3(0, 0, 1), glm::dvec3(1, -2, 0.5)}) {
    room.emitters.push_back({"beam", 2.5, LambertEmitter{{1, 1, 1}, axis, 7.5}});
  }
  room.emitters.push_back({"bulb", 3.0, IsotropicEmitter{{0.5, 1, 2}}});
  room.emitters.push_back({"spot", 4.0, SpotEmitter{{0.5, 1, 2}, {0, -1, 0.1}, 0.25, 0.5}});
  room.emitters.push_back({"ceiling", 6.0, SurfaceEmitter{1, 2.0}});
  room.receivers.push_back({"eye", {1, 0.75, 1}, {0, 1, 0}, 45.0, 0.01});
  return room;
}

}  // namespace

TEST_CASE("a room written and read again is the same room") {
  const TemporaryFolder folder;
  const Room room = full_room();
  for (const char* name : {"room.glb", "room.gltf"}) {
    const auto file = folder.path() / name;
    write_gltf(room, file);
    const Room overrides = read_gltf(file);
    CHECK(overrides.ignored.empty());
    CHECK(overrides.quantity == room.quantity);
    REQUIRE(overrides.surfaces.size() == room.surfaces.size());
    for (std::size_t k = 0; k < room.surfaces.size(); ++k) {
      CHECK(overrides.surfaces[k].name == room.surfaces[k].name);
      CHECK(overrides.surfaces[k].reflectance == room.surfaces[k].reflectance);
      CHECK(overrides.surfaces[k].sides == room.surfaces[k].sides);
      CHECK(overrides.surfaces[k].positions == room.surfaces[k].positions);
      CHECK(overrides.surfaces[k].uvs == room.surfaces[k].uvs);
      CHECK(overrides.surfaces[k].triangles == room.surfaces[k].triangles);
    }
    // Surfaces come first in the file, so its emissive surface is the first emitter.
    REQUIRE(overrides.emitters.size() == room.emitters.size());
    CHECK(overrides.emitters[0].power == 6.0);
    CHECK(std::get<SurfaceEmitter>(overrides.emitters[0].shape).surface == 1);
    CHECK(std::get<SurfaceEmitter>(overrides.emitters[0].shape).exponent == 2.0);
    for (std::size_t k = 0; k < 5; ++k) {
      const auto& before = std::get<LambertEmitter>(room.emitters[k].shape);
      const auto& after = std::get<LambertEmitter>(overrides.emitters[k + 1].shape);
      CHECK(after.position == before.position);
      CHECK(after.exponent == before.exponent);
      // A quaternion and back: some roundings of numbers up to 1.
      CHECK(glm::length(after.axis - glm::normalize(before.axis)) < 16 * 0x1p-53);
      CHECK(overrides.emitters[k + 1].power == 2.5);
    }
    CHECK(std::get<IsotropicEmitter>(overrides.emitters[6].shape).position == glm::dvec3(0.5, 1, 2));
    CHECK(std::get<SpotEmitter>(overrides.emitters[7].shape).inner == 0.25);
    CHECK(overrides.emitters[7].power == 4.0);
    REQUIRE(overrides.receivers.size() == 1);
    CHECK(overrides.receivers[0].half_angle_deg == 45.0);
    CHECK(glm::length(overrides.receivers[0].normal - glm::dvec3(0, 1, 0)) < 16 * 0x1p-53);
  }
}

TEST_CASE("a room far from the origin is written with an offset, and keeps its shape") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "room.gltf";
  Room room = full_room();
  write_gltf(room, file);
  const auto offset_of = [&] {
    std::ifstream in(file);
    const nlohmann::json written = nlohmann::json::parse(in);
    return written["asset"].value("extras", nlohmann::json());
  };
  CHECK(offset_of().is_null());
  const glm::dvec3 move(691608.25, 520.0, -5334760.4);
  for (Surface& surface : room.surfaces) {
    for (glm::dvec3& p : surface.positions) p += move;
  }
  std::get<IsotropicEmitter>(room.emitters[5].shape).position += move;
  room.receivers[0].position += move;
  write_gltf(room, file);
  CHECK(offset_of()["lichtmc"]["offset_m"] == nlohmann::json({691609.0, 521.0, -5334758.0}));
  const Room again = read_gltf(file);
  for (std::size_t k = 0; k < room.surfaces.size(); ++k) {
    for (std::size_t n = 0; n < room.surfaces[k].positions.size(); ++n)
      CHECK(glm::length(again.surfaces[k].positions[n] - room.surfaces[k].positions[n]) < 1e-6);
  }
  CHECK(glm::length(again.receivers[0].position - room.receivers[0].position) < 1e-6);
}

TEST_CASE("another file extension is refused and no file is written") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(write_gltf(full_room(), folder.path() / "room.obj"), InputError);
  CHECK_THROWS_AS(write_gltf(full_room(), folder.path() / "none" / "room.glb"), RuntimeError);
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("a file is replaced completely") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "room.glb";
  std::ofstream(file) << "old";
  write_gltf(full_room(), file);
  CHECK(read_gltf(file).surfaces.size() == 6);
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
}
