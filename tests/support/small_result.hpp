// An artificial result of a room, with everything that is difficult to write, and a folder to write it to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <system_error>

#include <unistd.h>

#include "lichtmc/cuboid.hpp"
#include "lichtmc/result.hpp"

namespace lichtmc::test {

// A temporary folder; the destructor removes it.
class Folder {
 public:
  Folder() {
    static int number = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("lichtmc_output_" + std::to_string(::getpid()) + "_" + std::to_string(number++));
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

// A tile map of 3 × 2 cells, the last without surface, on a surface with special characters in its name; and one of a
// single cell.
inline Tiling make_small_tiling() {
  Tiling tiling;
  TileMap tile_map;
  tile_map.name = "a \"b\", c/d";
  tile_map.columns = 3;
  tile_map.rows = 2;
  tile_map.uv_min = {0.1, 0.25};
  tile_map.uv_max = {0.7, 1.0};
  tile_map.tile_of_cell = {0, 1, 2, 3, 4, no_tile};
  tiling.maps.push_back(tile_map);
  TileMap back;
  back.name = "lamp.back";
  back.surface = 1;
  back.side = Side::back;
  back.chart = ChartSource::engine;
  back.chart_reason = "it has no UVs";
  back.tile_of_cell = {5};
  tiling.maps.push_back(back);
  for (std::uint32_t i = 0; i < 5; ++i) tiling.tiles.push_back({0, i % 3, i / 3, 0, {0.1 * i, -0.2, 1.0 / 3.0}, 0.01});
  tiling.tiles.push_back({1, 0, 0, 0, {1e-7, 2e20, 0.0}, 0.5});
  return tiling;
}

inline Result make_result() {
  Result result;
  result.room = "hall.glb";
  result.quantity = Quantity::radiometric;
  result.settings.seed = std::numeric_limits<std::uint64_t>::max();
  result.settings.estimator = Estimator::weight;
  result.walk.estimator = Estimator::weight;
  result.settings.max_bounces = 12;
  result.settings.tile_edge_m = 0.1;
  result.engine = Engine::cuboid;
  result.threads = 3;
  result.walk.stopped_by = StopReason::max_time;
  result.walk.histories = 1000;
  result.walk.impacts = 5000;
  result.walk.rays = 5001;
  result.walk.retraced = 1;
  result.lost_histories = 2;
  result.walk.seconds = 0.5;
  result.balance = {1.0, 0.7, 0.1, 0.1 + 0.2, 0.0};
  result.incident = 5.0 / 3.0;
  result.incident_standard_error = std::numeric_limits<double>::quiet_NaN();
  result.walk.rms_relative_error = 0.1;
  result.walk.figure_of_merit = std::numeric_limits<double>::infinity();
  result.tiles_without_hits = 1;
  result.tiling = make_small_tiling();
  for (std::size_t i = 0; i < 6; ++i)
    result.tiles.push_back({0.1 * static_cast<double>(i), 1.0 / (1.0 + static_cast<double>(i)), 1e-3, 100 + i});
  result.tiles[2] = {0.0, 0.0, std::numeric_limits<double>::quiet_NaN(), 0};
  result.surfaces.push_back({"a \"b\", c/d", "grey, \"warm\"", 0.6, 0.05, 5, 0.4, 0.0, 1.0, 0.01, 0.02, 0.0, 407});
  result.surfaces.back().absorbed = 0.008;
  result.surfaces.push_back(
      {"lamp.back", "", 0.1, 0.5, 1, 0.2, 0.2, 0.2, std::numeric_limits<double>::quiet_NaN(), 0.1, 1.0, 105});
  result.ignored = {{"A camera 'x' is not modelled.", Effect::none}};
  result.overrides = {"A lamp was added."};
  return result;
}

inline Room make_room() {
  Room room = make_cuboid({1.0, 1.0, 1.0}, uniform_reflectance(0.5));
  room.emitters.push_back({"sun", 0.75, IsotropicEmitter{}});
  room.emitters.push_back({"spot", 0.25, SpotEmitter{}});
  room.emitters.push_back({"beam", 0.0, LambertEmitter{}});
  room.emitters.push_back({"panel", 0.0, SurfaceEmitter{}});
  return room;
}

}  // namespace lichtmc::test
