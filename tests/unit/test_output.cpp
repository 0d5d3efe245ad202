#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <unistd.h>
#include <nlohmann/json.hpp>

#include "base/atomic_file.hpp"
#include "base/csv.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/output.hpp"
#include "lichtmc/version.hpp"
#include "output/tables.hpp"
#include "output/tile_image.hpp"
#include "support/catch.hpp"
#include "support/small_result.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

std::string tiles_csv_of(const Result& result) {
  std::string table;
  write_tiles_csv(result, [&table](std::string_view piece) { table += piece; });
  return table;
}

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  REQUIRE(in);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

std::set<std::string> files_below(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) names.insert(fs::relative(entry.path(), folder).string());
  }
  return names;
}

// Fields of a row of RFC 4180 without line breaks in fields.
std::vector<std::string> fields(const std::string& row) {
  std::vector<std::string> all(1);
  bool quoted = false;
  for (std::size_t k = 0; k < row.size(); ++k) {
    if (row[k] == '"') {
      if (quoted && k + 1 < row.size() && row[k + 1] == '"') {
        all.back() += row[k++];
      } else {
        quoted = !quoted;
      }
    } else if (row[k] == ',' && !quoted) {
      all.emplace_back();
    } else {
      all.back() += row[k];
    }
  }
  return all;
}

}  // namespace

TEST_CASE("tiles.csv has the documented columns and numbers that read back as the same") {
  const Result result = make_result();
  const auto rows = lines(tiles_csv_of(result));
  REQUIRE(rows.size() == 7);
  CHECK(rows[0] == "tile,surface,column,row,x,y,z,area,power,irradiance,standard_error,hits,unit");
  for (std::size_t i = 0; i < 6; ++i) {
    const auto row = fields(rows[i + 1]);
    REQUIRE(row.size() == 13);
    const Tile& tile = result.tiling.tiles[i];
    const TileResult& figures = result.tiles[i];
    CHECK(row[0] == std::to_string(i));
    CHECK(row[1] == result.tiling.maps[tile.map].name);
    CHECK(row[2] == std::to_string(tile.column));
    CHECK(row[3] == std::to_string(tile.row));
    CHECK(std::stod(row[4]) == tile.point.x);
    CHECK(std::stod(row[5]) == tile.point.y);
    CHECK(std::stod(row[6]) == tile.point.z);
    CHECK(std::stod(row[7]) == tile.area_m2);
    CHECK(std::stod(row[8]) == figures.power);
    CHECK(std::stod(row[9]) == figures.irradiance);
    CHECK((i == 2 ? row[10] == "nan" : std::stod(row[10]) == figures.standard_error));
    CHECK(row[11] == std::to_string(figures.hits));
    CHECK(row[12] == "W/m^2");
  }
}

TEST_CASE("surfaces.csv has the documented columns and quotes where necessary") {
  Result result = make_result();
  result.quantity = Quantity::photometric;
  const auto rows = lines(surfaces_csv(result));
  REQUIRE(rows.size() == 3);
  CHECK(rows[0] ==
        "name,material,reflectance,area,tiles,mean_irradiance,min_irradiance,max_irradiance,standard_error,power,"
        "behind_share,hits,unit,absorbed,unreached_area");
  CHECK(rows[1] == "\"a \"\"b\"\", c/d\",\"grey, \"\"warm\"\"\",0.6,0.05,5,0.4,0,1,0.01,0.02,0,407,lx,0.008,0");
  CHECK(rows[2] == "lamp.back,,0.1,0.5,1,0.2,0.2,0.2,nan,0.1,1,105,lx,nan,0");
}

TEST_CASE("a CSV field is quoted only if necessary") {
  CHECK(csv_field("plain name") == "plain name");
  CHECK(csv_field("") == "");
  CHECK(csv_field("a,b") == "\"a,b\"");
  CHECK(csv_field("a\"b") == "\"a\"\"b\"");
  CHECK(csv_field("a\nb") == "\"a\nb\"");
  CHECK(csv_field("a\rb") == "\"a\rb\"");
  CHECK(csv_field(" a") == "\" a\"");
}

