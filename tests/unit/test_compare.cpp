// Comparison of results.
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

#include "lichtmc/error.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

namespace fs = std::filesystem;

// A folder of results, removed at the end.
class Folder {
 public:
  Folder(const std::string& name, const Room& room, const Settings& settings)
      : path_(fs::temp_directory_path() / ("lichtmc_compare_" + std::to_string(getpid()) + "_" + name)) {
    fs::remove_all(path_);
    static_cast<void>(prepare_output(path_));
    write_results(room, simulate(room, settings), path_);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

Settings seeded(std::uint64_t seed) {
  return settings_of(Estimator::collision, Engine::automatic, 2e5, seed, 0.25);
}

}  // namespace

TEST_CASE("compare: two seeds agree, one percent more power does not") {
  Room room = unit_cube(0.6, paper_emitter());
  const Folder a("a", room, seeded(1));
  const Folder b("b", room, seeded(2));
  const std::vector<Comparison> comparisons = compare_results(a.path(), b.path());
  REQUIRE(comparisons.size() == 1);
  const Comparison& tiles = comparisons[0];
  CHECK(tiles.what == ComparisonOf::tiles);
  CHECK(tiles.figures.size() == 96);
  CHECK(tiles.agree);
  CHECK(tiles.chi_square > 40.0);
  CHECK(tiles.chi_square_chance < 1.0);
  CHECK(std::abs(tiles.difference) < 5.0 * tiles.difference_error);

  room.emitters[0].power = 1.05;
  const Folder c("c", room, seeded(3));
  const Comparison brighter = compare_results(a.path(), c.path())[0];
  CHECK_FALSE(brighter.agree);
  CHECK(brighter.difference == Approx(0.05).margin(0.01));
  CHECK(brighter.chi_square_chance < comparison_false_alarm);
}

TEST_CASE("compare: receivers with receivers, and with the tiles at their positions") {
  Room room = unit_cube(0.6, isotropic({0.5, 0.5, 0.5}));
  const Folder tiles("tiles", room, [] {
    Settings settings = seeded(4);
    settings.photons = 2'000'000;
    settings.tile_edge_m = 0.1;
    return settings;
  }());
  for (int k = 0; k < 5; ++k)
    room.receivers.push_back({"r" + std::to_string(k), {0.15 + 0.1 * k, 0.0, 0.35}, {0, 1, 0}, 90.0, 1.0});
  room.receivers.push_back({"nowhere", {0.5, 0.5, 0.4}, {0, 1, 0}, 90.0, 1.0});
  Settings settings = seeded(5);
  settings.measured = Measured::receivers;
  const Folder first("first", room, settings);
  settings.seed = 6;
  const Folder second("second", room, settings);
  const Comparison same = compare_results(first.path(), second.path())[0];
  CHECK(same.what == ComparisonOf::receivers);
  CHECK(same.figures.size() == 6);
  CHECK(same.agree);
  const Comparison across = compare_results(tiles.path(), first.path())[0];
  CHECK(across.what == ComparisonOf::tiles_at_receivers);
  CHECK(across.figures.size() == 5);
  CHECK(across.unmatched == 1);
  CHECK(across.agree);
  const Comparison back = compare_results(first.path(), tiles.path())[0];
  CHECK(back.largest_z == Approx(-across.largest_z).epsilon(1e-12));
}

TEST_CASE("compare: two results in memory give the figures of their files") {
  Room room = unit_cube(0.6, paper_emitter());
  room.receivers.push_back({"desk", {0.5, 0.2, 0.4}, {0, 1, 0}, 90.0, 1.0});
  Settings settings = seeded(7);
  settings.measured = Measured::all;
  const Folder file_a("memory_a", room, settings);
  const Result a = simulate(room, settings);
  settings.seed = 8;
  const Folder file_b("memory_b", room, settings);
  const Result b = simulate(room, settings);
  const std::vector<Comparison> of_files = compare_results(file_a.path(), file_b.path());
  const std::vector<Comparison> in_memory = compare(a, b);
  REQUIRE(in_memory.size() == 2);
  REQUIRE(of_files.size() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(in_memory[k].what == of_files[k].what);
    CHECK(in_memory[k].figures.size() == of_files[k].figures.size());
    CHECK(in_memory[k].chi_square == of_files[k].chi_square);
    CHECK(in_memory[k].largest_z == of_files[k].largest_z);
    CHECK(in_memory[k].chi_square_chance == of_files[k].chi_square_chance);
  }
}

TEST_CASE("compare: results that cannot be compared are refused with the reason") {
  Room room = unit_cube(0.6, paper_emitter());
  const Folder a("a", room, seeded(1));
  CHECK_THROWS_WITH(compare_results(a.path(), fs::temp_directory_path() / "lichtmc_nothing"),
                    ContainsSubstring("summary.json") && ContainsSubstring("lichtmc run"));
  Settings finer = seeded(2);
  finer.tile_edge_m = 0.2;
  const Folder other("other", room, finer);
  CHECK_THROWS_WITH(compare_results(a.path(), other.path()), ContainsSubstring("96 and 150"));
  Settings few = seeded(3);
  few.photons = 1000;  // one batch: its errors are unknown
  const Folder unsure("unsure", room, few);
  CHECK_THROWS_WITH(compare_results(unsure.path(), unsure.path()), ContainsSubstring("Nothing in"));
  std::ofstream(a.path() / "tiles.csv") << "tile,surface\n0,floor\n";
  CHECK_THROWS_WITH(compare_results(a.path(), a.path()), ContainsSubstring("tiles.csv"));
}
