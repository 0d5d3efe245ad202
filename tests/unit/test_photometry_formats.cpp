// What photometric files may look like: encodings, line ends, ranges of angles, openings, texts.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "lichtmc/photometry.hpp"
#include "support/catch.hpp"
#include "support/photometric_files.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::string replaced(std::string text, const std::string& old, const std::string& replacement) {
  for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += replacement.size())
    text.replace(at, old.size(), replacement);
  return text;
}

std::string utf16(const std::string& ascii, bool big_endian) {
  std::string text = big_endian ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : ascii) {
    if (big_endian) text += '\0';
    text += c;
    if (!big_endian) text += '\0';
  }
  return text;
}

// An IES file of two vertical angles and these planes, with a value per plane.
Photometry with_planes(int type, const std::string& vertical, const std::vector<double>& planes) {
  std::string text = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 " + std::to_string(planes.size()) + " " +
                     std::to_string(type) + " 2 0 0 0\n1 1 0\n" + vertical + "\n";
  for (const double plane : planes) text += std::to_string(plane) + " ";
  for (std::size_t k = 0; k < planes.size(); ++k) text += "\n100 " + std::to_string(10 * k);
  return parse_photometry(text, "lamp.ies");
}

LuminousOpening opening(const std::string& version, const std::string& sizes, bool warns = false, int units = 2) {
  const std::string text =
      version + "\nTILT=NONE\n1 -1 1 2 1 1 " + std::to_string(units) + " " + sizes + "\n1 1 0\n0 90\n0\n100 0\n";
  const Photometry photometry = parse_photometry(text, "lamp.ies");
  CHECK(photometry.warnings.size() == (warns ? 1 : 0));
  return photometry.opening;
}

bool is(const LuminousOpening& found, OpeningForm form, const glm::dvec3& size) {
  INFO(name_of(found.form) << " " << found.size_m.x << " " << found.size_m.y << " " << found.size_m.z);
  CHECK(found.form == form);
  CHECK(found.size_m == size);
  return found.form == form && found.size_m == size;
}

}  // namespace

TEST_CASE("line ends, encodings and blanks do not change a photometric file") {
  for (const char* name : {"c_skew.ies", "c_ldt_two_sets.ldt"}) {
    const std::string text = content_of(photometric_file(name));
    const auto expected = parse_photometry(text, name);
    const std::vector<std::string> others{
        replaced(text, "\n", "\r\n"), replaced(text, "\n", "\r"),  "\xEF\xBB\xBF" + text,
        utf16(text, false),           utf16(text, true),           text + "\x1A",
        text + "\r\n\r\n\x1A\x1A\n",  replaced(text, "\n", " \n"), text.substr(0, text.size() - 1)};
    for (std::size_t k = 0; k < others.size(); ++k) {
      INFO(name << " " << k);
      const Photometry other = parse_photometry(others[k], name);
      CHECK(other.candela->grid().candela == expected.candela->grid().candela);
      CHECK(other.candela->grid().horizontal_deg == expected.candela->grid().horizontal_deg);
      CHECK(other.texts == expected.texts);
      CHECK(other.warnings == expected.warnings);
    }
  }
}

TEST_CASE("texts become UTF-8") {
  const Photometry latin = read_photometry(photometric_file("c_skew_crlf_latin1.ies"));
  CHECK(latin.manufacturer == "Büro-Leuchte 30° Weiß second line");
  CHECK(latin.notes.size() == 1);
  CHECK(read_photometry(photometric_file("c_ldt_comma.ldt")).luminaire == "Büroleuchte „Weiß“ 30°");
  const std::string text = replaced(content_of(photometric_file("c_skew.ies")), "lichtmc corpus", "Weiß 30°");
  CHECK(parse_photometry(text, "lamp.ies").manufacturer == "Weiß 30°");
  CHECK(parse_photometry(text, "lamp.ies").notes.empty());
}

