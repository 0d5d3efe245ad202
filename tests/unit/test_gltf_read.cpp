#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "lichtmc/gltf.hpp"
#include "support/catch.hpp"
#include "support/gltf_text.hpp"
#include "support/surfaces.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
using nlohmann::json;

namespace {

constexpr double pi = std::numbers::pi;

}  // namespace

TEST_CASE("a triangle and a light are read unchanged") {
  const Room room = read_document(triangle_document());
  REQUIRE(room.surfaces.size() == 1);
  const Surface& floor = room.surfaces[0];
  CHECK(floor.name == "floor");
  CHECK(floor.material == "paint");
  CHECK(floor.reflectance == 0.5);
  CHECK(floor.sides == Sides::one);
  CHECK(floor.uvs.empty());
  CHECK(surface_area(floor) == 0.5);
  CHECK(first_normal(floor) == glm::dvec3(0, 1, 0));
  REQUIRE(room.emitters.size() == 1);
  CHECK(room.emitters[0].name == "lamp");
  CHECK(room.emitters[0].power == 4.0 * pi * 10.0);
  CHECK(std::get<IsotropicEmitter>(room.emitters[0].shape).position == glm::dvec3(0.2, 1, 0.2));
  CHECK(room.quantity == Quantity::photometric);
  CHECK(room.ignored.empty());
}

TEST_CASE("transforms accumulate along the hierarchy and scale does not change a light") {
  json document = triangle_document();
  document["nodes"].push_back(
      {{"name", "group"}, {"translation", {1, 2, 3}}, {"scale", {2, 2, 2}}, {"children", {0, 1}}});
  document["scenes"][0]["nodes"] = {2};
  const Room room = read_document(document);
  CHECK(room.surfaces[0].positions[1] == glm::dvec3(1, 2, 5));
  CHECK(surface_area(room.surfaces[0]) == 2.0);
  CHECK(std::get<IsotropicEmitter>(room.emitters[0].shape).position == glm::dvec3(1.4, 4, 3.4));
  CHECK(room.emitters[0].power == 4.0 * pi * 10.0);
}

TEST_CASE("a mirrored node keeps its front side") {
  json document = triangle_document();
  document["nodes"][0]["scale"] = {-1, 1, 1};
  const Room room = read_document(document);
  CHECK(room.surfaces[0].positions[2] == glm::dvec3(-1, 0, 0));
  CHECK(first_normal(room.surfaces[0]) == glm::dvec3(0, 1, 0));
  // Turned upside down by a matrix of determinant 1, the front faces down.
  document = triangle_document();
  document["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1};
  CHECK(first_normal(read_document(document).surfaces[0]) == glm::dvec3(0, -1, 0));
}

TEST_CASE("lists and strips and fans with and without indices give the same front") {
  // A unit square in the plane y = 0, front up.
  const std::vector<float> corners{0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0, 1};  // as a strip
  struct Form {
    int mode;
    std::vector<std::uint8_t> indices;
  };
  for (const Form& form : {Form{5, {}}, Form{5, {0, 1, 2, 3}}, Form{6, {0, 1, 3, 2}}, Form{4, {0, 1, 2, 2, 1, 3}}}) {
    json document = triangle_document();
    json& primitive = document["meshes"][0]["primitives"][0];
    primitive["attributes"]["POSITION"] = add_accessor(document, corners, "VEC3", 5126, 3);
    primitive["mode"] = form.mode;
    if (!form.indices.empty()) primitive["indices"] = add_accessor(document, form.indices, "SCALAR", 5121, 1);
    const Room room = read_document(document);
    REQUIRE(room.surfaces.size() == 1);
    CHECK(room.surfaces[0].triangles.size() == 2);
    CHECK(surface_area(room.surfaces[0]) == 1.0);
    for (const glm::uvec3& t : room.surfaces[0].triangles) {
      const auto& p = room.surfaces[0].positions;
      CHECK(glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]).y == 1.0);
    }
  }
}

