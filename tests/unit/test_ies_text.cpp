// Luminaires written as LM-63-2002, and read again.
#include <cmath>
#include <numbers>
#include <string>

#include "lichtmc/photometry.hpp"
#include "support/catch.hpp"
#include "support/luminaires.hpp"
#include "support/photometric_files.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

void check_light(const Photometry& found, const Photometry& expected) {
  double largest = 0.0;
  for (int c = 0; c < 360; c += 11) {
    for (int gamma = 1; gamma < 180; gamma += 7) {
      const double turn = c * std::numbers::pi / 180.0;
      const double polar = gamma * std::numbers::pi / 180.0;
      const glm::dvec3 d(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
      largest = std::max(largest, std::abs(found.candela->candela(d) - expected.candela->candela(d)));
    }
  }
  // Angles that are mirrored are rounded anew.
  CHECK(largest <= 1e-12 * expected.candela->peak().candela);
}

void check_again(const Photometry& expected) {
  const Photometry found = parse_photometry(ies_text(expected), "again.ies");
  const CandelaTable::Grid& grid = expected.candela->grid();
  const CandelaTable::Grid& again = found.candela->grid();
  check_light(found, expected);
  CHECK(found.flux() == Approx(expected.flux()).epsilon(1e-13));
  CHECK(again.type == grid.type);
  CHECK(again.symmetry == grid.symmetry);
  const bool turned = grid.symmetry == PhotometricSymmetry::c90_c270 && grid.horizontal_deg.front() < 0.0;
  if (!turned && !grid.flip_horizontal) {
    CHECK(again.horizontal_deg == grid.horizontal_deg);
    CHECK(again.vertical_deg == grid.vertical_deg);
    CHECK(again.candela == grid.candela);
  }
  CHECK(found.version == "LM-63-2002");
  CHECK(found.opening.form == expected.opening.form);
  CHECK(found.opening.size_m == expected.opening.size_m);
  CHECK(found.intensity_unit == expected.intensity_unit);
  CHECK(found.manufacturer == expected.manufacturer);
  CHECK(found.luminaire == expected.luminaire);
  CHECK(found.catalogue == expected.catalogue);
  CHECK(found.test == expected.test);
  CHECK(found.watts == expected.watts);
  CHECK(found.absolute == expected.absolute);
  CHECK(found.stated_lm == (expected.absolute ? expected.stated_lm : std::nullopt));
  const LampSet& lamps = expected.lamp_sets[expected.lamp_set];
  CHECK(found.lamp_sets[0].lamps == lamps.lamps);
  CHECK(found.lamp_sets[0].type == lamps.type);
  CHECK(found.lamp_sets[0].colour == lamps.colour);
  CHECK(found.lamp_sets[0].rendering_index == lamps.rendering_index);
  if (!expected.absolute) CHECK(found.lamp_sets[0].flux_lm == Approx(lamps.flux_lm).epsilon(1e-15));
  if (expected.format == PhotometryFormat::ies && !expected.stated_lm) CHECK(found.texts == expected.texts);
  // Written again it is the same text.
  CHECK(ies_text(found) == ies_text(expected));
}

}  // namespace

TEST_CASE("luminaires that are written as IES files come back") {
  for (const TableRow& row : photometric_figures()) {
    INFO(row.at("path"));
    check_again(read_photometry(row.at("path")));
  }
  check_again(*skew_luminaire());
}

TEST_CASE("H that counts the other way is written as it is meant") {
  PhotometryOptions options;
  options.flip_horizontal = true;
  for (const char* file : {"c_typeb.ies", "c_typea.ies"}) {
    const Photometry flipped = read_photometry(photometric_file(file), options);
    REQUIRE(flipped.candela->grid().flip_horizontal);
    check_again(flipped);
    const Photometry again = parse_photometry(ies_text(flipped), "again.ies");
    CHECK(again.candela->grid().horizontal_deg.front() == -flipped.candela->grid().horizontal_deg.back());
  }
}