TEST_CASE("keywords, labels and continued lines of an IES file") {
  const std::string rest = "TILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 12.5\n0 90\n0\n100 0\n";
  const Photometry photometry = parse_photometry(
      "IES:LM-63-2019\n[TEST]T-1\n[manufac]  Maker  \n[MORE] and Sons\na label\n[LUMCAT]\n[LUMINAIRE] Lamp [blue] "
      "TILT=INCLUDE\n"
      "[LAMP] LED\n[OTHER] unclosed [\n" +
          rest,
      "lamp");
  CHECK(photometry.version == "LM-63-2019");
  CHECK(photometry.test == "T-1");
  CHECK(photometry.manufacturer == "Maker and Sons");
  CHECK(photometry.catalogue.empty());
  CHECK(photometry.luminaire == "Lamp [blue] TILT=INCLUDE");
  CHECK(photometry.lamp_sets[0].type == "LED");
  CHECK(photometry.texts.size() == 7);
  CHECK(photometry.texts[2] == std::pair<std::string, std::string>("", "a label"));
  CHECK(photometry.watts == 12.5);
  CHECK(photometry.warnings.empty());

  const Photometry old = parse_photometry("Some lamp\nmade in 1987\n" + rest, "lamp");
  CHECK(old.version == "LM-63-1986");
  CHECK(old.luminaire == "Some lamp");

  const Photometry unknown = parse_photometry("IES:LM-63-2031\n" + rest, "lamp");
  CHECK(unknown.version == "LM-63-2019");
  CHECK(unknown.warnings.size() == 1);

  const std::vector<std::pair<std::string, std::string>> versions{
      {"IESNA86", "1986"},          {"IESNA91", "1991"},
      {"IESNA:LM-63-1991", "1991"}, {"iesna:lm-63-1995  ", "1995"},
      {"IESNA:LM-63-2002", "2002"}, {"IESNA: LM-63-02", "2002"},
      {"IESNA:LM-63-2019", "2019"}, {"IES:LM-63-2019", "2019"}};
  for (const auto& [line, year] : versions)
    CHECK(parse_photometry(line + "\n" + rest, "lamp").version == "LM-63-" + year);

  const Photometry ultraviolet = parse_photometry("IES:LM-63-2019\n[_INTENSITYUNITS] mW/sr\n" + rest, "lamp");
  CHECK(ultraviolet.intensity_unit == "mW/sr");
  CHECK(!ultraviolet.efficacy());
  CHECK(photometry.intensity_unit == "cd");
  CHECK(photometry.efficacy() == photometry.flux() / 12.5);
}

TEST_CASE("ranges of horizontal angles give the symmetry") {
  using S = PhotometricSymmetry;
  const auto type_c = [](const std::vector<double>& planes) { return with_planes(1, "0 90", planes); };
  CHECK(type_c({0}).candela->grid().symmetry == S::rotational);
  CHECK(type_c({0, 45, 90}).candela->grid().symmetry == S::quadrants);
  CHECK(type_c({0, 180}).candela->grid().symmetry == S::c0_c180);
  CHECK(type_c({90, 200, 270}).candela->grid().symmetry == S::c90_c270);
  CHECK(type_c({0, 180, 360}).candela->grid().symmetry == S::none);

  const Photometry turned = type_c({45});
  CHECK(turned.candela->grid().symmetry == S::rotational);
  CHECK(turned.warnings.size() == 1);

  // The plane at 360° may be missing if the gap is no wider than others.
  const Photometry open = type_c({0, 120, 240});
  CHECK(open.candela->grid().symmetry == S::none);
  CHECK(open.candela->grid().horizontal_deg == std::vector<double>{0, 120, 240, 360});
  CHECK(open.candela->grid().candela == std::vector<double>{100, 0, 100, 10, 100, 20, 100, 0});
  REQUIRE(open.warnings.size() == 1);
  CHECK(open.warnings[0].find("end at 240°; the plane at 0° is repeated at 360°") != std::string::npos);
  CHECK_THROWS_WITH(type_c({0, 100, 200, 235}), ContainsSubstring("run from 0 to 235"));

  // Planes 0 and 360 that differ count on their sides.
  const Photometry seam = type_c({0, 90, 180, 270, 360});
  REQUIRE(seam.warnings.size() == 1);
  CHECK(seam.warnings[0].find("differ, by up to 40 % of the maximum") != std::string::npos);
  const double small = 1e-7;
  CHECK(std::abs(seam.candela->candela({1.0, small, 0.0})) < 1e-3);
  CHECK(std::abs(seam.candela->candela({1.0, -small, 0.0}) - 40.0) < 1e-3);

  CHECK(with_planes(2, "-90 90", {-90, 0, 90}).candela->grid().symmetry == S::none);
  CHECK(with_planes(2, "-90 90", {0, 90}).candela->grid().symmetry == S::horizontal);
  CHECK(with_planes(2, "0 90", {-90, 90}).candela->grid().symmetry == S::vertical);
  CHECK(with_planes(2, "0 90", {0, 90}).candela->grid().symmetry == S::both);
  CHECK(with_planes(3, "0 90", {-90, 90}).candela->grid().symmetry == S::none);
  CHECK(with_planes(3, "0 90", {0, 90}).candela->grid().symmetry == S::horizontal);
  CHECK(with_planes(3, "0 90", {10, 90}).warnings.size() == 1);
}

