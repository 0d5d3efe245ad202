// The same room in other forms: compressed, mirrored, rotated, far away, in another unit. The results are the same.
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/compressed_gltf.hpp"
#include "support/gltf_text.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
using nlohmann::json;

namespace {

// The furnished room of the scenes, as plain glTF.
Glb living_room() {
  return glb_of(read_gltf(std::string(LICHTMC_SCENES) + "/living_room.glb"));
}

Result simulate_glb(const Glb& glb, std::uint64_t seed, const ReadOptions& options = {}) {
  const TemporaryFolder folder;
  write_glb(glb, folder.path() / "room.glb");
  return simulate(read_gltf(folder.path() / "room.glb", options),
                  settings_of(Estimator::collision, Engine::automatic, 4e5, seed, 0.25));
}

// All nodes as children of a node with this transform.
Glb placed(Glb glb, const json& transform) {
  json root = transform;
  root["children"] = glb.json["scenes"][0]["nodes"];
  glb.json["scenes"][0]["nodes"] = {glb.json["nodes"].size()};
  glb.json["nodes"].push_back(root);
  return glb;
}

// Mean irradiances of the surfaces, which have the same names.
std::vector<Compared> surfaces_against(const Result& a, const Result& b) {
  std::vector<Compared> figures;
  for (const SurfaceResult& surface : a.surfaces) {
    const SurfaceResult& other = surface_named(b, surface.name);
    if (surface.hits < 50) continue;
    figures.push_back({surface.mean_irradiance, surface.standard_error, other.mean_irradiance, other.standard_error});
  }
  REQUIRE(figures.size() > 20);
  return figures;
}

void check_same(const char* form, const Result& plain, const Result& other) {
  const Judgement verdict = compare(surfaces_against(plain, other));
  INFO(form << ": " << verdict.text);
  WARN(form << ": " << verdict.text);
  CHECK(verdict.agrees);
  CHECK(other.lost_histories == 0);
  CHECK(other.balance.emitted == Approx(plain.balance.emitted).epsilon(1e-6));
}

}  // namespace

TEST_CASE("the same room: compressed, mirrored, rotated, moved and in centimetres") {
  const Glb room = living_room();
  const Result plain = simulate_glb(room, 81);
  check_same("meshopt", plain, simulate_glb(with_meshopt(room), 82));
  check_same("Draco", plain, simulate_glb(with_draco(room, 16), 83));
  check_same("mirrored", plain, simulate_glb(placed(room, {{"scale", {-1, 1, 1}}}), 84));
  check_same("turned", plain, simulate_glb(placed(room, {{"rotation", {0.2, 0.4, -0.5, 0.7416198487095663}}}), 85));
  check_same("1 km away", plain, simulate_glb(placed(room, {{"translation", {1000, -1000, 1000}}}), 86));
  ReadOptions centimetres;
  centimetres.scale = 0.01;
  check_same("in centimetres", plain, simulate_glb(placed(room, {{"scale", {100, 100, 100}}}), 87, centimetres));
  // With 3 % more power of the emitters the results are not the same.
  Glb brighter = room;
  for (json& node : brighter.json["nodes"]) {
    if (node.contains("extras") && node["extras"].contains("power"))
      node["extras"]["power"] = 1.03 * node["extras"]["power"].get<double>();
  }
  for (json& material : brighter.json["materials"]) {
    if (material.contains("extras") && material["extras"].contains("power"))
      material["extras"]["power"] = 1.03 * material["extras"]["power"].get<double>();
  }
  CHECK_FALSE(compare(surfaces_against(plain, simulate_glb(brighter, 88))).agrees);
}