TEST_CASE("texture coordinates come from the second set if there is one") {
  json document = triangle_document();
  json& attributes = document["meshes"][0]["primitives"][0]["attributes"];
  attributes["TEXCOORD_0"] = add_accessor(document, std::vector<float>{0, 0, 1, 0, 0, 1}, "VEC2", 5126, 2);
  CHECK(read_document(document).surfaces[0].uvs[1] == glm::dvec2(1, 0));
  const std::size_t second =
      add_accessor(document, std::vector<std::uint16_t>{0, 0, 0, 65535, 32768, 0}, "VEC2", 5123, 2);
  document["accessors"][static_cast<std::size_t>(second)]["normalized"] = true;
  document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = second;
  const Room room = read_document(document);
  CHECK(room.surfaces[0].uvs[1] == glm::dvec2(0, 1));
  CHECK(room.surfaces[0].uvs[2] == glm::dvec2(32768.0 / 65535.0, 0));
}

TEST_CASE("reflectance is that of the extras or the luminance of the base colour") {
  json document = triangle_document();
  json& material = document["materials"][0];
  material.erase("extras");
  material["pbrMetallicRoughness"]["baseColorFactor"] = {1.0, 0.5, 0.25, 1.0};
  // 0.2126 + 0.7152/2 + 0.0722/4, three products and sums of numbers up to 1.
  CHECK(std::abs(read_document(document).surfaces[0].reflectance - 0.58825) < 4 * 0x1p-53);
  material["pbrMetallicRoughness"]["baseColorFactor"] = {0.7, 0.7, 0.7, 1.0};
  CHECK(read_document(document).surfaces[0].reflectance == 0.7);
  material["pbrMetallicRoughness"].erase("baseColorFactor");
  CHECK(read_document(document).surfaces[0].reflectance == 1.0);
  document["meshes"][0]["primitives"][0].erase("material");
  const Room room = read_document(document);
  CHECK(room.surfaces[0].reflectance == 1.0);
  CHECK(room.surfaces[0].material == "(default)");
}

TEST_CASE("a spot has the power of its cones") {
  json document = triangle_document();
  json& light = document["extensions"]["KHR_lights_punctual"]["lights"][0];
  light = {{"type", "spot"}, {"intensity", 100}, {"spot", {{"innerConeAngle", 0.3}, {"outerConeAngle", 0.6}}}};
  document["nodes"][1]["rotation"] = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};  // −Z turned to −Y
  const Room room = read_document(document);
  const auto& spot = std::get<SpotEmitter>(room.emitters[0].shape);
  CHECK(spot.inner == 0.3);
  CHECK(spot.outer == 0.6);
  CHECK(glm::length(spot.axis - glm::dvec3(0, -1, 0)) < 4 * 0x1p-53);
  const double expected = 2.0 * pi * 100.0 * ((1.0 - std::cos(0.3)) + (std::cos(0.3) - std::cos(0.6)) / 3.0);
  CHECK(std::abs(room.emitters[0].power / expected - 1.0) < 1e-14);  // 1 − cos loses two digits in the test's own form
  // A hard edge: full intensity in the whole cone.
  light["spot"] = {{"innerConeAngle", 0.6}, {"outerConeAngle", 0.6}};
  CHECK(read_document(document).emitters[0].power == Approx(2.0 * pi * 100.0 * (1.0 - std::cos(0.6))).epsilon(1e-14));
  light["spot"] = {{"innerConeAngle", 0.7}, {"outerConeAngle", 0.6}};
  CHECK_THAT(refusal(document), ContainsSubstring("cone angles"));
}

