#include "lichtmc/paths.hpp"

#include <algorithm>
#include <iterator>
#include <new>
#include <string>

#include "chance/moments.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/tiles.hpp"
#include "run/settings_check.hpp"
#include "walk/path_walk.hpp"

namespace lichtmc {

namespace {

constexpr std::uint64_t most_paths = 1'000'000;
constexpr std::uint32_t longest_path =
    10'000;  // flights; limits histories without absorption, and no picture shows more

}  // namespace

std::string_view to_string(PathEnd end) {
  switch (end) {
    case PathEnd::absorbed:
      return "absorbed";
    case PathEnd::escaped:
      return "escaped";
    case PathEnd::cut_off:
      return "cut off";
    case PathEnd::lost:
      return "lost";
  }
  return "";
}

std::vector<PhotonPath> trace_paths(const Room& room, const Settings& settings, std::uint64_t count) {
  if (count < 1 || count > most_paths)
    throw InputError("The number of paths is " + std::to_string(count) +
                     " (allowed: 1 to 1000000). Give another number.");
  check_settings(settings);
  check_room(room);
  try {
    const Scene scene(room, make_tiling(room, settings.tile_edge_m), settings.engine);
    const std::uint32_t most_flights = std::min(settings.max_bounces.value_or(longest_path), longest_path);
    std::vector<PhotonPath> paths;
    for (std::uint64_t first = 0; first < count; first += batch_histories) {
      const auto n = static_cast<std::uint32_t>(std::min<std::uint64_t>(batch_histories, count - first));
      std::vector<PhotonPath> more = walk_paths(room, scene, settings, most_flights, first, n);
      std::move(more.begin(), more.end(), std::back_inserter(paths));
    }
    return paths;
  } catch (const std::bad_alloc&) {
    throw RuntimeError("There is not enough memory for " + std::to_string(count) + " paths. Give a smaller number.");
  }
}

}  // namespace lichtmc