TEST_CASE("summary.json has its keys in order with exact numbers and null for unknown values") {
  const Result result = make_result();
  const std::string text = summary_json(make_room(), result);
  const Json summary = Json::parse(text);
  const std::vector<std::string> first_keys{"version",
                                            "room",
                                            "unit",
                                            "engine",
                                            "estimator",
                                            "seed",
                                            "threads",
                                            "histories",
                                            "impacts",
                                            "rays",
                                            "seconds",
                                            "impacts_per_second",
                                            "emitted",
                                            "absorbed",
                                            "escaped",
                                            "residual",
                                            "lost",
                                            "incident",
                                            "incident_standard_error",
                                            "rms_relative_error",
                                            "figure_of_merit",
                                            "stopped_by",
                                            "surfaces",
                                            "receivers",
                                            "ignored"};
  std::vector<std::string> keys;
  for (const auto& item : summary.items()) keys.push_back(item.key());
  REQUIRE(keys.size() > first_keys.size());
  keys.resize(first_keys.size());
  CHECK(keys == first_keys);

  CHECK(summary["version"] == std::string(version()));
  CHECK(summary["room"] == "hall.glb");
  CHECK(summary["unit"] == "W");
  CHECK(summary["engine"] == "cuboid");
  CHECK(summary["estimator"] == "weight");
  CHECK(summary["seed"].get<std::uint64_t>() == std::numeric_limits<std::uint64_t>::max());
  CHECK(summary["histories"] == 1000);
  CHECK(summary["rays"] == 5001);
  CHECK(summary["impacts_per_second"].get<double>() == 10000.0);
  CHECK(summary["residual"].get<double>() == 0.1 + 0.2);
  CHECK(summary["incident"].get<double>() == 5.0 / 3.0);
  CHECK(summary["incident_standard_error"].is_null());
  CHECK(summary["figure_of_merit"].is_null());
  CHECK(summary["stopped_by"] == "max-time");
  CHECK(summary["receivers"] == Json::array());
  REQUIRE(summary["ignored"].size() == result.ignored.size());
  CHECK(summary["ignored"][0] == result.ignored[0].what);
  CHECK(summary["mended"] == Json(result.overrides));
  CHECK(summary["retraced"] == 1);
  CHECK(summary["lost_histories"] == 2);
  CHECK(summary["tiles_count"] == 6);
  CHECK(summary["tiles_without_hits"] == 1);
  CHECK(summary["tile_edge_m"].get<double>() == 0.1);
  CHECK(summary["max_bounces"] == 12);
  CHECK(text.find("\n  \"room\": ") != std::string::npos);
}

TEST_CASE("summary.json lists surfaces with their files and emitters with their kinds") {
  const Json summary = Json::parse(summary_json(make_room(), make_result()));
  const Json& surfaces = summary["surfaces"];
  REQUIRE(surfaces.size() == 2);
  CHECK(surfaces[0]["name"] == "a \"b\", c/d");
  CHECK(surfaces[0]["file"] == "tiles/a__b___c_d.exr");
  CHECK_FALSE(surfaces[0].contains("chart"));
  CHECK(surfaces[1]["chart"].get<std::string>().find("it has no UVs") != std::string::npos);
  CHECK(surfaces[1]["standard_error"].is_null());
  CHECK(surfaces[1]["hits"] == 105);
  const Json& emitters = summary["emitters"];
  REQUIRE(emitters.size() == 4);
  const std::array<const char*, 4> kinds{"isotropic", "spot", "lambert", "surface"};
  for (std::size_t k = 0; k < 4; ++k) CHECK(emitters[k]["kind"] == kinds[k]);
  CHECK(emitters[0]["name"] == "sun");
  CHECK(emitters[0]["power"].get<double>() == 0.75);
}

TEST_CASE("summary.json has a unit for every column that has one") {
  for (const Quantity quantity : {Quantity::radiometric, Quantity::photometric}) {
    Result result = make_result();
    result.quantity = quantity;
    const Json units = Json::parse(summary_json(make_room(), result))["units"];
    const std::string irradiance(irradiance_unit(quantity));
    for (const char* column : {"irradiance", "standard_error", "mean_irradiance", "min_irradiance", "max_irradiance"})
      CHECK(units[column] == irradiance);
    for (const char* column : {"power", "emitted", "absorbed", "escaped", "residual", "lost", "incident"})
      CHECK(units[column] == std::string(power_unit(quantity)));
    for (const char* column : {"x", "y", "z", "tile_edge_m"}) CHECK(units[column] == "m");
    CHECK(units["area"] == "m^2");
    CHECK(units["seconds"] == "s");
  }
}

