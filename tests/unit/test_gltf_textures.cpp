// Base colour textures as reflectance.
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include <stb/stb_image_write.h>

#include "lichtmc/error.hpp"
#include "lichtmc/gltf.hpp"
#include "lichtmc/overrides.hpp"
#include "room/reflectance.hpp"
#include "support/catch.hpp"
#include "support/gltf_text.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
using nlohmann::json;

namespace {

void append(void* text, void* bytes, int count) {
  static_cast<std::string*>(text)->append(static_cast<const char*>(bytes), static_cast<std::size_t>(count));
}

// Red, green / blue, medium grey, as sRGB.
std::string picture() {
  const std::vector<unsigned char> pixels{255, 0, 0, 0, 255, 0, 0, 0, 255, 128, 128, 128};
  std::string png;
  stbi_write_png_to_func(append, &png, 2, 2, 3, pixels.data(), 6);
  return png;
}

// The triangle with an image as base colour, the image in a data URI.
json textured_triangle() {
  json document = triangle_document();
  document["materials"][0].erase("extras");
  document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
      add_accessor(document, std::vector<float>{0, 0, 0, 1, 1, 0}, "VEC2", 5126, 2);
  const std::string png = picture();
  document["images"] = {{{"uri", "data:image/png;base64," + base64_of(png.data(), png.size())}}};
  document["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
  document["textures"] = {{{"source", 0}, {"sampler", 0}}};
  document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  return document;
}

// sRGB 128 of 255 in linear light (IEC 61966-2-1).
constexpr double mid_grey = 0.21586050011389926;

}  // namespace

TEST_CASE("a base colour texture becomes the luminance of its linear colours") {
  const Room room = read_document(textured_triangle());
  REQUIRE(room.reflectance_maps.size() == 1);
  const ReflectanceMap& map = room.reflectance_maps[0];
  REQUIRE(map.columns == 2);
  REQUIRE(map.rows == 2);
  CHECK(map.wrap_u == Wrap::clamp);
  CHECK(map.wrap_v == Wrap::mirror);
  const std::vector<double> expected{0.2126, 0.7152, 0.0722, mid_grey};
  for (std::size_t k = 0; k < 4; ++k) CHECK(double{map.values[k]} == Approx(expected[k]).epsilon(1e-6));
  CHECK(room.surfaces[0].reflectance_map == 0);
  CHECK(room.surfaces[0].reflectance_uvs == std::vector<glm::dvec2>{{0, 0}, {0, 1}, {1, 0}});
  CHECK(room.surfaces[0].reflectance == mean_reflectance(room, room.surfaces[0]));
  CHECK(room.ignored.empty());
}

TEST_CASE("the base colour factor colours the texture") {
  json document = textured_triangle();
  document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.25, 0.0, 1.0};
  const ReflectanceMap map = read_document(document).reflectance_maps.at(0);
  const std::vector<double> expected{0.5 * 0.2126, 0.25 * 0.7152, 0.0, mid_grey * (0.5 * 0.2126 + 0.25 * 0.7152)};
  for (std::size_t k = 0; k < 4; ++k) CHECK(double{map.values[k]} == Approx(expected[k]).epsilon(1e-6).margin(1e-9));
}

TEST_CASE("an image is read from a file with spaces in its name, or from a buffer") {
  json document = textured_triangle();
  document["images"][0]["uri"] = "a%20picture.png";
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "a picture.png", std::ios::binary) << picture();
  std::ofstream(folder.path() / "room.gltf") << document.dump();
  CHECK(read_gltf(folder.path() / "room.gltf").reflectance_maps.size() == 1);

  document = textured_triangle();
  const std::string png = picture();
  const std::size_t bytes = add_accessor(document, std::vector<char>(png.begin(), png.end()), "SCALAR", 5121, 1);
  document["images"][0] = {{"mimeType", "image/png"}, {"bufferView", document["accessors"][bytes]["bufferView"]}};
  CHECK(read_document(document).reflectance_maps.at(0).values.at(1) == Approx(0.7152));
  // A view that is longer than its buffer.
  document["bufferViews"][document["images"][0]["bufferView"].get<std::size_t>()]["byteLength"] = 1000000;
  CHECK_THAT(refusal(document), ContainsSubstring("image 0 reaches beyond its buffer"));
}

TEST_CASE("the reflectance of a material overrides its texture") {
  json document = textured_triangle();
  document["materials"][0]["extras"]["reflectance"] = 0.3;
  document["images"][0]["uri"] = "missing.png";
  const Room room = read_document(document);
  CHECK(room.reflectance_maps.empty());
  CHECK(room.surfaces[0].reflectance == 0.3);
}

TEST_CASE("an image that is missing or cannot be decoded is refused with the material and what to do") {
  json document = textured_triangle();
  document["images"][0]["uri"] = "missing.png";
  CHECK_THAT(refusal(document), ContainsSubstring("missing.png") && ContainsSubstring("material 'paint'") &&
                                    ContainsSubstring("is missing") && ContainsSubstring("--reflectance"));
  document["images"][0]["uri"] = "data:image/png;base64," + base64_of("no picture", 10);
  CHECK_THAT(refusal(document), ContainsSubstring("cannot be read") && ContainsSubstring("PNG or JPEG"));
  document["textures"][0].erase("source");
  CHECK_THAT(refusal(document), ContainsSubstring("no image"));

  // With a reflectance in the extras the image is not needed.
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "room.gltf") << document.dump();
  ReadOptions options;
  options.numbered_materials = {"paint"};
  Room room = read_gltf(folder.path() / "room.gltf", options);
  set_reflectance(room, "paint", 0.6);
  CHECK(room.surfaces[0].reflectance == 0.6);
  CHECK(!room.surfaces[0].reflectance_map);
}

TEST_CASE("a texture without texture coordinates is reported as left out") {
  json document = textured_triangle();
  document["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
  const Room room = read_document(document);
  CHECK(!room.surfaces[0].reflectance_map);
  CHECK(ignores(room, "no texture coordinates (TEXCOORD_0)"));
}

TEST_CASE("a room with textures is written and read back") {
  const Room room = read_document(textured_triangle());
  const TemporaryFolder folder;
  for (const char* name : {"room.glb", "room.gltf"}) {
    write_gltf(room, folder.path() / name);
    const Room overrides = read_gltf(folder.path() / name);
    REQUIRE(overrides.reflectance_maps.size() == 1);
    const ReflectanceMap& map = overrides.reflectance_maps[0];
    CHECK(map.wrap_u == Wrap::clamp);
    CHECK(map.wrap_v == Wrap::mirror);
    // 8 bits of sRGB: at most half a step of 1/255, whose slope in linear light is below 2.3.
    for (std::size_t k = 0; k < 4; ++k)
      CHECK(std::abs(map.values[k] - room.reflectance_maps[0].values[k]) <= 0.5 * 2.3 / 255.0);
    CHECK(overrides.surfaces[0].reflectance_uvs == room.surfaces[0].reflectance_uvs);
    CHECK(overrides.surfaces[0].uvs == room.surfaces[0].uvs);
    CHECK(overrides.ignored.empty());
  }
}
