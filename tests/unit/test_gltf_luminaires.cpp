// Luminaires of glTF files: EXT_lights_ies, and the custom property 'ies'.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>

#include <sys/stat.h>

#include <glm/geometric.hpp>

#include "base/luminance.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/gltf.hpp"
#include "lichtmc/photometry.hpp"
#include "support/catch.hpp"
#include "support/gltf_text.hpp"
#include "support/luminaires.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

fs::path samples() {
  return fs::path(LICHTMC_TEST_DATA) / "luminaires" / "gltf";
}

const MeasuredEmitter& luminaire_of(const Room& room, std::size_t number = 0) {
  return std::get<MeasuredEmitter>(room.emitters.at(number).shape);
}

// Direct illuminance of a point luminaire on the floor.
double illuminance_at(const Room& room, const glm::dvec3& point) {
  const Emitter& emitter = room.emitters.front();
  const MeasuredEmitter& shape = luminaire_of(room);
  const glm::dvec3 way = point - shape.position;
  const double distance = glm::length(way);
  const glm::dvec3 to = way / distance;
  const glm::dvec3 local(glm::dot(to, shape.c0), glm::dot(to, shape.c90), glm::dot(to, shape.axis));
  return intensity(shape.law(), emitter.power, local) * -to.y / (distance * distance);
}

// A folder with a room of a floor and a node "lamp" at (0, 3, 0) that looks down, and c_skew.ies.
class LampRoom {
 public:
  LampRoom() {
    fs::copy_file(samples() / "c_skew.ies", folder_.path() / "c_skew.ies");
    document = triangle_document();
    document["extensions"].clear();
    document["extensionsUsed"].clear();
    node() = {{"name", "lamp"}, {"translation", {0, 3, 0}}, {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}}};
  }

  json& node() { return document["nodes"][1]; }
  void give_light(const json& light) {
    document["extensionsUsed"] = {"KHR_lights_punctual"};
    document["extensions"]["KHR_lights_punctual"]["lights"] = {light};
    node()["extensions"]["KHR_lights_punctual"] = {{"light", 0}};
  }
  void give_extension(const json& light = {{"uri", "c_skew.ies"}}) {
    document["extensions"]["EXT_lights_ies"]["lights"] = {light};
    node()["extensions"]["EXT_lights_ies"] = {{"light", 0}};
  }

  const fs::path& folder() const { return folder_.path(); }
  Room read(const ReadOptions& options = {}) const {
    std::ofstream(folder() / "room.gltf") << document.dump();
    return read_gltf(folder() / "room.gltf", options);
  }
  std::string refusal() const {
    try {
      read();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  json document;

 private:
  TemporaryFolder folder_;
};

double skew_flux() {
  return read_photometry(samples() / "c_skew.ies").flux();
}

void check_near(const glm::dvec3& found, const glm::dvec3& expected) {
  for (int k = 0; k < 3; ++k) CHECK(std::abs(found[k] - expected[k]) < 1e-12);
}

void check_same_luminaire(const Emitter& a, const Emitter& b) {
  const auto& p = std::get<MeasuredEmitter>(a.shape);
  const auto& q = std::get<MeasuredEmitter>(b.shape);
  CHECK(a.name == b.name);
  CHECK(a.power == b.power);
  CHECK(a.delay_s == b.delay_s);
  check_near(p.position, q.position);
  check_near(p.axis, q.axis);
  check_near(p.c0, q.c0);
  check_near(p.c90, q.c90);
  REQUIRE(p.opening.has_value() == q.opening.has_value());
  if (p.opening) {
    CHECK(p.opening->form == q.opening->form);
    check_near(p.opening->size_m, q.opening->size_m);
  }
  const auto& first = *p.photometry->candela;
  const auto& second = *q.photometry->candela;
  CHECK(first.grid().candela == second.grid().candela);
  CHECK(first.grid().horizontal_deg == second.grid().horizontal_deg);
  CHECK(first.grid().vertical_deg == second.grid().vertical_deg);
  CHECK(first.flux() == second.flux());
}

}  // namespace