TEST_CASE("a EULUMDAT file may have the plane at 360°") {
  const auto file = [](const std::string& planes, const std::string& last) {
    const auto number = static_cast<std::size_t>(std::count(planes.begin(), planes.end(), '\n'));
    std::string text = "maker\n3\n0\n" + std::to_string(number) + "\n0\n2\n0\nreport\nname\nnumber\nfile\ndate\n";
    text += "0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n1\n0\n1\n1\nLED\n1000\n\n\n20\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n" + planes;
    text += "0\n90\n100\n50\n100\n30\n100\n40\n" + last;
    return parse_photometry(text, "lamp.ldt");
  };
  const Photometry open = file("0\n120\n240\n", "");
  const Photometry closed = file("0\n120\n240\n360\n", "100\n50\n");
  const Photometry seam = file("0\n120\n240\n360\n", "100\n60\n");
  CHECK(open.candela->grid().horizontal_deg == std::vector<double>{0, 120, 240, 360});
  CHECK(closed.candela->grid().candela == open.candela->grid().candela);
  CHECK(open.warnings.empty());
  CHECK(closed.warnings.empty());
  REQUIRE(seam.warnings.size() == 1);
  CHECK(seam.warnings[0].find("differ, by up to 10 % of the maximum") != std::string::npos);
}

TEST_CASE("any range of vertical angles within that of the type is read") {
  for (const char* range : {"0 90", "90 180", "0 180", "0 140", "130 180", "5 85"}) {
    INFO(range);
    const Photometry photometry = with_planes(1, range, {0, 180, 360});
    CHECK(photometry.flux() > 0.0);
  }
}

TEST_CASE("signs of width, length and height give the form of the opening") {
  using F = OpeningForm;
  const std::string v91 = "IESNA91";
  const std::string v95 = "IESNA:LM-63-1995";
  const std::string v02 = "IESNA:LM-63-2002";
  for (const std::string& version : {v91, v95, v02}) {
    is(opening(version, "0 0 0"), F::point, {0, 0, 0});
    is(opening(version, ".3 .6 0"), F::rectangle, {.6, .3, 0});
    is(opening(version, ".3 .6 .1"), F::box, {.6, .3, .1});
    is(opening(version, "-.2 0 0"), F::ellipse, {.2, .2, 0});
    is(opening(version, "-.2 .5 0"), F::ellipse, {.5, .2, 0});
    is(opening(version, "-.2 0 .5"), F::cylinder, {.2, .2, .5});
    is(opening(version, "0 1.2 0"), F::rectangle, {1.2, 0, 0});
  }
  is(opening(v91, "-.2 .3 .4"), F::ellipsoid, {.3, .2, .4});
  is(opening(v95, "-.2 .3 .4"), F::cylinder, {.3, .2, .4});
  is(opening(v95, ".2 -.3 .4"), F::cylinder, {.3, .2, .4});
  is(opening(v95, "-.2 0 -.2"), F::ellipsoid, {.2, .2, .2});
  is(opening(v95, "-.2 .3 -.4"), F::ellipsoid, {.3, .2, .4});
  is(opening(v95, "0 1.2 -.03"), F::cylinder_c0, {1.2, .03, .03});
  is(opening(v95, "1.2 0 -.03"), F::cylinder_c90, {.03, 1.2, .03});
  is(opening(v02, "-.3 -.3 0"), F::ellipse, {.3, .3, 0});
  is(opening(v02, "-.3 -.4 .5"), F::cylinder, {.4, .3, .5});
  is(opening(v02, "-.3 -.4 -.5"), F::ellipsoid, {.4, .3, .5});
  is(opening(v02, "-.03 1.2 -.04"), F::cylinder_c0, {1.2, .03, .04});
  is(opening(v02, "1.2 -.03 -.04"), F::cylinder_c90, {.03, 1.2, .04});
  is(opening(v02, "-.3 0 -.4"), F::cylinder_c0, {0, .3, .4});
  is(opening(v02, "0 -.3 -.4"), F::cylinder_c90, {.3, 0, .4});
  is(opening(v02, "1 2 0", false, 1), F::rectangle, {2 * .3048, .3048, 0});
  // Unknown signs.
  is(opening(v91, "0 -.5 .09", true), F::box, {.5, 0, .09});
  is(opening(v02, "0 -.5 0", true), F::rectangle, {.5, 0, 0});
  is(opening(v02, "0 0 -.5", true), F::point, {0, 0, 0});
}

