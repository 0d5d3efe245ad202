// Morph targets, skins and vertex colours of glTF meshes.
#include <cmath>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/gltf_text.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
using nlohmann::json;

namespace {

constexpr int floats = 5126;
constexpr int bytes = 5121;
constexpr int shorts = 5123;

json& primitive_of(json& document) {
  return document["meshes"][0]["primitives"][0];
}

// The triangle with two targets: one lifts it by 1 m, one moves its first corner along x (sparse).
json morphing_triangle() {
  json document = triangle_document();
  const std::size_t lift = add_accessor(document, std::vector<float>{0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3", floats, 3);
  const std::size_t index = add_accessor(document, std::vector<std::uint16_t>{0, 0}, "SCALAR", shorts, 1);
  const std::size_t move = add_accessor(document, std::vector<float>{-1, 0, 0}, "VEC3", floats, 3);
  document["accessors"].push_back(
      {{"componentType", floats},
       {"count", 3},
       {"type", "VEC3"},
       {"sparse",
        {{"count", 1},
         {"indices", {{"bufferView", document["accessors"][index]["bufferView"]}, {"componentType", shorts}}},
         {"values", {{"bufferView", document["accessors"][move]["bufferView"]}}}}}});
  primitive_of(document)["targets"] = {{{"POSITION", lift}}, {{"POSITION", document["accessors"].size() - 1}}};
  return document;
}

// The triangle with a skin of two joints; the node itself is 100 m below.
json skinned_triangle(const std::vector<float>& weights = {1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0}) {
  json document = triangle_document();
  primitive_of(document)["attributes"]["JOINTS_0"] =
      add_accessor(document, std::vector<std::uint8_t>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4", bytes, 4);
  primitive_of(document)["attributes"]["WEIGHTS_0"] = add_accessor(document, weights, "VEC4", floats, 4);
  // The first joint rests at x = 2, the second at x = 3.
  const std::vector<float> inverse{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -2, 0, 0, 1,
                                   1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -3, 0, 0, 1};
  document["skins"] = {
      {{"joints", {2, 3}}, {"inverseBindMatrices", add_accessor(document, inverse, "MAT4", floats, 16)}}};
  document["nodes"][0]["skin"] = 0;
  document["nodes"][0]["translation"] = {0, -100, 0};
  document["nodes"].push_back({{"name", "first"}, {"translation", {2, 0, 0}}});
  document["nodes"].push_back({{"name", "second"}, {"translation", {3, 0, 0}}});
  document["scenes"][0]["nodes"] = {0, 1, 2, 3};
  return document;
}

glm::dvec3 corner(const Room& room, std::size_t k) {
  return room.surfaces.at(0).positions.at(k);
}

json coloured_triangle() {
  json document = triangle_document();
  document["materials"][0].erase("extras");
  primitive_of(document)["attributes"]["COLOR_0"] =
      add_accessor(document, std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3", floats, 3);
  return document;
}

}  // namespace

TEST_CASE("morph targets move the positions by the weights of the mesh, or of the node if it has some") {
  json document = morphing_triangle();
  CHECK(corner(read_document(document), 0) == glm::dvec3(0, 0, 0));
  document["meshes"][0]["weights"] = {0.5, 0.25};
  CHECK(corner(read_document(document), 0) == glm::dvec3(-0.25, 0.5, 0));
  CHECK(corner(read_document(document), 2) == glm::dvec3(1, 0.5, 0));
  document["nodes"][0]["weights"] = {1, 0};
  CHECK(corner(read_document(document), 0) == glm::dvec3(0, 1, 0));
  CHECK(read_document(document).ignored.empty());
  document["nodes"][0]["weights"] = {0, 0};
  CHECK(corner(read_document(document), 0) == glm::dvec3(0, 0, 0));
  CHECK(read_document(document).ignored.empty());
}

TEST_CASE("displaced colours are named only if their target has a weight") {
  json document = morphing_triangle();
  primitive_of(document)["targets"][0]["COLOR_0"] = 0;
  CHECK(read_document(document).ignored.empty());
  document["meshes"][0]["weights"] = {1, 0};
  CHECK(ignores(read_document(document), "COLOR_0 in morph target 0"));
}

TEST_CASE("damaged morph targets are refused") {
  json document = morphing_triangle();
  document["meshes"][0]["weights"] = {1};
  CHECK_THAT(refusal(document), ContainsSubstring("2 morph targets but 1 weight "));
  document["meshes"][0]["weights"] = {1, 1};
  primitive_of(document)["targets"][1]["POSITION"] =
      add_accessor(document, std::vector<float>{0, 0, 0}, "VEC3", floats, 3);
  CHECK_THAT(refusal(document), ContainsSubstring("1 displacements for 3 positions"));
}

TEST_CASE("the node of a skinned mesh does not move it") {
  const Room room = read_document(skinned_triangle());
  CHECK(corner(room, 0) == glm::dvec3(0, 0, 0));
  CHECK(corner(room, 2) == glm::dvec3(1, 0, 0));
  CHECK(room.ignored.empty());
}

TEST_CASE("joints move the vertices by their weights, also of morphed meshes") {
  json document = skinned_triangle();
  document["nodes"][3]["translation"] = {3, 2, 0};
  CHECK(corner(read_document(document), 1) == glm::dvec3(0, 0, 1));
  CHECK(corner(read_document(document), 2) == glm::dvec3(1, 1, 0));
  // The joint scales about its rest place: x = 2 + 3 · (x − 2).
  document["nodes"][2]["scale"] = {3, 3, 3};
  CHECK(corner(read_document(document), 0) == glm::dvec3(-4, 0, 0));
  const std::size_t lift = add_accessor(document, std::vector<float>{0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3", floats, 3);
  primitive_of(document)["targets"] = {{{"POSITION", lift}}};
  document["meshes"][0]["weights"] = {1};
  CHECK(corner(read_document(document), 0) == glm::dvec3(-4, 3, 0));
}

TEST_CASE("a joint that mirrors reverses the triangles: the front stays the front") {
  json document = skinned_triangle({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  const Room plain = read_document(document);
  document["nodes"][2]["scale"] = {-1, 1, 1};
  const Room mirrored = read_document(document);
  CHECK(mirrored.surfaces[0].triangles[0].y == plain.surfaces[0].triangles[0].z);
}

TEST_CASE("damaged skins are refused") {
  json document = skinned_triangle();
  document["scenes"][0]["nodes"] = {0, 1, 2};
  CHECK_THAT(refusal(document),
             ContainsSubstring("node 'second', a joint of skin") && ContainsSubstring("not in the scene"));
  CHECK_THAT(refusal(skinned_triangle({1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0, 0, 0})), ContainsSubstring("add up to 0.5"));
  document = skinned_triangle();
  document["skins"][0]["joints"] = {2};
  CHECK_THAT(refusal(document), ContainsSubstring("refers to joint 1"));
  document = skinned_triangle();
  primitive_of(document)["attributes"].erase("WEIGHTS_0");
  CHECK(ignores(read_document(document), "no joints and weights"));
  CHECK(corner(read_document(document), 0).y == -100.0);
}

TEST_CASE("vertex colours multiply the base colour") {
  json document = coloured_triangle();
  document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.5, 0.5, 1};
  const Room room = read_document(document);
  const Surface& surface = room.surfaces[0];
  REQUIRE(surface.vertex_colours.size() == 3);
  CHECK(surface.vertex_colours[1] == glm::dvec3(0, 0.5, 0));
  // The mean of the corners' luminances: ρ is linear.
  CHECK(surface.reflectance == Approx(0.5 / 3.0));
  CHECK(surface.reflectance_source == ReflectanceSource::vertex_colours);
  CHECK(room.ignored.empty());
}

TEST_CASE("vertex colours of one value are a plain reflectance, in all types") {
  json document = coloured_triangle();
  const auto use = [&](std::size_t accessor, bool normalized) {
    if (normalized) document["accessors"][accessor]["normalized"] = true;
    primitive_of(document)["attributes"]["COLOR_0"] = accessor;
    const Room room = read_document(document);
    CHECK(room.surfaces[0].vertex_colours.empty());
    return room.surfaces[0].reflectance;
  };
  const std::vector<float> half(12, 0.5F);
  CHECK(use(add_accessor(document, half, "VEC4", floats, 4), false) == 0.5);
  const std::vector<std::uint8_t> fifth(12, 51);
  CHECK(use(add_accessor(document, fifth, "VEC4", bytes, 4), true) == Approx(0.2));
  const std::vector<std::uint16_t> third(12, 21845);
  CHECK(use(add_accessor(document, third, "VEC4", shorts, 4), true) == Approx(1.0 / 3.0));
  // Limited to 0 … 1 (glTF 2.0 specification, section 3.7.2.1).
  CHECK(use(add_accessor(document, std::vector<float>(12, 7.0F), "VEC4", floats, 4), false) == 1.0);
}

TEST_CASE("the property 'reflectance' replaces vertex colours; damaged ones are refused") {
  json document = coloured_triangle();
  document["materials"][0]["extras"]["reflectance"] = 0.25;
  CHECK(read_document(document).surfaces[0].vertex_colours.empty());
  CHECK(read_document(document).surfaces[0].reflectance == 0.25);
  document["materials"][0].erase("extras");
  const std::vector<std::uint8_t> plain(12, 51);
  primitive_of(document)["attributes"]["COLOR_0"] = add_accessor(document, plain, "VEC4", bytes, 4);
  CHECK_THAT(refusal(document), ContainsSubstring("normalized") && ContainsSubstring("--reflectance"));
  primitive_of(document)["attributes"]["COLOR_0"] =
      add_accessor(document, std::vector<float>{1, 1, 1}, "VEC3", floats, 3);
  CHECK_THAT(refusal(document), ContainsSubstring("3 positions but 1 vertex colours"));
}

TEST_CASE("positions that are floats far from their node's origin are reported with their rounding") {
  json document = triangle_document();
  document["nodes"][0]["translation"] = {692000, 520, -5334760};
  CHECK(read_document(document).ignored.empty());
  const float far = 5334760.0F;
  primitive_of(document)["attributes"]["POSITION"] =
      add_accessor(document, std::vector<float>{0, 0, far, 0, 0, far + 2, 3, 0, far}, "VEC3", floats, 3);
  CHECK(ignores(read_document(document), "'floor' are floats so far from the origin of their nodes"));
  CHECK(ignores(read_document(document), "multiples of up to 0.5 m"));
}
