#include "support/photometric_files.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <sstream>
#include <utility>

namespace lichtmc::test {

namespace {

double number(const TableRow& row, const std::string& column) {
  const std::string& text = row.at(column);
  return text.empty() ? 0.0 : std::strtod(text.c_str(), nullptr);
}

// x towards C0, y towards C90, z along the aim.
glm::dvec3 direction(double c_deg, double gamma_deg) {
  const double c = c_deg * std::numbers::pi / 180.0;
  const double gamma = gamma_deg * std::numbers::pi / 180.0;
  return {std::sin(gamma) * std::cos(c), std::sin(gamma) * std::sin(c), std::cos(gamma)};
}

class DeviationList {
 public:
  void same(const std::string& what, const std::string& found, const std::string& expected) {
    if (found != expected) list_.push_back(what + " " + found + ", expected " + expected);
  }
  void near(const std::string& what, double found, double expected, double allowed) {
    if (std::abs(found - expected) <= allowed) return;
    std::ostringstream text;
    text.precision(10);
    text << what << " " << found << ", expected " << expected;
    list_.push_back(text.str());
  }
  void warning(const Photometry& photometry, const std::string& words) {
    for (const std::string& warning : photometry.warnings) {
      if (warning.find(words) != std::string::npos) return;
    }
    list_.push_back("no warning with \"" + words + "\"");
  }
  std::vector<std::string> take() { return std::move(list_); }

 private:
  std::vector<std::string> list_;
};

std::string symmetry_of(const std::string& word) {
  static const std::map<std::string, PhotometricSymmetry> names{
      {"rot", PhotometricSymmetry::rotational}, {"none", PhotometricSymmetry::none},
      {"C0-180", PhotometricSymmetry::c0_c180}, {"C90-270", PhotometricSymmetry::c90_c270},
      {"quad", PhotometricSymmetry::quadrants}, {"H", PhotometricSymmetry::horizontal},
      {"V", PhotometricSymmetry::vertical},     {"HV", PhotometricSymmetry::both}};
  return std::string(name_of(names.at(word)));
}

// The words by which a warning of the table is known.
std::string words_of(const std::string& warning) {
  if (warning.find("differ") != std::string::npos) return "C0 and C360) differ";
  if (warning.find("no 360 plane") != std::string::npos) return "repeated at 360°";
  if (warning.find("negative candela") != std::string::npos) return "negative candela value";
  if (const auto after = warning.find(" values after"); after != std::string::npos)
    return warning.substr(0, after) + " values follow after the";
  return warning;
}

}  // namespace

std::filesystem::path photometric_file(const std::string& name) {
  return std::filesystem::path(LICHTMC_TEST_DATA) / "luminaires" / name;
}

std::filesystem::path foreign_luminaires() {
  return std::filesystem::path(LICHTMC_ROOMS).parent_path() / "luminaires";
}

std::vector<TableRow> rows_of(const std::filesystem::path& table) {
  const auto fields_of = [](const std::string& line) {
    std::vector<std::string> fields(1);
    for (const char c : line) {
      if (c == '\t')
        fields.emplace_back();
      else
        fields.back() += c;
    }
    return fields;
  };
  std::vector<TableRow> rows;
  std::ifstream in(table);
  std::string line;
  if (!std::getline(in, line)) return rows;
  const std::vector<std::string> columns = fields_of(line);
  while (std::getline(in, line)) {
    const std::vector<std::string> fields = fields_of(line);
    TableRow row;
    for (std::size_t k = 0; k < columns.size(); ++k) row[columns[k]] = k < fields.size() ? fields[k] : "";
    row["path"] = (table.parent_path() / row["file"]).string();
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<TableRow> photometric_figures() {
  std::vector<TableRow> rows = rows_of(photometric_file("oracles.tsv"));
  for (TableRow& row : rows_of(foreign_luminaires() / "ORACLES.tsv")) rows.push_back(std::move(row));
  return rows;
}

std::vector<std::string> deviations(const Photometry& photometry, const TableRow& row) {
  DeviationList found;
  const CandelaTable& table = *photometry.candela;
  found.same("format", photometry.format == PhotometryFormat::ies ? "ies" : "ldt", row.at("format"));
  if (photometry.format == PhotometryFormat::ies)
    found.same("version", photometry.version, "LM-63-" + row.at("version"));
  found.same("type", std::string(name_of(table.grid().type)), row.at("type"));
  found.same("symmetry", std::string(name_of(table.grid().symmetry)), symmetry_of(row.at("symmetry")));
  const bool tilted = row.at("tilt") == "INCLUDE" || row.at("tilt").find('.') != std::string::npos;
  found.same("TILT factors", photometry.tilt_factors ? "yes" : "no", tilted ? "yes" : "no");
  found.near("factor", photometry.factor, number(row, "factor"), 1e-12 * photometry.factor);
  found.same("absolute", photometry.absolute ? "1" : "0", row.at("absolute"));
  found.near("flux of the lamps", photometry.lamp_lm.value_or(0.0), number(row, "stated_lamp_lm"), 1e-9);

  const double lumens = number(row, "lumens");
  found.near("flux", table.flux(), lumens, 1e-6 * lumens);
  found.near("flux towards the aim", table.flux_towards_aim(), number(row, "lumens_front"), 1e-6 * lumens);
  const double highest = number(row, "max_cd");
  found.near("maximum", table.peak().candela, highest, 1e-6 * highest);
  found.near("horizontal angle of the maximum", table.peak().horizontal_deg, number(row, "max_at_h"), 1e-9);
  found.near("vertical angle of the maximum", table.peak().vertical_deg, number(row, "max_at_v"), 1e-9);
  for (const auto& [column, text] : row) {
    double c = 0.0;
    double gamma = 0.0;
    if (std::sscanf(column.c_str(), "cd_C%lf_g%lf", &c, &gamma) != 2) continue;
    found.near(column, table.candela(direction(c, gamma)), number(row, column), 1e-6 * highest);
  }
  if (!row.at("warning").empty()) found.warning(photometry, words_of(row.at("warning")));
  return found.take();
}

Photometry with_grid(const Photometry& photometry, CandelaTable::Grid grid) {
  Photometry other = photometry;
  other.candela = std::make_shared<const CandelaTable>(std::move(grid));
  return other;
}

}  // namespace lichtmc::test
