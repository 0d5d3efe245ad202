// glTF extensions for geometry: quantization, texture transforms, instances, compression; and reading options: another
// unit of length, another up axis.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "lichtmc/error.hpp"
#include "lichtmc/gltf.hpp"
#include "support/catch.hpp"
#include "support/compressed_gltf.hpp"
#include "support/gltf_text.hpp"
#include "support/surfaces.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
using nlohmann::json;

namespace {

constexpr double pi = std::numbers::pi;

double distance(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::length(a - b);
}

// Largest distance between the corners of two rooms' triangles, which must be as many and in the same order.
double largest_shift(const Room& a, const Room& b) {
  REQUIRE(a.surfaces.size() == b.surfaces.size());
  double largest = 0.0;
  for (std::size_t k = 0; k < a.surfaces.size(); ++k) {
    const Surface& one = a.surfaces[k];
    const Surface& two = b.surfaces[k];
    REQUIRE(one.triangles.size() == two.triangles.size());
    // Compression may start a list of triangles elsewhere and a triangle at another corner: sets of corners are
    // compared, each with its nearest.
    for (const glm::uvec3& t : one.triangles) {
      for (int c = 0; c < 3; ++c) {
        double nearest = std::numeric_limits<double>::max();
        for (const glm::dvec3& p : two.positions) nearest = std::min(nearest, distance(one.positions[t[c]], p));
        largest = std::max(largest, nearest);
      }
    }
  }
  return largest;
}

Room read_again(const Glb& glb) {
  const TemporaryFolder folder;
  write_glb(glb, folder.path() / "room.glb");
  return read_gltf(folder.path() / "room.glb");
}

std::string refusal_of(const Glb& glb) {
  try {
    read_again(glb);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

Room read_with(const json& document, const ReadOptions& options) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "room.gltf") << document.dump();
  return read_gltf(folder.path() / "room.gltf", options);
}

// A quarter of a square metre with texture coordinates and a base colour texture that is not used.
json textured_triangle(const json& transform) {
  json document = triangle_document();
  json& primitive = document["meshes"][0]["primitives"][0];
  primitive["attributes"]["TEXCOORD_0"] = add_accessor(document, std::vector<float>{0, 0, 0, 1, 1, 0}, "VEC2", 5126, 2);
  document["textures"] = {json::object()};
  document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {
      {"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}};
  document["extensionsUsed"].push_back("KHR_texture_transform");
  return document;
}

}  // namespace

TEST_CASE("quantized positions are read as shares of their range or as they are") {
  json document = triangle_document();
  json& attributes = document["meshes"][0]["primitives"][0]["attributes"];
  document["extensionsUsed"].push_back("KHR_mesh_quantization");
  document["extensionsRequired"] = {"KHR_mesh_quantization"};
  // Padded to 4 and 8 bytes per vertex, as the specification requires.
  const auto strided = [&document](std::size_t accessor, int stride) {
    document["bufferViews"][document["accessors"][accessor]["bufferView"].get<std::size_t>()]["byteStride"] = stride;
    return accessor;
  };
  const std::size_t bytes =
      add_accessor(document, std::vector<std::int8_t>{0, 0, 0, 0, 0, 0, 127, 0, -128, 0, 0, 0}, "VEC3", 5120, 4);
  document["accessors"][bytes]["normalized"] = true;
  attributes["POSITION"] = strided(bytes, 4);
  Room room = read_document(document);
  CHECK(room.surfaces[0].positions[1] == glm::dvec3(0, 0, 1));
  CHECK(room.surfaces[0].positions[2] == glm::dvec3(-1, 0, 0));  // −128 is −1, as −127 is

  const std::size_t shorts =
      add_accessor(document, std::vector<std::uint16_t>{0, 0, 0, 0, 0, 0, 65535, 0, 300, 0, 0, 0}, "VEC3", 5123, 4);
  attributes["POSITION"] = strided(shorts, 8);
  room = read_document(document);
  CHECK(room.surfaces[0].positions[1] == glm::dvec3(0, 0, 65535));
  CHECK(room.surfaces[0].positions[2] == glm::dvec3(300, 0, 0));

  const std::size_t words =
      add_accessor(document, std::vector<std::uint32_t>{0, 0, 0, 0, 0, 1, 1, 0, 0}, "VEC3", 5125, 3);
  attributes["POSITION"] = words;
  CHECK_THAT(refusal(document), ContainsSubstring("neither floats, bytes nor shorts"));
}

TEST_CASE("texture coordinates for the tiles are scaled, then rotated, then moved") {
  const double turn = pi / 6.0;
  const Room room =
      read_document(textured_triangle({{"offset", {0.25, 0.5}}, {"rotation", turn}, {"scale", {0.5, 0.25}}}));
  const Surface& floor = room.surfaces[0];
  // Counter-clockwise about the picture's upper left corner, where v points down.
  const glm::dvec2 of_v(0.25 * std::sin(turn), 0.25 * std::cos(turn));
  const glm::dvec2 of_u(0.5 * std::cos(turn), -0.5 * std::sin(turn));
  const glm::dvec2 offset(0.25, 0.5);
  CHECK(floor.uvs[0] == offset);
  CHECK(glm::length(floor.uvs[1] - (offset + of_v)) < 1e-15);
  CHECK(glm::length(floor.uvs[2] - (offset + of_u)) < 1e-15);
  // A transform of another set does not change this one.
  const Room other = read_document(textured_triangle({{"scale", {0.5, 0.5}}, {"texCoord", 3}}));
  CHECK(other.surfaces[0].uvs[1] == glm::dvec2(0, 1));
  CHECK_THAT(refusal(textured_triangle({{"scale", {0.5}}})), ContainsSubstring("'scale'"));
}

TEST_CASE("quantized texture coordinates with their transform lie from 0 to 1") {
  json document = textured_triangle({{"scale", {1.0 / 4095.0, 1.0 / 4095.0}}});
  document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
      add_accessor(document, std::vector<std::uint16_t>{0, 0, 0, 4095, 4095, 0}, "VEC2", 5123, 2);
  const Room room = read_document(document);
  CHECK(room.surfaces[0].uvs[1] == glm::dvec2(0, 1));
  CHECK(room.surfaces[0].uvs[2] == glm::dvec2(1, 0));
}

TEST_CASE("every instance of a mesh is a surface") {
  json document = triangle_document();
  const std::size_t places = add_accessor(document, std::vector<float>{0, 0, 0, 0, 2, 0, 5, 0, 0}, "VEC3", 5126, 3);
  const auto half = static_cast<float>(std::sqrt(0.5));
  // Not turned; a quarter turn about Y, twice as long as it should be; a half turn about Z, as normalized bytes are not
  // used here.
  const std::size_t turns =
      add_accessor(document, std::vector<float>{0, 0, 0, 1, 0, 2 * half, 0, 2 * half, 0, 0, 1, 0}, "VEC4", 5126, 4);
  const std::size_t scales = add_accessor(document, std::vector<float>{1, 1, 1, 3, 3, 3, -1, 1, 1}, "VEC3", 5126, 3);
  json& extension = document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"];
  extension["attributes"] = {{"TRANSLATION", places}, {"ROTATION", turns}, {"SCALE", scales}};
  const Room room = read_document(document);
  REQUIRE(room.surfaces.size() == 3);
  CHECK(room.surfaces[0].name == "floor");
  CHECK(room.surfaces[1].name == "floor_2");
  CHECK(room.ignored.empty());
  CHECK(room.surfaces[0].positions[2] == glm::dvec3(1, 0, 0));
  CHECK(distance(room.surfaces[1].positions[2], {0, 2, -3}) < 1e-6);
  // Mirrored first, then upside down: x is where it was, the front faces down.
  CHECK(distance(room.surfaces[2].positions[2], {6, 0, 0}) < 1e-6);
  CHECK(distance(first_normal(room.surfaces[2]), {0, -1, 0}) < 1e-6);

  document["accessors"][scales]["count"] = 2;
  CHECK_THAT(refusal(document), ContainsSubstring("do not have as many values") && ContainsSubstring("'floor'"));
  extension["attributes"] = 7;
  CHECK_THAT(refusal(document), ContainsSubstring("have no attributes"));
}

TEST_CASE("a room compressed by meshopt is the same room") {
  const Room room = read_gltf(std::string(LICHTMC_SCENES) + "/living_room.glb");
  const Glb plain = glb_of(room);
  const Room overrides = read_again(with_meshopt(plain));
  CHECK(largest_shift(read_again(plain), overrides) == 0.0);
  CHECK(overrides.emitters.size() == room.emitters.size());
}

TEST_CASE("a room compressed by Draco is the same room except for rounding") {
  const Room room = read_gltf(std::string(LICHTMC_SCENES) + "/living_room.glb");
  const Glb plain = glb_of(room);
  const Room overrides = read_again(with_draco(plain, 16));
  // The largest mesh is about 5 m long: 2¹⁶ steps of 0.08 mm.
  CHECK(largest_shift(read_again(plain), overrides) < 1e-4);
  REQUIRE(overrides.surfaces[0].uvs.empty() == room.surfaces[0].uvs.empty());
  for (std::size_t k = 0; k < room.surfaces.size(); ++k) {
    CHECK(surface_area(overrides.surfaces[k]) == Approx(surface_area(room.surfaces[k])).epsilon(1e-3));
  }
}

TEST_CASE("vertex colours and morph targets of meshes compressed by Draco") {
  Room room = read_document(triangle_document());
  Surface& floor = room.surfaces[0];
  floor.vertex_colours = {{1, 0, 0.5}, {0, 1, 0.25}, {0.5, 0.5, 0}};
  Glb packed = with_draco(glb_of(room), 14);
  const Room again = read_again(packed);
  REQUIRE(again.surfaces[0].vertex_colours.size() == 3);
  CHECK(mean_reflectance(again, again.surfaces[0]) == Approx(mean_reflectance(room, floor)).epsilon(1e-3));
  // Its edge-breaker encoding, the default, changes the order of the vertices: targets would move the wrong ones.
  packed.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}};
  packed.json["meshes"][0]["weights"] = {0};
  CHECK(refusal_of(packed).empty());
  packed.json["meshes"][0]["weights"] = {1};
  CHECK_THAT(refusal_of(packed), ContainsSubstring("morph targets") && ContainsSubstring("without compression"));
}

