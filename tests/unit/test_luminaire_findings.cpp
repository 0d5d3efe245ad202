// What `check` says of luminaires with photometric files.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "lichtmc/lichtmc.hpp"
#include "lichtmc/photometry.hpp"
#include "support/catch.hpp"
#include "support/luminaires.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

const Finding* find(const Inspection& facts, const std::string& topic, Severity severity) {
  const auto found = std::find_if(facts.findings.begin(), facts.findings.end(), [&](const Finding& finding) {
    return finding.topic == topic && finding.severity == severity;
  });
  return found == facts.findings.end() ? nullptr : &*found;
}

// I = 100 cd · cos γ in steps of 1 degree, with `up` cd in all directions above it.
std::shared_ptr<Photometry> lambert_luminaire(const LuminousOpening& opening, double up = 0.0) {
  CandelaTable::Grid grid;
  grid.horizontal_deg = {0.0};
  for (int g = 0; g <= 180; ++g) {
    grid.vertical_deg.push_back(g);
    grid.candela.push_back(g < 90 ? 100.0 * std::cos(g * std::numbers::pi / 180.0) : up);
  }
  auto photometry = std::make_shared<Photometry>(*skew_luminaire());
  photometry->source = "folder/flat.ies";
  photometry->candela = std::make_shared<const CandelaTable>(std::move(grid));
  photometry->opening = opening;
  return photometry;
}

Room office_with(const std::shared_ptr<const Photometry>& file, double height, bool area) {
  Room room = make_cuboid({5.0, 2.8, 4.0}, uniform_reflectance(0.5));
  room.source = "office";
  LuminaireOptions options;
  options.area = area;
  LuminaireEmitter mounted = mount(file, {2.5, height, 2.0}, LuminaireAxes{}, options, "test");
  room.emitters.push_back({"lamp", mounted.power, std::move(mounted.shape)});
  return room;
}

Receiver receiver_at(const glm::dvec3& position) {
  Receiver receiver;
  receiver.name = "desk";
  receiver.position = position;
  return receiver;
}

// A plate that looks up, `edge` long, below the luminaire.
void add_plate(Room& room, double height, double edge) {
  Surface plate;
  plate.name = "plate";
  plate.reflectance = 0.5;
  const double e = 0.5 * edge;
  plate.positions = {
      {2.5 - e, height, 2.0 - e}, {2.5 + e, height, 2.0 - e}, {2.5 - e, height, 2.0 + e}, {2.5 + e, height, 2.0 + e}};
  plate.triangles = {{0, 2, 1}, {1, 2, 3}};
  room.surfaces.push_back(std::move(plate));
}

const LuminousOpening disc{OpeningForm::ellipse, {0.6, 0.6, 0.0}};

}  // namespace

TEST_CASE("check tells the photometric files, and the side along which C0 lies") {
  const Inspection facts = inspect(office_with(skew_luminaire(), 2.5, true));
  const Finding* note = find(facts, "luminaires", Severity::note);
  REQUIRE(note != nullptr);
  CHECK_THAT(note->text, ContainsSubstring("1 luminaire with the photometric file 'skew.ies' (LM-63-2002)"));
  CHECK_THAT(note->text,
             ContainsSubstring("0.6 m long towards C0 and 0.3 m towards C90: C0 lies along its longer side"));
  CHECK_THAT(note->text, ContainsSubstring("input 50 W each"));
  CHECK_THAT(note->advice, ContainsSubstring("files are never turned"));
}

TEST_CASE("luminaires that share a file are told together") {
  const auto skew = skew_luminaire();
  Room room = office_with(skew, 2.5, true);
  room.emitters.push_back(room.emitters.front());
  room.emitters.back().name = "lamp_2";
  const Inspection facts = inspect(room);
  REQUIRE(facts.luminaires.size() == 1);
  CHECK(facts.luminaires.front().count == 2);
  CHECK(facts.luminaires.front().as_points == 0);
  CHECK(facts.luminaires.front().power == 2.0 * skew->flux());
}

