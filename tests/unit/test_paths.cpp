#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "lichtmc/error.hpp"
#include "lichtmc/lichtmc.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

// Flights that ended on each surface.
std::map<std::string, std::uint64_t> impacts_of(const Room& room, const std::vector<PhotonPath>& paths) {
  std::map<std::string, std::uint64_t> impacts;
  for (const PhotonPath& path : paths) {
    for (std::size_t k = 1; k < path.points.size(); ++k) {
      if (path.points[k].surface != no_surface) ++impacts[room.surfaces[path.points[k].surface].name];
    }
  }
  return impacts;
}

}  // namespace

TEST_CASE("paths: they equal those of the run with the same settings, impact by impact") {
  // 3000: the third batch is incomplete.
  for (const Engine engine : {Engine::cuboid, Engine::embree}) {
    const Room room = unit_cube(0.6, paper_emitter());
    const Settings settings = settings_of(Estimator::collision, engine, 3000, 5);
    const Result run = simulate(room, settings);
    const std::vector<PhotonPath> paths = trace_paths(room, settings, 3000);
    REQUIRE(paths.size() == 3000);
    const auto impacts = impacts_of(room, paths);
    for (const SurfaceResult& surface : run.surfaces) CHECK(impacts.at(surface.name) == surface.hits);
    for (std::size_t k = 0; k < paths.size(); ++k) {
      CHECK(paths[k].history == k);
      CHECK(paths[k].end == PathEnd::absorbed);
      CHECK(paths[k].points.front().surface == no_surface);
    }
  }
}

TEST_CASE("paths: with openings, emissive surfaces and textures too") {
  for (const char* scene : {"living_room.glb", "l_room.gltf"}) {
    const Room room = read_gltf(std::string(LICHTMC_SCENES) + "/" + scene);
    const Settings settings = settings_of(Estimator::collision, Engine::automatic, 4096, 2);
    const Result run = simulate(room, settings);
    const std::vector<PhotonPath> paths = trace_paths(room, settings, 4096);
    std::uint64_t flights = 0;
    std::uint64_t escaped = 0;
    for (const auto& [name, count] : impacts_of(room, paths)) flights += count;
    for (const PhotonPath& path : paths) {
      escaped += path.end == PathEnd::escaped ? 1 : 0;
      for (const PathPoint& point : path.points) CHECK(std::isfinite(point.place.x + point.place.y + point.place.z));
    }
    CHECK(flights == run.walk.impacts);
    CHECK(static_cast<double>(escaped) / 4096.0 == Approx(run.balance.escaped / run.balance.emitted));
  }
}

TEST_CASE("paths: points lie on the surfaces that they name, and flights between them are straight") {
  const Room room = unit_cube(0.6, paper_emitter());
  for (const PhotonPath& path : trace_paths(room, settings_of(Estimator::collision, Engine::embree, 100, 1), 100)) {
    CHECK(glm::length(path.points.front().place - glm::dvec3(0.5)) < 1e-6);
    for (std::size_t k = 1; k < path.points.size(); ++k) {
      const glm::dvec3 p = path.points[k].place;
      const std::string& name = room.surfaces[path.points[k].surface].name;
      const double off = name == "floor"     ? p.y
                         : name == "ceiling" ? p.y - 1.0
                         : name == "wall_x0" ? p.x
                         : name == "wall_x1" ? p.x - 1.0
                         : name == "wall_z0" ? p.z
                                             : p.z - 1.0;
      CHECK(std::abs(off) < 1e-6);
    }
  }
}

TEST_CASE("paths: weights are multiplied by the reflectance, and truncated histories are marked") {
  const Room room = unit_cube(0.5, paper_emitter());
  Settings settings = settings_of(Estimator::weight, Engine::automatic, 10, 1);
  settings.max_bounces = 4;
  for (const PhotonPath& path : trace_paths(room, settings, 10)) {
    REQUIRE(path.points.size() == 5);
    CHECK(path.end == PathEnd::cut_off);
    for (std::size_t k = 1; k < 5; ++k) CHECK(path.points[k].weight == std::ldexp(1.0, 1 - static_cast<int>(k)));
  }
}

TEST_CASE("paths: a history without absorption ends after 10 000 flights") {
  const Room room = unit_cube(1.0, paper_emitter());
  const std::vector<PhotonPath> paths =
      trace_paths(room, settings_of(Estimator::collision, Engine::automatic, 2, 1), 2);
  CHECK(paths[1].points.size() == 10'001);
  CHECK(paths[1].end == PathEnd::cut_off);
}

TEST_CASE("paths: none, or more than a million, are refused") {
  const Room room = unit_cube(0.5, paper_emitter());
  CHECK_THROWS_AS(trace_paths(room, {}, 0), InputError);
  CHECK_THROWS_AS(trace_paths(room, {}, 1'000'001), InputError);
}