TEST_CASE("damaged compressed data is refused with its location") {
  const Glb plain = glb_of(read_document(triangle_document()));
  Glb meshopt = with_meshopt(plain);
  meshopt.buffer[0] = 'x';
  CHECK_THAT(refusal_of(meshopt),
             ContainsSubstring("EXT_meshopt_compression of buffer view 0") && ContainsSubstring("damaged"));
  meshopt = with_meshopt(plain);
  meshopt.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["count"] = 1000000000;
  CHECK_THAT(refusal_of(meshopt), ContainsSubstring("more elements than its data can hold"));
  meshopt = with_meshopt(plain);
  meshopt.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["byteLength"] = 2000000000;
  CHECK_THAT(refusal_of(meshopt), ContainsSubstring("reaches beyond its buffer"));
  meshopt = with_meshopt(plain);
  meshopt.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["mode"] = "POINTS";
  CHECK_THAT(refusal_of(meshopt), ContainsSubstring("mode POINTS"));

  Glb draco = with_draco(plain, 14);
  draco.buffer[0] = 'x';
  CHECK_THAT(refusal_of(draco), ContainsSubstring("KHR_draco_mesh_compression of mesh 'floor'") &&
                                    ContainsSubstring("cannot be decompressed"));
  draco = with_draco(plain, 14);
  draco.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"] = 77;
  CHECK_THAT(refusal_of(draco), ContainsSubstring("does not contain its attribute POSITION"));
}

