// Extensions that are read, that cannot change the figures, and that may; formats of textures; hidden nodes.
#include <fstream>
#include <string>
#include <vector>

#include <webp/encode.h>

#include "lichtmc/error.hpp"
#include "lichtmc/gltf.hpp"
#include "support/catch.hpp"
#include "support/gltf_text.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
using nlohmann::json;

namespace {

// Whether a room's line that contains a text may change the figures; fails if there is no such line.
bool changes_figures(const Room& room, const std::string& text) {
  for (const Ignored& thing : room.ignored) {
    if (thing.what.find(text) != std::string::npos) return thing.effect == Effect::figures;
  }
  FAIL("no line contains '" << text << "'");
  return false;
}

// The triangle with a second one, hidden or in a hidden group, and with a light, a receiver and a camera below it.
json with_second(const json& visibility) {
  json document = triangle_document();
  document["extensionsUsed"].push_back("KHR_node_visibility");
  const std::size_t second = document["nodes"].size();
  document["nodes"].push_back({{"name", "group"}, {"children", {second + 1}}});
  document["nodes"].push_back({{"name", "plate"}, {"mesh", 0}, {"children", {second + 2, second + 3}}});
  document["nodes"].push_back({{"name", "bulb"}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  document["nodes"].push_back({{"name", "meter"}, {"extras", {{"receiver", {{"area", 1.0}}}}}});
  document["nodes"][second]["extensions"]["KHR_node_visibility"] = visibility;
  document["scenes"][0]["nodes"].push_back(second);
  return document;
}

json textured(const json& texture, const std::string& image) {
  json document = triangle_document();
  document["materials"][0].erase("extras");
  document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
      add_accessor(document, std::vector<float>{0, 0, 0, 1, 1, 0}, "VEC2", 5126, 2);
  document["images"] = {{{"uri", "data:image/webp;base64," + base64_of(image.data(), image.size())}}};
  document["textures"] = {texture};
  document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  return document;
}

// 2 × 1 pixels: red, sRGB 128 of 255.
std::string webp_picture() {
  const std::vector<unsigned char> pixels{255, 0, 0, 128, 128, 128};
  std::uint8_t* bytes = nullptr;
  const std::size_t size = WebPEncodeLosslessRGB(pixels.data(), 2, 1, 6, &bytes);
  std::string file(reinterpret_cast<const char*>(bytes), size);
  WebPFree(bytes);
  return file;
}

}  // namespace

TEST_CASE("hidden nodes and all below them are left out: meshes, lights and receivers") {
  for (const json& visibility : {json{{"visible", false}}, json{{"hidden", true}}}) {
    json document = with_second(visibility);
    const Room room = read_document(document);
    CHECK(room.surfaces.size() == 1);
    CHECK(room.emitters.size() == 1);
    CHECK(room.receivers.empty());
    CHECK(!changes_figures(
        room, "Hidden in the file (KHR_node_visibility) and left out, with the nodes below: node 'group'"));
    document["extensionsRequired"] = {"KHR_node_visibility"};
    CHECK(read_document(document).surfaces.size() == 1);
  }
}

TEST_CASE("visible nodes stay, and a visible node below a hidden one is hidden") {
  for (const json& visibility : {json{{"visible", true}}, json::object()}) {
    const Room room = read_document(with_second(visibility));
    CHECK(room.surfaces.size() == 2);
    CHECK(room.emitters.size() == 2);
    CHECK(room.receivers.size() == 1);
    CHECK(room.ignored.empty());
  }
  json document = with_second({{"visible", false}});
  document["nodes"][3]["extensions"]["KHR_node_visibility"]["visible"] = true;
  CHECK(read_document(document).surfaces.size() == 1);
  CHECK_THAT(refusal(with_second({{"visible", 0}})),
             ContainsSubstring("node 'group'") && ContainsSubstring("true or false"));
}

TEST_CASE("an extension that is not known may change the figures, wherever it is") {
  json document = triangle_document();
  document["extensionsUsed"].push_back("EXT_nobody_knows");
  CHECK(changes_figures(read_document(document), "EXT_nobody_knows (listed in the file"));
  document = triangle_document();
  document["nodes"][0]["extensions"]["EXT_of_node"] = json::object();
  document["materials"][0]["extensions"]["EXT_of_material"] = json::object();
  document["meshes"][0]["primitives"][0]["extensions"]["EXT_of_primitive"] = json::object();
  document["scenes"][0]["extensions"]["EXT_lights_image_based"] = {{"light", 0}};
  const Room room = read_document(document);
  CHECK(changes_figures(room, "EXT_of_node (of node 'floor')"));
  CHECK(changes_figures(room, "EXT_of_material (of material 'paint')"));
  CHECK(changes_figures(room, "EXT_of_primitive (of mesh"));
  CHECK(changes_figures(room, "EXT_lights_image_based (of scene 0)"));
}

TEST_CASE("extensions without influence are named as such, and may be required") {
  for (const char* name : {"KHR_xmp_json_ld", "KHR_materials_variants", "KHR_animation_pointer", "EXT_mesh_features"}) {
    json document = triangle_document();
    document["extensionsUsed"].push_back(name);
    document["extensionsRequired"] = {name};
    CHECK(!changes_figures(read_document(document), std::string("The extension ") + name));
  }
  json document = triangle_document();
  document["nodes"][0]["extras"]["extensions"]["EXT_in_extras"] = 1;  // extras are no extensions
  CHECK(read_document(document).ignored.empty());
}

TEST_CASE("extensions of gloss change the figures where no reflectance is given") {
  struct Case {
    const char* name;
    json values;
    bool changes;
  };
  const std::vector<Case> cases{{"KHR_materials_clearcoat", {{"clearcoatFactor", 1.0}}, true},
                                {"KHR_materials_clearcoat", json::object(), false},
                                {"KHR_materials_sheen", {{"sheenColorFactor", {0.0, 0.5, 0.0}}}, true},
                                {"KHR_materials_iridescence", {{"iridescenceFactor", 0.3}}, true},
                                {"KHR_materials_ior", {{"ior", 1.33}}, false},
                                {"KHR_materials_ior", {{"ior", 0.0}}, true},
                                {"KHR_materials_specular", {{"specularFactor", 0.0}}, false},
                                {"KHR_materials_specular", {{"specularColorFactor", {9.0, 9.0, 9.0}}}, true},
                                {"KHR_materials_anisotropy", {{"anisotropyStrength", 1.0}}, false}};
  for (const Case& one : cases) {
    INFO(one.name << ' ' << one.values.dump());
    json document = triangle_document();
    document["extensionsRequired"] = {one.name};
    document["materials"][0]["extensions"][one.name] = one.values;
    CHECK(!changes_figures(read_document(document), one.name));  // its reflectance is given
    document["materials"][0].erase("extras");
    CHECK(changes_figures(read_document(document), one.name) == one.changes);
  }
}

TEST_CASE("light that passes a material is named; a file that requires it is refused") {
  json document = triangle_document();
  document["materials"][0]["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", 0.9}};
  CHECK(changes_figures(read_document(document), "KHR_materials_transmission"));
  document["extensionsRequired"] = {"KHR_materials_transmission"};
  CHECK_THAT(refusal(document), ContainsSubstring("requires the extension 'KHR_materials_transmission'") &&
                                    ContainsSubstring("material 'paint'"));
  document["materials"][0]["extensions"]["KHR_materials_transmission"] = json::object();
  document.erase("extensionsRequired");
  CHECK(read_document(document).ignored.empty());  // a factor of 0
}

TEST_CASE("an unlit material is named unless its reflectance is given") {
  json document = triangle_document();
  document["materials"][0]["extensions"]["KHR_materials_unlit"] = json::object();
  CHECK(!changes_figures(read_document(document), "KHR_materials_unlit"));
  document["materials"][0].erase("extras");
  CHECK(changes_figures(read_document(document), "KHR_materials_unlit"));
}

TEST_CASE("the diffuse colour of specular-glossiness is the reflectance") {
  json document = triangle_document();
  document["materials"][0].erase("extras");
  document["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {
      {"diffuseFactor", {0.25, 0.25, 0.25, 1.0}}, {"specularFactor", {0.04, 0.04, 0.04}}};
  document["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness"};
  Room room = read_document(document);
  CHECK(room.surfaces[0].reflectance == 0.25);
  CHECK(room.surfaces[0].reflectance_source == ReflectanceSource::base_colour);
  CHECK(!changes_figures(room, "pbrSpecularGlossiness"));
  document["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"].erase("specularFactor");
  CHECK(changes_figures(read_document(document), "pbrSpecularGlossiness"));  // its default is 1, a mirror

  // With a texture.
  document = textured({{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}, webp_picture());
  document["materials"][0].erase("pbrMetallicRoughness");
  document["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {
      {"diffuseFactor", {0.5, 0.5, 0.5, 1.0}}, {"diffuseTexture", {{"index", 0}}}};
  room = read_document(document);
  CHECK(room.reflectance_maps.at(0).values.at(0) == Approx(0.5 * 0.2126));
}

TEST_CASE("WebP textures are read") {
  json document = textured({{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}, webp_picture());
  document["extensionsRequired"] = {"EXT_texture_webp"};
  const Room room = read_document(document);
  const ReflectanceMap& map = room.reflectance_maps.at(0);
  REQUIRE(map.columns == 2);
  REQUIRE(map.rows == 1);
  CHECK(double{map.values[0]} == Approx(0.2126));
  CHECK(double{map.values[1]} == Approx(0.21586050011389926));  // sRGB 128 of 255 (IEC 61966-2-1)
  CHECK(room.ignored.empty());
}

TEST_CASE("damaged and animated WebP images, and those that are too large, are refused") {
  const json texture = {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}};
  std::string file = webp_picture();
  CHECK_THAT(refusal(textured(texture, file.substr(0, file.size() / 2))), ContainsSubstring("WebP image is damaged"));
  // The extended header: flags (bit 1: animation), reserved, width − 1 and height − 1 in 24 bits.
  const auto extended = [](char flags, const std::string& size) {
    const std::string header = std::string("WEBPVP8X\x0A\0\0\0", 12) + flags + std::string(3, '\0') + size;
    const auto length = static_cast<char>(header.size());
    return std::string("RIFF") + length + std::string(3, '\0') + header;
  };
  CHECK_THAT(refusal(textured(texture, extended(2, std::string(6, '\1')))), ContainsSubstring("cannot be read"));
  CHECK_THAT(refusal(textured({{"extensions", {{"EXT_texture_webp", {{"source", 5}}}}}}, file)),
             ContainsSubstring("the image of the base colour texture of material 'paint' is number 5"));
}

TEST_CASE("other formats of textures are refused with the way out, unless the reflectance is given") {
  const std::string ktx2("\xABKTX 20\xBB\r\n\x1A\n", 12);
  for (const char* name : {"KHR_texture_basisu", "MSFT_texture_dds", "EXT_texture_avif"}) {
    INFO(name);
    json document = textured({{"extensions", {{name, {{"source", 0}}}}}}, ktx2);
    document["extensionsRequired"] = {name};
    CHECK_THAT(refusal(document), ContainsSubstring(name) && ContainsSubstring("PNG or JPEG") &&
                                      ContainsSubstring("custom property 'reflectance'"));
    document["materials"][0]["extras"]["reflectance"] = 0.4;
    CHECK(read_document(document).surfaces[0].reflectance == 0.4);
  }
  CHECK_THAT(refusal(textured({{"source", 0}}, ktx2)), ContainsSubstring("it is in the format KTX2"));
}