TEST_CASE("glTF files with a luminaire give its direct illuminance") {
  // illuminance.tsv, its first row: c_skew.ies downwards; its second: turned by 30 degrees.
  const double row[] = {44.44444, 32.12072, 30.06523, 19.56025, 15.09622, 38.21967, 18.30193, 11.88409, 9.920034};
  const double turned[] = {44.44444, 25.53777, 34.20199, 22.14456, 14.9582, 35.40481, 21.84476, 13.95271, 6.474157};
  const glm::dvec3 points[] = {{0, 0, 0},    {2, 0, 0},     {0, 0, -2},   {-2, 0, 0}, {0, 0, 2},
                               {1.5, 0, -1}, {-1, 0, -2.5}, {-2, 0, 1.5}, {3, 0, 2}};
  const double half = 0.5 * luminance(1.0, 0.5, 0.25);
  const double to_1000_lm = 1000.0 / skew_flux();
  struct Sample {
    const char* file;
    const double* expected;
    double factor;
  };
  for (const Sample& sample :
       {Sample{"ext_uri.gltf", row, 1.0}, Sample{"ext_datauri.gltf", row, 1.0}, Sample{"extras_ies.gltf", row, 1.0},
        Sample{"ext_bufferview_half.gltf", row, half}, Sample{"extras_object.gltf", turned, to_1000_lm}}) {
    INFO(sample.file);
    const Room room = read_gltf(samples() / sample.file);
    REQUIRE(room.emitters.size() == 1);
    CHECK(room.quantity == Quantity::photometric);
    CHECK(room.ignored.empty());
    // Seven digits in the table, a rotation of eight digits in the file.
    for (std::size_t k = 0; k < 9; ++k)
      CHECK(std::abs(illuminance_at(room, points[k]) / (sample.factor * sample.expected[k]) - 1.0) < 1e-6);
  }
}