TEST_CASE("extras turn a light into a generalized Lambert emitter and set its power") {
  json document = triangle_document();
  document["nodes"][1]["extras"] = {{"lambert_exponent", 5}};
  Room room = read_document(document);
  CHECK(std::get<LambertEmitter>(room.emitters[0].shape).exponent == 5.0);
  CHECK(std::get<LambertEmitter>(room.emitters[0].shape).axis == glm::dvec3(0, 0, -1));
  CHECK(room.emitters[0].power == 4.0 * pi * 10.0);  // the shape changes, the power does not
  document["extensions"]["KHR_lights_punctual"]["lights"][0]["extras"] = {
      {"power", 7}, {"unit", "W"}, {"lambert_exponent", 2}};
  room = read_document(document);
  CHECK(std::get<LambertEmitter>(room.emitters[0].shape).exponent == 5.0);  // the node overrides the light
  CHECK(room.emitters[0].power == 7.0);
  CHECK(room.quantity == Quantity::radiometric);
}

TEST_CASE("a node without a light is an emitter if it has an exponent and a power") {
  json document = triangle_document();
  document["nodes"][1].erase("extensions");
  document["nodes"][1]["extras"] = {{"lambert_exponent", 1}, {"power", 3}};
  CHECK(read_document(document).emitters.at(0).power == 3.0);
  document["nodes"][1]["extras"].erase("power");
  CHECK_THAT(refusal(document), ContainsSubstring("lamp") && ContainsSubstring("power"));
}

TEST_CASE("the exitance of an emissive material is pi times its luminance") {
  json document = triangle_document();
  document["materials"][0]["emissiveFactor"] = {1, 1, 1};
  document["materials"][0]["extensions"] = {{"KHR_materials_emissive_strength", {{"emissiveStrength", 40}}}};
  Room room = read_document(document);
  REQUIRE(room.emitters.size() == 2);
  CHECK(std::get<SurfaceEmitter>(room.emitters[0].shape).surface == 0);
  CHECK(room.emitters[0].power == pi * 40.0 * 0.5);
  CHECK(room.surfaces[0].reflectance == 0.5);
  document["materials"][0]["extras"]["power"] = 12;
  CHECK(read_document(document).emitters[0].power == 12.0);
}

TEST_CASE("receivers face along their node's minus Z") {
  json document = triangle_document();
  document["nodes"].push_back(
      {{"name", "eye"}, {"translation", {0, 1, 0}}, {"extras", {{"receiver", {{"area", 0.01}, {"fov", 60}}}}}});
  document["scenes"][0]["nodes"].push_back(2);
  const Room room = read_document(document);
  REQUIRE(room.receivers.size() == 1);
  CHECK(room.receivers[0].normal == glm::dvec3(0, 0, -1));
  CHECK(room.receivers[0].area_m2 == 0.01);
  CHECK(room.receivers[0].half_angle_deg == 60.0);
  document["nodes"][2]["extras"]["receiver"]["fov"] = 91;
  CHECK_THAT(refusal(document), ContainsSubstring("eye") && ContainsSubstring("91"));
}