TEST_CASE("summary.json is valid JSON for names of any bytes and for the shortest run") {
  Result result = make_result();
  result.room = "r\xFFm\n\"\\";
  result.walk.seconds = 0.0;
  result.walk.impacts = 0;
  result.settings.max_bounces.reset();
  const Json summary = Json::parse(summary_json(make_room(), result));
  CHECK(summary["room"] == "r\xEF\xBF\xBDm\n\"\\");
  CHECK(summary["impacts_per_second"].is_null());
  CHECK(summary["max_bounces"].is_null());
}

TEST_CASE("the output folder contains exactly the files of this run") {
  const Folder folder;
  const std::set<std::string> expected{"emitters.csv", "summary.json",         "surfaces.csv",
                                       "tiles.csv",    "tiles/a__b___c_d.exr", "tiles/lamp.back.exr"};
  const fs::path out = folder.path() / "deep" / "out";
  {
    const FolderLock lock = prepare_output(out);
    CHECK(files_below(out) == std::set<std::string>{".lichtmc.lock"});
    write_results(make_room(), make_result(), out);
  }
  CHECK(files_below(out) == expected);
  CHECK(content(out / "tiles.csv") == tiles_csv_of(make_result()));
  CHECK(content(out / "surfaces.csv") == surfaces_csv(make_result()));
  CHECK(content(out / "summary.json") == summary_json(make_room(), make_result()));
}

TEST_CASE("without images of the tile maps those of an earlier run are removed, and the summary says so") {
  const Folder folder;
  write_results(make_room(), make_result(), folder.path());
  write_results(make_room(), make_result(), folder.path(), {.tile_images = false});
  CHECK(files_below(folder.path()) ==
        std::set<std::string>{"emitters.csv", "summary.json", "surfaces.csv", "tiles.csv"});
  CHECK_FALSE(fs::exists(folder.path() / "tiles"));
  const Json summary = Json::parse(content(folder.path() / "summary.json"));
  CHECK(summary["tile_images"] == false);
  for (const Json& surface : summary["surfaces"]) CHECK(surface["file"].is_null());
}

TEST_CASE("more files than are flushed one by one are written completely") {
  const Folder folder;
  const Result one = make_result();
  Result result = one;
  // 40 maps with the tiles of one: only their images count here.
  for (int k = 0; k < 38; ++k) {
    result.tiling.maps.push_back(one.tiling.maps[0]);
    result.surfaces.push_back(one.surfaces[0]);
  }
  write_results(make_room(), result, folder.path());
  CHECK(files_below(folder.path()).size() == 40 + 4);
  CHECK(content(folder.path() / "tiles" / "a__b___c_d_39.exr") == tile_image(result, 39));
}

TEST_CASE("tile maps of an earlier run are removed and other files stay") {
  const Folder folder;
  fs::create_directories(folder.path() / "tiles" / "folder.exr");
  for (const char* name : {"tiles/old.exr", "tiles/notes.txt", "tiles/folder.exr/inside.exr", "other.exr"})
    std::ofstream(folder.path() / name) << "x";
  static_cast<void>(prepare_output(folder.path()));
  CHECK(fs::exists(folder.path() / "tiles" / "old.exr"));
  write_results(make_room(), make_result(), folder.path());
  CHECK(files_below(folder.path()) == std::set<std::string>{"emitters.csv", "other.exr", "summary.json", "surfaces.csv",
                                                            "tiles.csv", "tiles/a__b___c_d.exr",
                                                            "tiles/folder.exr/inside.exr", "tiles/lamp.back.exr",
                                                            "tiles/notes.txt"});
}