TEST_CASE("glTF files whose luminaire cannot be read are refused") {
  const auto message = [](const char* file) -> std::string {
    try {
      read_gltf(samples() / file);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK_THAT(message("bad_both.gltf"),
             ContainsSubstring("node 'luminaire': EXT_lights_ies light 0 has both uri and bufferView"));
  CHECK_THAT(message("bad_escape.gltf"), ContainsSubstring("it leads out of the folder"));
  CHECK_THAT(message("bad_index.gltf"),
             ContainsSubstring("node 'luminaire': EXT_lights_ies light 3, but there is 1 profile"));
  CHECK_THAT(message("bad_missing_file.gltf"), ContainsSubstring("the photometric file 'nowhere.ies'"));
  CHECK_THAT(message("bad_missing_file.gltf"), ContainsSubstring("is missing"));
  CHECK_THAT(message("bad_multiplier.gltf"), ContainsSubstring("node 'luminaire': EXT_lights_ies multiplier -1"));
  CHECK_THAT(message("bad_no_mime.gltf"), ContainsSubstring("bufferView without mimeType"));
}

TEST_CASE("a luminaire in place of a light keeps its colour") {
  const double flux = skew_flux();
  LampRoom lamp;
  lamp.give_light({{"type", "spot"},
                   {"intensity", 77},
                   {"range", 2},
                   {"color", {0.5, 0.5, 0.5}},
                   {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}});
  lamp.node()["extras"]["ies"] = "c_skew.ies";
  Room room = lamp.read();
  CHECK(room.emitters.front().power == Approx(0.5 * flux).epsilon(1e-12));
  CHECK(!ignores(room, "range"));

  // The same property at the light, also of a directional one.
  lamp.node()["extras"].clear();
  lamp.give_light({{"type", "directional"}, {"extras", {{"ies", "c_skew.ies"}, {"delay_ns", 2}}}});
  room = lamp.read();
  CHECK(room.emitters.front().power == flux);
  CHECK(room.emitters.front().delay_s == 2e-9);
  CHECK(room.ignored.empty());

  // That of the node precedes, part by part; numbers that scale are one part.
  lamp.give_light(
      {{"type", "point"}, {"extras", {{"ies", {{"file", "c_skew.ies"}, {"lumens", 500}, {"opening", "area"}}}}}});
  lamp.node()["extras"]["ies"] = {{"scale", 0.5}};
  room = lamp.read();
  CHECK(room.emitters.front().power == 0.5 * flux);
  CHECK(luminaire_of(room).opening.has_value());
}

TEST_CASE("'power' and 'unit' scale a luminaire") {
  LampRoom lamp;
  lamp.node()["extras"] = {{"ies", "c_skew.ies"}, {"power", 1234}};
  Room room = lamp.read();
  CHECK(room.emitters.front().power == 1234.0);
  CHECK(room.quantity == Quantity::photometric);
  lamp.node()["extras"]["unit"] = "W";
  room = lamp.read();
  CHECK(room.emitters.front().power == 1234.0);
  CHECK(room.quantity == Quantity::radiometric);
  lamp.node()["extras"]["power"] = 0;
  CHECK(lamp.read().emitters.front().power == 0.0);
  lamp.node()["extras"] = {{"ies", {{"file", "c_skew.ies"}, {"watts", 3}}}};
  room = lamp.read();
  CHECK(room.emitters.front().power == 3.0);
  CHECK(room.quantity == Quantity::radiometric);

  lamp.node()["extras"] = {{"ies", {{"file", "c_skew.ies"}, {"lumens", 3}}}, {"power", 3}};
  CHECK_THAT(lamp.refusal(), ContainsSubstring("both 'power' and 'ies' of node 'lamp' scale its luminaire"));
  lamp.node()["extras"] = {{"ies", "c_skew.ies"}, {"lambert_exponent", 1}};
  CHECK_THAT(lamp.refusal(), ContainsSubstring("node 'lamp' has both a photometric file and 'lambert_exponent'"));
}

TEST_CASE("the extension precedes the custom property, which may give its options") {
  const double flux = skew_flux();
  LampRoom lamp;
  lamp.give_extension();
  lamp.node()["extras"]["ies"] = {{"scale", 0.5}, {"opening", "area"}, {"rotation", 90}};
  lamp.node()["extensions"]["EXT_lights_ies"]["multiplier"] = 0.5;
  Room room = lamp.read();
  CHECK(room.emitters.front().power == 0.25 * flux);
  CHECK(luminaire_of(room).opening->size_m == glm::dvec3(0.6, 0.3, 0.0));
  check_near(luminaire_of(room).c0, {0.0, 0.0, -1.0});
  CHECK(room.ignored.empty());

  lamp.node()["extras"]["ies"] = "other.ies";
  room = lamp.read();
  CHECK(room.emitters.front().power == 0.5 * flux);
  CHECK(ignores(room, "'ies' of node 'lamp' is not read: the file of EXT_lights_ies precedes it"));

  // A light of the node is for programs that do not know the extension.
  lamp.node().erase("extras");
  lamp.give_light({{"type", "point"}, {"color", {0.1, 0.1, 0.1}}});
  CHECK(lamp.read().emitters.size() == 1);
  CHECK(lamp.read().emitters.front().power == 0.5 * flux);

  lamp.node()["extras"]["power"] = 100;
  room = lamp.read();
  CHECK(room.emitters.front().power == 100.0);
  CHECK(ignores(room, "The multiplier of EXT_lights_ies of node 'lamp' does not count"));
}

TEST_CASE("a required EXT_lights_ies is known") {
  LampRoom lamp;
  lamp.give_extension();
  lamp.document["extensionsUsed"] = {"EXT_lights_ies"};
  lamp.document["extensionsRequired"] = {"EXT_lights_ies"};
  CHECK(lamp.read().emitters.size() == 1);
}

TEST_CASE("a luminaire has the directions of its node") {
  LampRoom lamp;
  lamp.give_extension();
  check_near(luminaire_of(lamp.read()).axis, {0.0, -1.0, 0.0});
  check_near(luminaire_of(lamp.read()).c0, {1.0, 0.0, 0.0});
  check_near(luminaire_of(lamp.read()).c90, {0.0, 0.0, -1.0});
  // Scales do not count; a mirrored node mirrors.
  lamp.node()["scale"] = {2, 3, 0.5};
  check_near(luminaire_of(lamp.read()).c90, {0.0, 0.0, -1.0});
  CHECK(lamp.read().ignored.empty());
  lamp.node()["scale"] = {1, -2, 1};
  check_near(luminaire_of(lamp.read()).c0, {1.0, 0.0, 0.0});
  check_near(luminaire_of(lamp.read()).c90, {0.0, 0.0, 1.0});
  lamp.node()["scale"] = {-1, 1, 1};
  check_near(luminaire_of(lamp.read()).c0, {-1.0, 0.0, 0.0});
  check_near(luminaire_of(lamp.read()).c90, {0.0, 0.0, -1.0});
  lamp.node()["scale"] = {-1, -1, -1};
  check_near(luminaire_of(lamp.read()).axis, {0.0, 1.0, 0.0});
  check_near(luminaire_of(lamp.read()).c90, {0.0, 0.0, 1.0});
  CHECK(lamp.read().ignored.empty());
  // Sheared by a parent: the aim is kept, C0 turned to it.
  lamp.node() = {{"name", "lamp"},
                 {"extensions", lamp.node()["extensions"]},
                 {"matrix", {1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 3, 0, 1}}};
  Room room = lamp.read();
  check_near(luminaire_of(room).axis, {0.0, 0.0, -1.0});
  check_near(luminaire_of(room).c0, {1.0, 0.0, 0.0});
  check_near(luminaire_of(room).c90, {0.0, 1.0, 0.0});
  CHECK(ignores(room, "The axes of node 'lamp' are not at right angles"));
  // Z-up files, and other units: a luminaire has its own sizes in metres.
  ReadOptions options;
  options.scale = 0.01;
  lamp.node()["extras"]["ies"]["opening"] = "area";
  room = lamp.read(options);
  check_near(luminaire_of(room).position, {0.0, 0.03, 0.0});
  CHECK(luminaire_of(room).opening->size_m == glm::dvec3(0.6, 0.3, 0.0));
}

TEST_CASE("a photometric file is read once for all nodes") {
  LampRoom lamp;
  lamp.give_extension();
  std::ofstream(lamp.folder() / "tilt.ies") << "IESNA:LM-63-2002\nTILT=INCLUDE\n1\n2\n0 90\n1 0.5\n"
                                            << "1 -1 1 3 1 1 2 0 0 0\n1 1 10\n0 45 90\n0\n100 80 0\n";
  for (int k = 0; k < 3; ++k) {
    json copy = lamp.node();
    if (k > 0) {
      copy.erase("extensions");
      copy["extras"]["ies"] = "tilt.ies";
    }
    lamp.document["nodes"].push_back(copy);
    lamp.document["scenes"][0]["nodes"].push_back(2 + k);
  }
  const Room room = lamp.read();
  REQUIRE(room.emitters.size() == 4);
  CHECK(luminaire_of(room, 0).photometry == luminaire_of(room, 1).photometry);
  CHECK(luminaire_of(room, 2).photometry == luminaire_of(room, 3).photometry);
  CHECK(luminaire_of(room, 0).photometry != luminaire_of(room, 2).photometry);
  std::size_t warnings = 0;
  for (const Ignored& one : room.ignored) {
    if (one.what.find("TILT") == std::string::npos) continue;
    ++warnings;
    CHECK(one.effect == Effect::figures);
    CHECK_THAT(one.what, ContainsSubstring("Photometric file 'tilt.ies': "));
  }
  CHECK(warnings == 1);
}

TEST_CASE("photometric files are confined to the folder of the room") {
  LampRoom lamp;
  const auto refusal_of = [&lamp](const std::string& name) {
    lamp.node()["extras"]["ies"] = name;
    return lamp.refusal();
  };
  fs::create_directory(lamp.folder() / "sub");
  fs::copy_file(samples() / "c_skew.ies", lamp.folder() / "sub" / "a 100%41.ies");
  CHECK(refusal_of("sub/a 100%41.ies").empty());  // a name, not a URI
  lamp.node().erase("extras");
  lamp.give_extension({{"uri", "sub/a%20100%2541.ies"}});
  CHECK(lamp.refusal().empty());
  lamp.node().erase("extensions");

  CHECK_THAT(refusal_of("../c_skew.ies"), ContainsSubstring("it leads out of the folder"));
  CHECK_THAT(refusal_of("/etc/hostname"), ContainsSubstring("it is an absolute path"));
  CHECK_THAT(refusal_of("http://x/y.ies"), ContainsSubstring("it has the scheme 'http:'"));
  CHECK_THAT(refusal_of("nowhere.ies"), ContainsSubstring("'nowhere.ies' in 'ies' of node 'lamp' is missing"));
  CHECK_THAT(refusal_of("sub"), ContainsSubstring("cannot be read"));
  CHECK_THAT(refusal_of(""), ContainsSubstring("'ies' of node 'lamp' is empty"));
  REQUIRE(::mkfifo((lamp.folder() / "pipe.ies").c_str(), 0600) == 0);
  CHECK_THAT(refusal_of("pipe.ies"), ContainsSubstring("cannot be read"));

  const TemporaryFolder elsewhere;
  fs::copy_file(samples() / "c_skew.ies", elsewhere.path() / "out.ies");
  fs::create_symlink(elsewhere.path() / "out.ies", lamp.folder() / "link.ies");
  CHECK_THAT(refusal_of("link.ies"), ContainsSubstring("symbolic link that leads out of the folder"));
  ReadOptions options;
  options.follow_links = true;
  CHECK(lamp.read(options).emitters.size() == 1);
}

TEST_CASE("faults of the custom property 'ies' are named") {
  LampRoom lamp;
  const auto refusal_of = [&lamp](const json& value) {
    lamp.node()["extras"]["ies"] = value;
    return lamp.refusal();
  };
  const auto with = [](const char* part, const json& value) { return json{{"file", "c_skew.ies"}, {part, value}}; };
  CHECK_THAT(refusal_of(5), ContainsSubstring("'ies' of node 'lamp' is neither a text nor an object"));
  CHECK_THAT(refusal_of(nullptr), ContainsSubstring("'ies' of node 'lamp' has no value"));
  CHECK_THAT(refusal_of(json::object()), ContainsSubstring("names no photometric file"));
  CHECK_THAT(refusal_of(with("lumens", 0)),
             ContainsSubstring("'lumens' in 'ies' of node 'lamp' is 0 (allowed: a finite number above 0)"));
  CHECK_THAT(refusal_of(with("scale", -1)), ContainsSubstring("'scale' in 'ies' of node 'lamp' is -1"));
  CHECK_THAT(refusal_of(with("rotation", "30")), ContainsSubstring("is not a number"));
  CHECK_THAT(refusal_of(with("lampset", 1.5)), ContainsSubstring("is 1.5 (allowed: a whole number"));
  CHECK_THAT(refusal_of(with("opening", "disc")), ContainsSubstring("is 'disc' (allowed: \"point\" or \"area\")"));
  CHECK_THAT(refusal_of(with("flipH", 1)), ContainsSubstring("is not a truth value"));
  CHECK_THAT(refusal_of({{"file", "c_skew.ies"}, {"lumens", 1}, {"watts", 1}}),
             ContainsSubstring("scales the luminaire more than once"));
  lamp.node()["extras"]["ies"] = with("lumen", 100);
  CHECK(ignores(lamp.read(), "'lumen' in the custom property 'ies' of node 'lamp' is not read"));
  lamp.node()["extras"]["ies"] = with("flipH", true);
  CHECK(luminaire_of(lamp.read()).photometry != nullptr);
}

TEST_CASE("other names and places of the custom property 'ies' are told") {
  LampRoom lamp;
  lamp.give_light({{"type", "point"}});
  for (const char* name : {"IES", "ldt", "photometry", "ies_file"}) {
    INFO(name);
    lamp.node()["extras"] = {{name, "c_skew.ies"}};
    CHECK(ignores(lamp.read(),
                  "The custom property '" + std::string(name) + "' of node 'lamp' is not read: the name is 'ies'"));
  }
  lamp.node()["extras"] = {{"ids", 5}, {"photometry", "none"}};
  CHECK(lamp.read().ignored.empty());
  lamp.node().erase("extras");
  lamp.document["materials"][0]["extras"]["ies"] = "c_skew.ies";
  CHECK(ignores(lamp.read(), "The custom property 'ies' of material 'paint' is not read: it does not belong there."));
}

TEST_CASE("a EULUMDAT file in EXT_lights_ies is read and told") {
  LampRoom lamp;
  fs::copy_file(fs::path(LICHTMC_TEST_DATA) / "luminaires" / "c_ldt_abs.ldt", lamp.folder() / "a.ldt");
  lamp.give_extension({{"uri", "a.ldt"}});
  const Room room = lamp.read();
  CHECK(room.emitters.size() == 1);
  CHECK(ignores(room, "Photometric file 'a.ldt' is a EULUMDAT file: EXT_lights_ies defines IES LM-63 files only"));
}

TEST_CASE("luminaires are written and read back") {
  const auto skew = std::make_shared<const Photometry>(*skew_luminaire());
  Photometry other = *skew;
  other.source = "other.ies";
  CandelaTable::Grid grid = skew->candela->grid();
  grid.candela[20] += 1.0;
  other.candela = std::make_shared<const CandelaTable>(std::move(grid));
  const auto second = std::make_shared<const Photometry>(std::move(other));

  Room room = read_document(triangle_document());
  room.emitters.clear();
  room.ignored.clear();
  const auto add = [&room](const char* name, const std::shared_ptr<const Photometry>& file, const LuminaireAxes& axes,
                           const LuminaireOptions& options) {
    LuminaireEmitter mounted = mount(file, {0.1, 2.0, 0.3}, axes, options, "test");
    room.emitters.push_back({name, mounted.power, std::move(mounted.shape)});
  };
  LuminaireAxes mirrored = axes_towards({0.3, -1.0, 0.2});
  mirrored.c90 = -mirrored.c90;
  LuminaireOptions options;
  add("a", skew, axes_towards({0.3, -1.0, 0.2}), options);
  options.rotation_deg = 33.0;
  options.scale = 1.0 / 3.0;
  add("b", skew, mirrored, options);
  options.area = true;
  add("c", second, axes_towards({0.0, 1.0, 0.0}), options);
  room.emitters.back().delay_s = 3e-9;
  room.emitters.front().power = 0.0;

  const TemporaryFolder folder;
  for (const char* name : {"room.glb", "room.gltf"}) {
    INFO(name);
    const fs::path file = folder.path() / name;
    write_gltf(room, file);
    const Room back = read_gltf(file);
    for (const Ignored& one : back.ignored) FAIL_CHECK(one.what);
    REQUIRE(back.emitters.size() == 3);
    for (std::size_t k = 0; k < 3; ++k) check_same_luminaire(room.emitters[k], back.emitters[k]);
    CHECK(luminaire_of(back, 0).photometry == luminaire_of(back, 1).photometry);
    CHECK(luminaire_of(back, 0).photometry->source == "skew.ies");
    CHECK(luminaire_of(back, 2).photometry->source == "other.ies");
  }
  std::ifstream written(folder.path() / "room.gltf");
  const json document = json::parse(written);
  CHECK(document["extensions"]["EXT_lights_ies"]["lights"].size() == 2);

  // Radiant flux.
  room.quantity = Quantity::radiometric;
  for (Emitter& emitter : room.emitters) emitter.power = 0.5;
  write_gltf(room, folder.path() / "watts.glb");
  const Room back = read_gltf(folder.path() / "watts.glb");
  CHECK(back.quantity == Quantity::radiometric);
  for (std::size_t k = 0; k < 3; ++k) check_same_luminaire(room.emitters[k], back.emitters[k]);
}