TEST_CASE("a luminaire taken for a point near what it lights is a warning, with how much that matters") {
  Room room = office_with(lambert_luminaire(disc), 2.5, false);
  room.receivers = {receiver_at({2.5, 1.5, 2.0}), receiver_at({4.9, 0.0, 3.9})};
  Inspection facts = inspect(room);
  const Finding* warning = find(facts, "luminaire-size", Severity::warning);
  REQUIRE(warning != nullptr);
  CHECK_THAT(warning->text, ContainsSubstring("photometric file 'flat.ies' is taken for a point"));
  CHECK_THAT(warning->text, ContainsSubstring("At receiver 'desk', 1 m from it, its direct light is"));
  CHECK_THAT(warning->advice, ContainsSubstring(":area"));
  // On the axis of a Lambertian disc of radius R at the distance d, the light of a point is 1 + (R/d)² times that of
  // the disc. The table has cosines in steps of 1 degree, linear between them: 4·10⁻⁵ too low; the midpoints err by
  // less than (R/d)²/32².
  const LuminaireFacts& disc_facts = facts.luminaires.front();
  CHECK(std::abs(disc_facts.excess_there - 0.09) < 2e-4);
  CHECK(disc_facts.nearest_m == 1.0);
  CHECK(disc_facts.limit_m == 3.0);
  // At 2.5 m below, the point gives 1.4 % too much; elsewhere on the floor and walls it differs by a few per cent.
  CHECK(disc_facts.near > 0.5);
  CHECK(disc_facts.elsewhere > 0.005);
  CHECK(disc_facts.elsewhere < 0.05);

  CHECK(find(inspect(office_with(lambert_luminaire(disc), 2.5, true)), "luminaire-size", Severity::warning) == nullptr);
  // A downlight, flush in the ceiling: nothing is within half a metre, not even the ceiling.
  const LuminousOpening small{OpeningForm::ellipse, {0.1, 0.1, 0.0}};
  facts = inspect(office_with(lambert_luminaire(small), 2.7999, false));
  CHECK(find(facts, "luminaire-size", Severity::warning) == nullptr);
  CHECK(facts.luminaires.front().near == 0.0);
  CHECK(facts.count(Severity::warning) == 0);
  // Without a stated opening there is nothing to say.
  CHECK(inspect(office_with(lambert_luminaire({}), 2.5, false)).count(Severity::warning) == 0);
}

TEST_CASE("a luminaire whose light ends in its housing is a warning") {
  // A plate as large as the opening 1 cm below it: all light but that of the rim.
  for (const bool area : {false, true}) {
    INFO(area);
    Room room = office_with(lambert_luminaire(disc, 5.0), 2.5, area);
    add_plate(room, 2.49, 0.6);
    const Inspection facts = inspect(room);
    const Finding* warning = find(facts, "luminaire-housing", Severity::warning);
    REQUIRE(warning != nullptr);
    CHECK_THAT(warning->text, ContainsSubstring("of the light of luminaire 'lamp' (photometric file 'flat.ies')"));
    CHECK(facts.luminaires.front().in_housing > 0.8);
    CHECK(facts.luminaires.front().housed == "lamp");
  }
  // A plate of a tenth of the area holds back less than a fifth of a point's light farther away.
  Room room = office_with(lambert_luminaire(disc), 2.5, true);
  add_plate(room, 2.2, 0.2);
  CHECK(find(inspect(room), "luminaire-housing", Severity::warning) == nullptr);
  // A shelf half a metre below a luminaire of 1.8 m is nearer to its middle than its ends, and no housing.
  Room shelf = office_with(lambert_luminaire({OpeningForm::rectangle, {1.8, 0.06, 0.0}}), 2.5, true);
  add_plate(shelf, 2.0, 1.0);
  CHECK(find(inspect(shelf), "luminaire-housing", Severity::warning) == nullptr);
  // The ceiling close above a pendant that shines upwards is no housing.
  const Inspection pendant = inspect(office_with(lambert_luminaire(disc, 100.0), 2.6, true));
  CHECK(find(pendant, "luminaire-housing", Severity::warning) == nullptr);
}

TEST_CASE("a luminaire that is shut in has one warning") {
  Room room = office_with(lambert_luminaire(disc, 50.0), 2.0, true);
  Room box = make_cuboid({1.0, 0.4, 1.0}, uniform_reflectance(0.5));
  for (Surface& surface : box.surfaces) {
    surface.name = "box_" + surface.name;
    for (glm::dvec3& p : surface.positions) p += glm::dvec3(2.0, 1.8, 1.5);
    room.surfaces.push_back(std::move(surface));
  }
  const Inspection facts = inspect(room);
  CHECK(find(facts, "emitter-light", Severity::warning) != nullptr);
  CHECK(find(facts, "luminaire-housing", Severity::warning) == nullptr);
}
