#include "output/read_results.hpp"

#include <charconv>
#include <fstream>
#include <system_error>

// Read without threads. gcc warns about the truncation of long file names by the library, which is intended there.
#define CSV_IO_NO_THREAD
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wstringop-truncation"
#endif
#include <libfccp/csv.h>
#include <nlohmann/json.hpp>

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

template <unsigned columns>
using Table = io::CSVReader<columns, io::trim_chars<' '>, io::double_quote_escape<',', '"'>>;

std::vector<ComparableTile> read_tiles(const fs::path& file) {
  std::vector<ComparableTile> tiles;
  try {
    Table<8> table(file.string());
    table.read_header(io::ignore_extra_column, "surface", "column", "row", "x", "y", "z", "irradiance",
                      "standard_error");
    std::string column, row, x, y, z, irradiance, error;
    ComparableTile tile;
    while (table.read_row(tile.surface, column, row, x, y, z, irradiance, error)) {
      tile.column = parse<std::uint32_t>(file, column);
      tile.row = parse<std::uint32_t>(file, row);
      tile.point = {parse<double>(file, x), parse<double>(file, y), parse<double>(file, z)};
      tile.irradiance = parse<double>(file, irradiance);
      tile.standard_error = parse<double>(file, error);
      tiles.push_back(tile);
    }
  } catch (const io::error::base& fault) {
    refuse(file, fault.what());
  }
  return tiles;
}

std::vector<ComparableReceiver> read_receivers(const fs::path& file) {
  std::vector<ComparableReceiver> receivers;
  try {
    Table<9> table(file.string());
    table.read_header(io::ignore_extra_column, "name", "x", "y", "z", "nx", "ny", "nz", "irradiance", "standard_error");
    std::string x, y, z, nx, ny, nz, irradiance, error;
    ComparableReceiver receiver;
    while (table.read_row(receiver.name, x, y, z, nx, ny, nz, irradiance, error)) {
      receiver.position = {parse<double>(file, x), parse<double>(file, y), parse<double>(file, z)};
      receiver.normal = {parse<double>(file, nx), parse<double>(file, ny), parse<double>(file, nz)};
      receiver.irradiance = parse<double>(file, irradiance);
      receiver.standard_error = parse<double>(file, error);
      receivers.push_back(receiver);
    }
  } catch (const io::error::base& fault) {
    refuse(file, fault.what());
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
    result.receiver_freedom =
        freedom_of_receivers(summary.at("backward").at("histories").get<std::uint64_t>(), result.receivers.size());
  } catch (const nlohmann::json::exception& fault) {
    refuse(file, fault.what());
  }
  return result;
}

}  // namespace lichtmc