TEST_CASE("H above 0 only is written so that it is not read as mirrored") {
  for (const std::string planes : {"-90 -45", "-45 0"}) {
    PhotometryOptions options;
    options.flip_horizontal = true;
    const Photometry photometry =
        parse_photometry("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 2 2 2 0 0 0\n1 1 0\n-90 90\n" + planes + "\n1 2\n3 4\n",
                         "lamp.ies", options);
    const Photometry again = parse_photometry(ies_text(photometry), "again.ies");
    CHECK(again.candela->grid().symmetry == PhotometricSymmetry::none);
    CHECK(again.candela->grid().horizontal_deg.front() < 0.0);
    // Half a plane of 10⁻⁵° beside 45°.
    CHECK(again.flux() == Approx(photometry.flux()).epsilon(1e-6));
    check_light(again, photometry);
  }
}

TEST_CASE("openings of all forms come back") {
  Photometry photometry = *skew_luminaire();
  const std::vector<LuminousOpening> openings{
      {OpeningForm::point, {0, 0, 0}},          {OpeningForm::rectangle, {.6, .1, 0}},
      {OpeningForm::rectangle, {.6, 0, 0}},     {OpeningForm::ellipse, {.6, .1, 0}},
      {OpeningForm::box, {.6, .1, .2}},         {OpeningForm::box, {.6, 0, .2}},
      {OpeningForm::cylinder, {.6, .1, .2}},    {OpeningForm::cylinder_c0, {.6, .1, .2}},
      {OpeningForm::cylinder_c0, {0, .1, .2}},  {OpeningForm::cylinder_c90, {.6, .1, .2}},
      {OpeningForm::cylinder_c90, {.6, 0, .2}}, {OpeningForm::ellipsoid, {.6, .1, .2}}};
  for (const LuminousOpening& opening : openings) {
    INFO(name_of(opening.form));
    photometry.opening = opening;
    check_again(photometry);
  }
}

TEST_CASE("planes that begin elsewhere are written from 0 to 360°") {
  const Photometry skew = *skew_luminaire();
  CandelaTable::Grid turned = skew.candela->grid();
  for (double& angle : turned.horizontal_deg) angle += 7.5;
  const Photometry photometry = with_grid(skew, turned);
  const Photometry again = parse_photometry(ies_text(photometry), "again.ies");
  CHECK(again.candela->grid().horizontal_deg.front() == 0.0);
  CHECK(again.candela->grid().horizontal_deg.size() == turned.horizontal_deg.size() + 1);
  CHECK(again.warnings.empty());
  check_light(again, photometry);
  // By a whole number of planes they are only exchanged.
  for (double& angle : turned.horizontal_deg) angle += 22.5;
  const Photometry exchanged = with_grid(skew, turned);
  const Photometry back = parse_photometry(ies_text(exchanged), "again.ies");
  CHECK(back.candela->grid().horizontal_deg == skew.candela->grid().horizontal_deg);
  check_light(back, exchanged);
}

TEST_CASE("long texts are written in lines of at most 256 characters") {
  Photometry photometry = *skew_luminaire();
  std::string text;
  for (int k = 0; k < 200; ++k) text += (k == 0 ? "" : (k % 7 == 0 ? "  " : " ")) + std::to_string(k);
  photometry.texts = {{"", "a label"}, {"OTHER", text}, {"_X", "Weiß\ttab"}, {"LUMCAT", ""}};
  const std::string written = ies_text(photometry);
  std::size_t start = 0;
  for (std::size_t end = 0; (end = written.find("\r\n", start)) != std::string::npos; start = end + 2)
    CHECK(end - start <= 254);
  const Photometry again = parse_photometry(written, "again.ies");
  CHECK(again.texts == decltype(again.texts){{"", "a label"}, {"OTHER", text}, {"_X", "Weiß tab"}, {"LUMCAT", ""}});

  // Labels that look like something else, as by lines that continue.
  photometry.texts = {{"", "[12.8 MORE] of it"}, {"", "TILT=NONE"}};
  const Photometry labels = parse_photometry(ies_text(photometry), "again.ies");
  CHECK(labels.texts == decltype(labels.texts){{"OTHER", "[12.8 MORE] of it"}, {"OTHER", "TILT=NONE"}});
}