TEST_CASE("temporary files of killed runs are removed, and nothing else") {
  const Folder folder;
  // A process with our number in another container left a staging folder; a dead process left another, and an
  // incomplete state.
  const fs::path ours = folder.path() / (".lichtmc-" + std::to_string(::getpid()));
  constexpr const char* no_process = "2147483646";  // beyond Linux's process numbers
  for (const fs::path& stage : {ours, folder.path() / (std::string(".lichtmc-") + no_process)}) {
    fs::create_directories(stage);
    std::ofstream(stage / "receivers.csv") << "of another run";
  }
  fs::create_directories(folder.path() / (std::string("backup.tmp") + no_process));
  for (const char* name : {"state.h5.tmp", "state.h5.tmp2147483646.tmp", "notes.tmp", "backup.tmp2147483646/kept"})
    std::ofstream(folder.path() / (std::string(name) + no_process)) << "x";
  std::ofstream(folder.path() / ("state.h5.tmp" + std::to_string(::getppid()))) << "of a run that goes on";
  static_cast<void>(prepare_output(folder.path()));
  write_results(make_room(), make_result(), folder.path());
  CHECK(files_below(folder.path()) ==
        std::set<std::string>{"backup.tmp2147483646/kept2147483646", "notes.tmp2147483646",
                              "state.h5.tmp" + std::to_string(::getppid()), "emitters.csv", "summary.json",
                              "surfaces.csv", "tiles.csv", "tiles/a__b___c_d.exr", "tiles/lamp.back.exr"});
}

TEST_CASE("a run that cannot be written leaves no summary and no temporary file") {
  const Folder folder;
  write_results(make_room(), make_result(), folder.path());
  // A folder has the name of surfaces.csv.
  fs::remove(folder.path() / "surfaces.csv");
  fs::create_directories(folder.path() / "surfaces.csv" / "x");
  CHECK_THROWS_AS(write_results(make_room(), make_result(), folder.path()), RuntimeError);
  CHECK_THROWS_WITH(write_results(make_room(), make_result(), folder.path()), ContainsSubstring("surfaces.csv"));
  const auto left = files_below(folder.path());
  CHECK(left.count("summary.json") == 0);
  for (const std::string& name : left) CHECK(name.find("tmp") == std::string::npos);
}

TEST_CASE("an output folder that cannot be written is refused with its name and the reason") {
  const Folder folder;
  const fs::path file = folder.path() / "file";
  std::ofstream(file) << "x";
  for (const fs::path& wrong : {file, file / "below"}) {
    CHECK_THROWS_AS(static_cast<void>(prepare_output(wrong)), InputError);
    CHECK_THROWS_WITH(static_cast<void>(prepare_output(wrong)), ContainsSubstring(wrong.string()) &&
                                                                    ContainsSubstring("(not a directory)") &&
                                                                    ContainsSubstring("--output"));
  }
  CHECK(content(file) == "x");
  fs::create_directories(folder.path() / "out");
  std::ofstream(folder.path() / "out" / "tiles") << "x";
  CHECK_THROWS_AS(static_cast<void>(prepare_output(folder.path() / "out")), InputError);
  CHECK_THROWS_WITH(static_cast<void>(prepare_output(folder.path() / "out")), ContainsSubstring("tiles"));
}

TEST_CASE("an output folder without permission to write is refused with that reason") {
  if (::geteuid() == 0) {
    WARN("skipped: root may write everywhere");
    return;
  }
  const Folder folder;
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  CHECK_THROWS_WITH(static_cast<void>(prepare_output(folder.path())), ContainsSubstring("(permission denied)"));
  fs::permissions(folder.path(), fs::perms::owner_all);
}

TEST_CASE("a file is replaced completely or does not change") {
  const Folder folder;
  const fs::path file = folder.path() / "a.txt";
  write_file_atomically(file, "first");
  write_file_atomically(file, std::string_view("\0\n", 2));
  CHECK(content(file) == std::string("\0\n", 2));
  CHECK_THROWS_AS(write_file_atomically(folder.path() / "none" / "a.txt", "x"), RuntimeError);
  CHECK_THROWS_WITH(write_file_atomically(folder.path() / "none" / "a.txt", "x"), ContainsSubstring("none/a.txt"));
  CHECK(files_below(folder.path()) == std::set<std::string>{"a.txt"});
}