TEST_CASE("the opening of a EULUMDAT file has its length along C90") {
  const auto file = [](const std::string& length, const std::string& width, const std::string& heights) {
    return parse_photometry(
               "maker\n1\n1\n1\n0\n2\n90\nreport\n\nnumber\n\ndate\n600\n300\n80\n" + length + "\n" + width + "\n" +
                   heights +
                   "100\n100\n1\n0\n1\n1\nLED\n1000\n\n\n20\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n90\n318.3\n0\n",
               "lamp.ldt")
        .opening;
  };
  is(file("500", "250", "0\n0\n0\n0\n"), OpeningForm::rectangle, {.25, .5, 0});
  is(file("500", "250", "11\n12\n14\n13\n"), OpeningForm::box, {.25, .5, .014});
  is(file("500", "0", "0\n0\n0\n0\n"), OpeningForm::ellipse, {.5, .5, 0});
  is(file("500", "0", "10\n0\n0\n0\n"), OpeningForm::cylinder, {.5, .5, .01});
  is(file("0", "0", "0\n0\n0\n0\n"), OpeningForm::point, {0, 0, 0});
}

TEST_CASE("what a file states is told where it differs from what it gives") {
  const Photometry tilt = read_photometry(photometric_file("c_tilt_include.ies"));
  CHECK(tilt.tilt_factors == std::pair(0.9, 1.0));
  REQUIRE(tilt.warnings.size() == 1);
  CHECK(tilt.warnings[0].find("TILT factors from 0.9 to 1 ") == 0);
  CHECK(read_photometry(photometric_file("c_tiltfile.ies")).tilt_factors == std::pair(0.8, 1.0));

  const Photometry sets = read_photometry(photometric_file("c_ldt_two_sets.ldt"));
  CHECK(sets.stated_lm == 1950.0);
  REQUIRE(sets.warnings.size() == 1);
  CHECK(sets.warnings[0].find("The file states 1950 lm") == 0);

  // Within 5 % nothing is told.
  const std::string rest = "\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 0\n0 180\n0\n100 100\n";
  const std::string head = "IES:LM-63-2019\n[_ABSOLUTELUMENS] ";
  CHECK(parse_photometry(head + "1310 lm" + rest, "lamp").warnings.empty());  // 4π · 100 lm are 1256.6 lm
  CHECK(parse_photometry(head + "1330" + rest, "lamp").warnings.size() == 1);
  CHECK(parse_photometry(head + "unknown" + rest, "lamp").warnings.empty());

  const Photometry conversion = read_photometry(photometric_file("c_ldt_conv.ldt"));
  REQUIRE(conversion.warnings.size() == 2);
  CHECK(conversion.warnings[0] == "The conversion factor 0.5 multiplies all intensities.");
}

TEST_CASE("the largest table that is allowed is read") {
  // 2000 planes of 2000 angles.
  std::string text = "IES:LM-63-2019\nTILT=NONE\n1 -1 1 2000 2000 1 2 0 0 0\n1 1 0\n";
  for (int k = 0; k < 2000; ++k) text += std::to_string(k * 0.09) + (k % 20 == 19 ? "\n" : " ");
  for (int k = 0; k < 2000; ++k) text += std::to_string(k * 0.18) + (k % 20 == 19 ? "\n" : " ");
  for (int k = 0; k < 4'000'000; ++k) text += std::to_string(k % 100) + (k % 40 == 39 ? "\n" : " ");
  // The plane at 360° is added to them.
  const Photometry photometry = parse_photometry(text, "large.ies");
  CHECK(photometry.candela->grid().candela.size() == 2001 * 2000);
  CHECK(photometry.flux() > 0.0);
}
