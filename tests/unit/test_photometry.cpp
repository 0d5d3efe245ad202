// Photometric files against independent figures, and mutations of what a reader may get wrong, which these figures must
// reject.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include "lichtmc/photometry.hpp"
#include "support/catch.hpp"
#include "support/photometric_files.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

TableRow figures_of(const std::string& name) {
  for (const TableRow& row : rows_of(photometric_file("oracles.tsv"))) {
    if (row.at("file") == name) return row;
  }
  FAIL("no figures of " << name);
  return {};
}

Photometry times(const Photometry& photometry, double factor) {
  CandelaTable::Grid grid = photometry.candela->grid();
  for (double& candela : grid.candela) candela *= factor;
  Photometry other = with_grid(photometry, std::move(grid));
  other.factor *= factor;
  return other;
}

bool names(const std::vector<std::string>& deviations, const std::string& what) {
  return std::any_of(deviations.begin(), deviations.end(),
                     [&what](const std::string& deviation) { return deviation.find(what) != std::string::npos; });
}

// The largest difference of two luminaires over directions all round, relative to the maximum.
double difference(const Photometry& a, const Photometry& b) {
  double largest = 0.0;
  for (int c = 0; c < 360; c += 7) {
    for (int gamma = 0; gamma <= 180; gamma += 3) {
      const double turn = c * std::numbers::pi / 180.0;
      const double polar = gamma * std::numbers::pi / 180.0;
      const glm::dvec3 d(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
      largest = std::max(largest, std::abs(a.candela->candela(d) - b.candela->candela(d)));
    }
  }
  return largest / a.candela->peak().candela;
}

}  // namespace

TEST_CASE("photometric files give the candela and lumens of independent figures") {
  const std::vector<TableRow> rows = photometric_figures();
  if (!std::filesystem::exists(foreign_luminaires()))
    WARN("skipped: files of other authors; the folder " << foreign_luminaires() << " is not there");
  CHECK(rows.size() >= 22);
  for (const TableRow& row : rows) {
    INFO(row.at("path"));
    const Photometry photometry = read_photometry(row.at("path"));
    for (const std::string& deviation : deviations(photometry, row)) FAIL_CHECK(deviation);
    // Files of the kind "warn" are not as the format demands.
    if (row.at("kind") == "warn") CHECK(!(photometry.warnings.empty() && photometry.notes.empty()));
  }
}

TEST_CASE("a luminaire written in different ways is one luminaire") {
  const Photometry skew = read_photometry(photometric_file("c_skew.ies"));
  for (const char* other : {"c_skew_odd.ies", "c_skew_crlf_latin1.ies"}) {
    INFO(other);
    CHECK(difference(skew, read_photometry(photometric_file(other))) <= 1e-9);
  }
}

TEST_CASE("figures reject a table that is mirrored or turned") {
  const TableRow row = figures_of("c_skew.ies");
  const Photometry skew = read_photometry(photometric_file("c_skew.ies"));
  REQUIRE(deviations(skew, row).empty());

  CandelaTable::Grid mirrored = skew.candela->grid();
  const std::size_t planes = mirrored.horizontal_deg.size();
  const std::size_t rows = mirrored.vertical_deg.size();
  for (std::size_t j = 0; j < planes / 2; ++j) {
    for (std::size_t i = 0; i < rows; ++i)
      std::swap(mirrored.candela[j * rows + i], mirrored.candela[(planes - 1 - j) * rows + i]);
  }
  const auto of_mirrored = deviations(with_grid(skew, mirrored), row);
  CHECK(names(of_mirrored, "cd_C90_g30"));
  CHECK(names(of_mirrored, "horizontal angle of the maximum"));
  CHECK(!names(of_mirrored, "flux"));

  for (const double turn : {90.0, -90.0, 180.0}) {
    CandelaTable::Grid turned = skew.candela->grid();
    for (double& angle : turned.horizontal_deg) angle += turn;
    CHECK(names(deviations(with_grid(skew, turned), row), "cd_C0_g30"));
  }
}

TEST_CASE("figures reject H of type B that counts the other way") {
  const TableRow row = figures_of("c_typeb.ies");
  CHECK(deviations(read_photometry(photometric_file("c_typeb.ies")), row).empty());
  PhotometryOptions options;
  options.flip_horizontal = true;
  CHECK(names(deviations(read_photometry(photometric_file("c_typeb.ies"), options), row), "cd_C90_g30"));
}