TEST_CASE("properties that are not modelled are named") {
  json document = triangle_document();
  document["extensionsUsed"].push_back("KHR_materials_transmission");
  json& material = document["materials"][0];
  material["pbrMetallicRoughness"]["metallicFactor"] = 1;
  material.erase("extras");
  material["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.5, 0.5, 1};
  material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  document["textures"] = {{{"source", 0}}};
  document["images"] = {{{"uri", "missing.png"}}};
  material["alphaMode"] = "BLEND";
  material["extensions"] = {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}};
  document["extensions"]["KHR_lights_punctual"]["lights"][0]["range"] = 5;
  document["extensions"]["KHR_lights_punctual"]["lights"].push_back({{"type", "directional"}});
  document["nodes"].push_back({{"name", "sun"}, {"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}});
  document["scenes"][0]["nodes"].push_back(2);
  document["animations"] = json::array();
  const Room room = read_document(document);
  for (const char* what :
       {"base colour texture", "transparency", "KHR_materials_transmission", "metallic", "range", "sun"}) {
    INFO(what);
    CHECK(ignores(room, what));
  }
  CHECK_FALSE(ignores(room, "Boxes of spaces"));
  material["name"] = "IfcSpace";
  CHECK(ignores(read_document(document), "--without IfcSpace."));
}

TEST_CASE("triangles without area are left out and counted") {
  json document = triangle_document();
  json& primitive = document["meshes"][0]["primitives"][0];
  primitive["attributes"]["POSITION"] =
      add_accessor(document, std::vector<float>{0, 0, 0, 0, 0,    1,    1,    0,    0,    5,    5,    5,    5,   5,
                                                5, 5, 5, 5, 0.1F, 0.1F, 0.1F, 0.3F, 0.3F, 0.3F, 0.7F, 0.7F, 0.7F},
                   "VEC3", 5126, 3);
  const Room room = read_document(document);
  CHECK(room.surfaces[0].triangles.size() == 1);
  CHECK(room.surfaces[0].without_area == 2);
}

TEST_CASE("names are unique and scenes are chosen by name") {
  json document = triangle_document();
  document["nodes"].push_back({{"name", "floor"}, {"mesh", 0}});
  document["scenes"] = json::parse(R"([{"nodes": [0, 1, 2], "name": "day"}, {"nodes": [0], "name": "night"}])");
  Room room = read_document(document);
  CHECK(room.surfaces.at(1).name == "floor_2");
  CHECK(ignores(room, "2 scenes"));
  const TemporaryFolder folder;
  const auto file = folder.path() / "a room.gltf";
  std::ofstream(file) << document.dump();
  ReadOptions options;
  options.scene = "night";
  CHECK(read_gltf(file, options).surfaces.size() == 1);
  options.scene = "dusk";
  CHECK_THROWS_WITH(read_gltf(file, options), ContainsSubstring("dusk") && ContainsSubstring("night"));
}

TEST_CASE("sparse elements replace values") {
  json document = triangle_document();
  const std::size_t indices = add_accessor(document, std::vector<std::uint16_t>{2}, "SCALAR", 5123, 1);
  const std::size_t values = add_accessor(document, std::vector<float>{3, 0, 0}, "VEC3", 5126, 3);
  const int base = document["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
  const auto view = [&](std::size_t n) { return document["accessors"][n]["bufferView"]; };
  const json sparse{{"count", 1},
                    {"indices", {{"bufferView", view(indices)}, {"componentType", 5123}}},
                    {"values", {{"bufferView", view(values)}}}};
  document["accessors"][static_cast<std::size_t>(base)]["sparse"] = sparse;
  CHECK(read_document(document).surfaces[0].positions[2] == glm::dvec3(3, 0, 0));
}

TEST_CASE("accessors that reach beyond their buffer are refused before they are read") {
  const auto with = [](const char* key, const json& value) {
    json document = triangle_document();
    document["accessors"][0][key] = value;
    return refusal(document);
  };
  CHECK_THAT(with("count", 4), ContainsSubstring("beyond its buffer"));
  CHECK_THAT(with("count", std::uint64_t{1} << 62), !ContainsSubstring("std::"));
  CHECK_FALSE(with("count", std::uint64_t{1} << 62).empty());
  CHECK_THAT(with("byteOffset", 4), ContainsSubstring("beyond its buffer"));
  CHECK_FALSE(with("bufferView", 7).empty());
  CHECK_FALSE(with("componentType", 5125).empty());
  CHECK_FALSE(with("type", "VEC2").empty());
  json document = triangle_document();
  document["meshes"][0]["primitives"][0]["indices"] =
      add_accessor(document, std::vector<std::uint16_t>{0, 1, 3}, "SCALAR", 5123, 1);
  CHECK_THAT(refusal(document), ContainsSubstring("triangle") && ContainsSubstring("number 3"));
  document["bufferViews"][0]["byteStride"] = 4;
  CHECK_FALSE(refusal(document).empty());
}

TEST_CASE("positions that are not finite are refused with their vertex") {
  json document = triangle_document();
  document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = add_accessor(
      document, std::vector<float>{0, 0, 0, 0, std::numeric_limits<float>::quiet_NaN(), 1, 1, 0, 0}, "VEC3", 5126, 3);
  CHECK_THAT(refusal(document), ContainsSubstring("number 1 is NaN") && ContainsSubstring("triangle"));
}
