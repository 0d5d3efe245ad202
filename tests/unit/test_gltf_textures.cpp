// Base colour textures as reflectance.
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <stb/stb_image_write.h>

#include "lichtmc/error.hpp"
#include "lichtmc/gltf.hpp"
#include "lichtmc/overrides.hpp"
#include "room/emission.hpp"
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

// The triangle with the image as emissive texture, 100 cd/m² × (½, ½, 0).
json emissive_triangle() {
  json document = textured_triangle();
  json& material = document["materials"][0];
  material["pbrMetallicRoughness"].erase("baseColorTexture");
  material["extras"]["reflectance"] = 0.5;
  material["emissiveFactor"] = {0.5, 0.5, 0.0};
  material["emissiveTexture"] = {{"index", 0}};
  material["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", 100}};
  document["extensionsUsed"].push_back("KHR_materials_emissive_strength");
  return document;
}

constexpr double pi = std::numbers::pi;

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
  options.numbered = {"paint"};
  Room room = read_gltf(folder.path() / "room.gltf", options);
  set_reflectance(room, "paint", 0.6);
  CHECK(room.surfaces[0].reflectance == 0.6);
  CHECK(!room.surfaces[0].reflectance_map);
}

// The decoder names the type of an unknown chunk: one that begins with a zero is an empty text.
TEST_CASE("an image that the decoder refuses without a reason in words is refused") {
  json document = textured_triangle();
  std::string png = picture();
  constexpr std::size_t after_header = 8 + 25;
  png.insert(after_header, std::string("\0\0\0\0\0ABC\0\0\0\0", 12));
  document["images"][0]["uri"] = "data:image/png;base64," + base64_of(png.data(), png.size());
  CHECK_THROWS_AS(read_document(document), InputError);
}

TEST_CASE("an emissive texture gives the flux and the distribution of an area light") {
  json document = emissive_triangle();
  const Room room = read_document(document);
  REQUIRE(room.emitters.size() == 2);
  const auto& shape = std::get<SurfaceEmitter>(room.emitters[0].shape);
  REQUIRE(room.emission_maps.size() == 1);
  CHECK(shape.emission_map == 0);
  CHECK(shape.emission_uvs == std::vector<glm::dvec2>{{0, 0}, {0, 1}, {1, 0}});
  CHECK(room.reflectance_maps.empty());
  const EmissionMap& map = room.emission_maps[0];
  CHECK(double{map.values[1]} == Approx(0.5 * 0.7152));
  // 100 cd/m² × factor × texture, times π, times 0.5 m².
  const double mean = mean_emission(room.surfaces[0], map, shape.emission_uvs);
  CHECK(room.emitters[0].power == Approx(100.0 * mean * pi * 0.5));
  CHECK(room.ignored.empty());
  // With a power the texture gives the distribution only.
  document["materials"][0]["extras"]["power"] = 7;
  CHECK(read_document(document).emitters[0].power == 7.0);
  CHECK(read_document(document).emission_maps.size() == 1);
}

TEST_CASE("an emissive texture of one colour is a uniform area light; where it is black nothing emits") {
  json document = emissive_triangle();
  auto& uvs = document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"];
  // The centre of the green pixel.
  uvs = add_accessor(document, std::vector<float>{0.75, 0.25, 0.75, 0.25, 0.75, 0.25}, "VEC2", 5126, 2);
  const Room room = read_document(document);
  CHECK(room.emission_maps.empty());
  CHECK(room.emitters[0].power == Approx(100.0 * 0.5 * 0.7152 * pi * 0.5));

  document["materials"][0]["emissiveFactor"] = {0, 0, 1};
  CHECK(read_document(document).emitters.size() == 1);
  CHECK(read_document(document).ignored.empty());
  document["materials"][0]["extras"]["power"] = 7;
  CHECK(read_document(document).emitters.size() == 1);
  CHECK(ignores(read_document(document), "emits nothing, although its material has the custom property 'power'"));
  // A black factor hides the texture: the power is uniform.
  document["materials"][0]["emissiveFactor"] = {0, 0, 0};
  CHECK(read_document(document).emitters[0].power == 7.0);
}

TEST_CASE("an emissive texture that is missing is an error, or uniform if the power is given") {
  json document = emissive_triangle();
  document["images"][0]["uri"] = "missing.png";
  CHECK_THAT(refusal(document), ContainsSubstring("missing.png") &&
                                    ContainsSubstring("emissive texture of material 'paint'") &&
                                    ContainsSubstring("custom property 'power'"));
  document["materials"][0]["extras"]["power"] = 7;
  const Room room = read_document(document);
  CHECK(room.emission_maps.empty());
  CHECK(room.emitters[0].power == 7.0);
  CHECK(ignores(room, "uniformly over their area"));
  // Not needed if nothing emits.
  document["materials"][0].erase("extras");
  document["materials"][0]["emissiveFactor"] = {0, 0, 0};
  CHECK(read_document(document).emitters.size() == 1);
}

TEST_CASE("vertex colours multiply a texture channel by channel") {
  json document = textured_triangle();
  document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] =
      add_accessor(document, std::vector<float>{1, 1, 1, 0, 1, 0, 0.5, 0, 0}, "VEC3", 5126, 3);
  const Room room = read_document(document);
  const ReflectanceMap& map = room.reflectance_maps.at(0);
  REQUIRE(map.colours.size() == 4);
  const Surface& surface = room.surfaces[0];
  REQUIRE(surface.vertex_colours.size() == 3);
  // At the centre of the grey pixel with the colour of the second corner: only green is reflected.
  CHECK(coloured_reflectance(surface.vertex_colours[1], &map, {0.75, 0.75}, 1.0) == Approx(mid_grey * 0.7152));
  CHECK(coloured_reflectance(surface.vertex_colours[2], &map, {0.25, 0.25}, 1.0) == Approx(0.5 * 0.2126));
  // Of one colour: part of the factor, without a look-up of colours.
  document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] =
      add_accessor(document, std::vector<float>{0.5, 1, 0, 0.5, 1, 0, 0.5, 1, 0}, "VEC3", 5126, 3);
  const Room plain = read_document(document);
  CHECK(plain.reflectance_maps.at(0).colours.empty());
  CHECK(double{plain.reflectance_maps[0].values[0]} == Approx(0.5 * 0.2126));
}

TEST_CASE("emission maps and vertex colours are written and read back") {
  json document = emissive_triangle();
  document["materials"][0].erase("extras");
  document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] =
      add_accessor(document, std::vector<float>{1, 1, 1, 0, 1, 0, 0.5, 0, 0}, "VEC3", 5126, 3);
  const Room room = read_document(document);
  const TemporaryFolder folder;
  write_gltf(room, folder.path() / "room.glb");
  const Room again = read_gltf(folder.path() / "room.glb");
  CHECK(again.ignored.empty());
  CHECK(again.surfaces[0].vertex_colours == room.surfaces[0].vertex_colours);
  CHECK(again.surfaces[0].reflectance_uvs == room.surfaces[0].reflectance_uvs);
  CHECK(again.surfaces[0].uvs == room.surfaces[0].uvs);
  CHECK(again.surfaces[0].reflectance == Approx(room.surfaces[0].reflectance).epsilon(0.01));
  REQUIRE(again.emission_maps.size() == 1);
  CHECK(again.emitters[0].power == room.emitters[0].power);
  const auto relative = [](const Room& r) {
    return EmissionOfRoom(r).of(std::get<SurfaceEmitter>(r.emitters[0].shape))->relative(0, {0.2, 0.3});
  };
  CHECK(relative(again) == Approx(relative(room)).epsilon(0.01));
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
