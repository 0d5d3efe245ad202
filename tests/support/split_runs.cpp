#include "support/split_runs.hpp"

#include <cstring>
#include <filesystem>
#include <string>

#include <unistd.h>

#include "support/rooms.hpp"

namespace lichtmc::test {

namespace {

bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

Surface make_board() {
  Surface board;
  board.name = "board";
  board.positions = {{0.2, 1.0, 0.2}, {0.8, 1.0, 0.2}, {0.8, 1.0, 1.2}, {0.2, 1.0, 1.2}};
  board.triangles = {{0, 1, 2}, {0, 2, 3}};
  return board;
}

}  // namespace

bool same_figures(const Result& a, const Result& b) {
  if (a.tiles.size() != b.tiles.size() || a.receiver_results.size() != b.receiver_results.size()) return false;
  for (std::size_t i = 0; i < a.tiles.size(); ++i) {
    if (!same_bits(a.tiles[i].power, b.tiles[i].power) || a.tiles[i].hits != b.tiles[i].hits ||
        !same_bits(a.tiles[i].standard_error, b.tiles[i].standard_error))
      return false;
  }
  for (std::size_t i = 0; i < a.surfaces.size(); ++i) {
    if (!same_bits(a.surfaces[i].standard_error, b.surfaces[i].standard_error) ||
        !same_bits(a.surfaces[i].behind_share, b.surfaces[i].behind_share) ||
        !same_bits(a.surfaces[i].absorbed, b.surfaces[i].absorbed))
      return false;
  }
  for (std::size_t i = 0; i < a.receiver_results.size(); ++i) {
    if (!same_bits(a.receiver_results[i].irradiance, b.receiver_results[i].irradiance) ||
        !same_bits(a.receiver_results[i].standard_error, b.receiver_results[i].standard_error))
      return false;
  }
  return a.walk.histories == b.walk.histories && a.walk.impacts == b.walk.impacts &&
         a.receiver_walk.histories == b.receiver_walk.histories && same_bits(a.incident, b.incident) &&
         same_bits(a.incident_standard_error, b.incident_standard_error) &&
         same_bits(a.balance.absorbed, b.balance.absorbed) && same_bits(a.balance.residual, b.balance.residual);
}

Room room_to_split(Furniture furniture) {
  Room room = make_cuboid({1.0, 2.0, 1.5}, {0.3, 0.8, 0.5, 0.6, 0.7, 0.4});
  room.emitters.push_back(lambert({0.4, 1.5, 0.7}, {0.1, -1, 0.2}, 2.0, 3.0));
  room.emitters.push_back(isotropic({0.6, 0.5, 0.5}, 1.0));
  room.receivers.push_back({"desk", {0.5, 0.8, 0.7}, {0, 1, 0}, 90.0, 1.0});
  room.receivers.push_back({"eye", {0.2, 1.2, 1.1}, {1, 0.2, 0}, 60.0, 1.0});
  if (furniture == Furniture::none) return room;
  Surface board = make_board();
  if (furniture == Furniture::textured_board) {
    room = without_surface(std::move(room), "ceiling");
    board.sides = Sides::both;
    board.reflectance_map = 0;
    board.reflectance_uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    room.reflectance_maps.push_back({"chequers", 2, 2, {0.9F, 0.2F, 0.3F, 0.8F}});
    board.reflectance = 0.55;
  }
  room.surfaces.push_back(board);
  return room;
}

std::vector<SplitRun> split_runs() {
  std::vector<SplitRun> all;
  for (const Estimator estimator : {Estimator::weight, Estimator::collision, Estimator::absorption})
    all.push_back({Furniture::none, settings_of(estimator, Engine::cuboid, 50'001, 7)});
  for (const Estimator estimator : {Estimator::weight, Estimator::collision})
    all.push_back({Furniture::board, settings_of(estimator, Engine::embree, 50'001, 7, 0.02)});
  for (const Estimator estimator : {Estimator::collision, Estimator::absorption})
    all.push_back({Furniture::textured_board, settings_of(estimator, Engine::embree, 50'001, 11, 0.05)});
  all.push_back({Furniture::board, settings_of(Estimator::collision, Engine::embree, 50'001, 8)});
  all.back().settings.direct = Direct::analytic;
  all.push_back({Furniture::none, settings_of(Estimator::weight, Engine::cuboid, 50'001, 9)});
  all.back().settings.max_bounces = 4;
  all.push_back({Furniture::board, settings_of(Estimator::collision, Engine::embree, 50'001, 10, 0.3)});
  all.back().settings.tile_walk = WalkDirection::backward;
  for (SplitRun& split : all) split.settings.measured = Measured::all;
  return all;
}

State written_and_read(const State& state) {
  const auto file = std::filesystem::temp_directory_path() / ("lichtmc_state_" + std::to_string(::getpid()) + ".h5");
  write_state(state, file);
  State read = read_state(file);
  std::filesystem::remove(file);
  return read;
}

Result part(const Room& room, Settings settings, std::uint64_t first, std::uint64_t last) {
  settings.first_history = first;
  settings.photons = last - first;
  settings.part = true;
  return simulate(room, settings);
}

}  // namespace lichtmc::test
