#include "output/read_results.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <system_error>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/csv.hpp"
#include "base/message.hpp"
#include "lichtmc/error.hpp"

namespace lichtmc {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const fs::path& file, const std::string& fault) {
  throw InputError("Cannot read " + in_quotes(file.string()) + " (" + fault +
                   "). Give an output folder of 'lichtmc run', or run it again.");
}

template <class Number>
Number parse(const fs::path& file, const std::string& text) {
  Number value{};
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size()) refuse(file, in_quotes(text) + " is not a number");
  return value;
}

// A table of lichtmc, with some of its columns by their names.
class ResultTable {
 public:
  ResultTable(const fs::path& file, const std::vector<std::string_view>& columns)
      : file_(file), in_(file, std::ios::binary), reader_(in_, ',') {
    if (!read_row()) refuse(file_, "it is empty");
    width_ = row_.fields.size();
    for (const std::string_view column : columns) {
      const auto found = std::find_if(row_.fields.begin(), row_.fields.end(),
                                      [column](const CsvField& field) { return field.text == column; });
      if (found == row_.fields.end()) refuse(file_, "it has no column " + in_quotes(column));
      places_.push_back(static_cast<std::size_t>(found - row_.fields.begin()));
    }
  }

  // The next row; false at the end.
  bool next() {
    if (!read_row()) return false;
    if (row_.fields.size() != width_)
      refuse(file_, "row " + std::to_string(row_.line) + " has " + to_text(row_.fields.size(), "field") +
                        ", the heading has " + std::to_string(width_));
    return true;
  }

  // The field of the k-th of the columns.
  const std::string& text(std::size_t k) const { return row_.fields[places_[k]].text; }
  template <class Number>
  Number number(std::size_t k) const {
    return parse<Number>(file_, text(k));
  }

 private:
  bool read_row() {
    try {
      return reader_.next(row_);
    } catch (const CsvFault& fault) {
      refuse(file_, "row " + std::to_string(fault.line) + ' ' + fault.what);
    }
  }

  fs::path file_;
  std::ifstream in_;
  CsvReader reader_;
  CsvRow row_;
  std::size_t width_ = 0;
  std::vector<std::size_t> places_;
};

std::vector<ComparableTile> read_tiles(const fs::path& file) {
  ResultTable table(file, {"surface", "column", "row", "x", "y", "z", "irradiance", "standard_error"});
  std::vector<ComparableTile> tiles;
  while (table.next()) {
    tiles.push_back({table.text(0), table.number<std::uint32_t>(1), table.number<std::uint32_t>(2),
                     glm::dvec3(table.number<double>(3), table.number<double>(4), table.number<double>(5)),
                     table.number<double>(6), table.number<double>(7)});
  }
  return tiles;
}

std::vector<ComparableReceiver> read_receivers(const fs::path& file) {
  ResultTable table(file, {"name", "x", "y", "z", "nx", "ny", "nz", "irradiance", "standard_error"});
  std::vector<ComparableReceiver> receivers;
  while (table.next()) {
    receivers.push_back({table.text(0),
                         glm::dvec3(table.number<double>(1), table.number<double>(2), table.number<double>(3)),
                         glm::dvec3(table.number<double>(4), table.number<double>(5), table.number<double>(6)),
                         table.number<double>(7), table.number<double>(8)});
  }
  return receivers;
}

nlohmann::json read_summary(const fs::path& file) {
  std::ifstream in(file);
  if (!in) refuse(file, "the file does not exist; a complete run writes it");
  nlohmann::json summary = nlohmann::json::parse(in, nullptr, false);
  if (!summary.is_object()) refuse(file, "it is not a JSON object");
  return summary;
}

double tile_freedom(const nlohmann::json& summary) {
  const bool backward = summary.value("tiles_by", "forward") == "backward";
  return freedom_of_tiles(backward ? WalkDirection::backward : WalkDirection::forward,
                          summary.at("histories").get<std::uint64_t>(), summary.at("tiles_count").get<std::size_t>());
}

// Results of earlier versions have rounds of one walk from each receiver.
double receiver_freedom(const nlohmann::json& walk, std::size_t receivers) {
  const auto rounds = walk.contains("rounds") ? walk.at("rounds").get<std::uint64_t>()
                                              : walk.at("histories").get<std::uint64_t>() / std::max<std::size_t>(receivers, 1);
  return freedom_of_receivers(rounds);
}

}  // namespace

ComparableResult read_results(const fs::path& folder) {
  ComparableResult result;
  result.name = folder.string();
  const fs::path file = folder / "summary.json";
  const nlohmann::json summary = read_summary(file);
  try {
    result.unit = summary.at("unit").get<std::string>();
    result.tile_freedom = tile_freedom(summary);
  } catch (const nlohmann::json::exception& fault) {
    refuse(file, fault.what());
  }
  if (fs::exists(folder / "tiles.csv")) result.tiles = read_tiles(folder / "tiles.csv");
  if (!fs::exists(folder / "receivers.csv")) return result;
  result.receivers = read_receivers(folder / "receivers.csv");
  try {
    result.receiver_freedom = receiver_freedom(summary.at("backward"), result.receivers.size());
  } catch (const nlohmann::json::exception& fault) {
    refuse(file, fault.what());
  }
  return result;
}

}  // namespace lichtmc