TEST_CASE("a file in centimetres is read in metres, its emissive surfaces with the power of their true area") {
  json document = triangle_document();
  document["materials"][0]["emissiveFactor"] = {1, 1, 1};
  ReadOptions options;
  options.scale = 0.01;
  const Room room = read_with(document, options);
  CHECK(distance(room.surfaces[0].positions[1], {0, 0, 0.01}) < 1e-17);
  CHECK(distance(std::get<IsotropicEmitter>(room.emitters[1].shape).position, {0.002, 0.01, 0.002}) < 1e-9);
  CHECK(room.emitters[1].power == 4.0 * pi * 10.0);                     // a point light's intensity does not change
  CHECK(room.emitters[0].power == Approx(pi * 0.5e-4).epsilon(1e-12));  // 1 cd/m² times π times half a cm²
  REQUIRE(room.overrides.size() == 1);
  CHECK(room.overrides[0] == "Lengths multiplied by 0.01.");
  for (const double wrong : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    options.scale = wrong;
    CHECK_THROWS_AS(read_with(document, options), InputError);
  }
}

TEST_CASE("a file with Z up is rotated to Y up") {
  json document = triangle_document();
  // The triangle in the plane z = 2 of the file, its front towards +Z.
  document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
      add_accessor(document, std::vector<float>{0, 0, 2, 1, 0, 2, 0, 1, 2}, "VEC3", 5126, 3);
  ReadOptions options;
  options.up = UpAxis::z;
  const Room room = read_with(document, options);
  CHECK(room.surfaces[0].positions[0] == glm::dvec3(0, 2, 0));
  CHECK(room.surfaces[0].positions[2] == glm::dvec3(0, 2, -1));
  CHECK(first_normal(room.surfaces[0]) == glm::dvec3(0, 1, 0));
  CHECK(std::get<IsotropicEmitter>(room.emitters[0].shape).position == glm::dvec3(0.2, 0.2, -1));
  CHECK(room.overrides == std::vector<std::string>{"Rotated from Z-up to Y-up."});
}

TEST_CASE("deeply nested JSON is refused before it is parsed") {
  json document = triangle_document();
  document["extras"] = 1;
  std::string text = document.dump();
  const std::string deep = std::string(100000, '[') + std::string(100000, ']');
  text.replace(text.find("\"extras\":1"), 10, "\"extras\":" + deep);
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "deep.gltf") << text;
  CHECK_THROWS_WITH(read_gltf(folder.path() / "deep.gltf"), ContainsSubstring("nested deeper than 256"));
}