TEST_CASE("figures reject factors that are forgotten, and numbers that are none") {
  const Photometry ballast = read_photometry(photometric_file("c_v02_future.ies"));
  REQUIRE(deviations(ballast, figures_of("c_v02_future.ies")).empty());
  CHECK(ballast.ballast == 0.9);
  CHECK(names(deviations(times(ballast, 1.0 / 0.9), figures_of("c_v02_future.ies")), "flux"));  // forgotten
  CHECK(names(deviations(times(ballast, 0.95), figures_of("c_v02_future.ies")), "flux"));       // for future use

  const Photometry old = read_photometry(photometric_file("c_v86_factors.ies"));
  CHECK(old.ballast_lamp == 0.95);
  CHECK(names(deviations(times(old, 1.0 / 0.95), figures_of("c_v86_factors.ies")), "flux"));

  const Photometry generated = read_photometry(photometric_file("c_v19_gentype.ies"));
  REQUIRE(deviations(generated, figures_of("c_v19_gentype.ies")).empty());
  CHECK(names(deviations(times(generated, 1.101), figures_of("c_v19_gentype.ies")), "flux"));

  const Photometry conversion = read_photometry(photometric_file("c_ldt_conv.ldt"));
  CHECK(conversion.conversion == 0.5);
  CHECK(names(deviations(times(conversion, 2.0), figures_of("c_ldt_conv.ldt")), "flux"));
}

TEST_CASE("the values of EULUMDAT symmetry 3 begin at C270") {
  // One luminaire, brighter towards C0 than towards C180: all planes, and those from C270 through C0 to C90, of which
  // C315 and C45 are equal only in the first one.
  const auto file = [](int symmetry, const std::vector<int>& planes) {
    std::string text = "maker\n3\n" + std::to_string(symmetry) + "\n8\n45\n3\n90\nreport\nname\nnumber\nfile\ndate\n";
    text += "600\n300\n80\n500\n250\n0\n0\n0\n0\n100\n100\n1\n0\n1\n1\nLED\n1000\n4000\n80\n20\n";
    for (int k = 0; k < 10; ++k) text += "0.5\n";
    for (int c = 0; c < 360; c += 45) text += std::to_string(c) + "\n";
    text += "0\n45\n90\n";
    for (const int c : planes) {
      const double turn = c * std::numbers::pi / 180.0;
      for (const int gamma : {0, 45, 90}) {
        const double towards = gamma == 0 ? 0.0 : std::cos(turn) + 0.4 * std::sin(turn);
        text += std::to_string(std::lround(500.0 + 100.0 * towards - gamma)) + "\n";
      }
    }
    return text;
  };
  const Photometry whole = parse_photometry(file(0, {0, 45, 90, 135, 180, 225, 270, 315}), "whole.ldt");
  // Mirrored in the plane C90–C270 both halves would be alike: the front half is compared.
  const Photometry half = parse_photometry(file(3, {270, 315, 0, 45, 90}), "half.ldt");
  const Photometry from_c90 = parse_photometry(file(3, {90, 45, 0, 315, 270}), "wrong.ldt");
  CHECK(half.candela->grid().horizontal_deg == std::vector<double>{-90.0, -45.0, 0.0, 45.0, 90.0});
  double largest = 0.0;
  double wrong = 0.0;
  for (int c = -90; c <= 90; c += 5) {
    for (int gamma = 0; gamma <= 90; gamma += 5) {
      const double turn = c * std::numbers::pi / 180.0;
      const double polar = gamma * std::numbers::pi / 180.0;
      const glm::dvec3 d(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
      const glm::dvec3 behind(-d.x, d.y, d.z);
      largest = std::max(largest, std::abs(half.candela->candela(d) - whole.candela->candela(d)));
      largest = std::max(largest, std::abs(half.candela->candela(behind) - whole.candela->candela(d)));
      wrong = std::max(wrong, std::abs(from_c90.candela->candela(d) - whole.candela->candela(d)));
    }
  }
  CHECK(largest <= 1e-9 * whole.candela->peak().candela);
  CHECK(wrong >= 0.05 * whole.candela->peak().candela);
}

TEST_CASE("sets of lamps of a EULUMDAT file are alternatives") {
  PhotometryOptions options;
  const Photometry first = read_photometry(photometric_file("c_ldt_two_sets.ldt"), options);
  options.lamp_set = 2;
  const Photometry second = read_photometry(photometric_file("c_ldt_two_sets.ldt"), options);
  CHECK(first.lamp_sets.size() == 2);
  CHECK(first.factor == 2.6);
  CHECK(second.factor == 8.9);
  CHECK(second.lamp_set == 1);
  CHECK(second.watts == 117.0);
  CHECK(second.lamp_lm == 8900.0);
  CHECK(std::abs(second.flux() / first.flux() - 8900.0 / 2600.0) <= 1e-12);
  options.lamp_set = 3;
  CHECK_THROWS_WITH(read_photometry(photometric_file("c_ldt_two_sets.ldt"), options),
                    ContainsSubstring("lamp set 3 is asked for; the file has 2 sets"));
  CHECK_THROWS_WITH(read_photometry(photometric_file("c_skew.ies"), options),
                    ContainsSubstring("an IES file has one set"));
}
