#include "support/rooms.hpp"

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace lichtmc::test {

Room unit_cube(double reflectance, Emitter emitter) {
  Room room = make_cuboid({1.0, 1.0, 1.0}, uniform_reflectance(reflectance));
  room.quantity = Quantity::radiometric;
  room.emitters.push_back(std::move(emitter));
  return room;
}

Emitter isotropic(const glm::dvec3& position, double power) {
  return {"isotropic", power, IsotropicEmitter{position}};
}

Emitter lambert(const glm::dvec3& position, const glm::dvec3& axis, double exponent, double power) {
  return {"lambert", power, LambertEmitter{position, axis, exponent}};
}

Emitter surface_emitter(std::size_t surface, double power, double exponent) {
  return {"surface", power, SurfaceEmitter{surface, exponent}};
}

Emitter paper_emitter() {
  return lambert({0.5, 0.5, 0.5}, {0.0, -1.0, 0.0}, 5.0);
}

Room without_surface(Room room, const std::string& name) {
  const std::size_t k = surface_number(room, name);
  room.surfaces.erase(room.surfaces.begin() + static_cast<std::ptrdiff_t>(k));
  for (Emitter& emitter : room.emitters) {
    auto* surface = std::get_if<SurfaceEmitter>(&emitter.shape);
    if (surface != nullptr && surface->surface > k) --surface->surface;
  }
  return room;
}

Settings settings_of(Estimator estimator, Engine engine, double photons, std::uint64_t seed, double tile_edge_m) {
  Settings settings;
  settings.estimator = estimator;
  settings.engine = engine;
  settings.photons = static_cast<std::uint64_t>(photons);
  settings.seed = seed;
  settings.tile_edge_m = tile_edge_m;
  settings.measured = Measured::tiles;
  return settings;
}

std::size_t surface_number(const Room& room, std::string_view name) {
  for (std::size_t k = 0; k < room.surfaces.size(); ++k) {
    if (room.surfaces[k].name == name) return k;
  }
  throw std::logic_error("no surface " + std::string(name));
}

const SurfaceResult& surface_named(const Result& result, std::string_view name) {
  for (const SurfaceResult& surface : result.surfaces) {
    if (surface.name == name) return surface;
  }
  throw std::logic_error("no surface " + std::string(name));
}

std::vector<Compared> against(const Result& result, const std::string& tile_map,
                              const std::function<double(const Tile&)>& expected) {
  constexpr double enough_hits = 50.0;
  std::vector<Compared> figures;
  Compared pool;  // powers; the error's square
  double pool_area = 0.0;
  const double hits_per_power = static_cast<double>(result.walk.histories) / result.balance.emitted;
  for (std::size_t i = 0; i < result.tiles.size(); ++i) {
    const Tile& tile = result.tiling.tiles[i];
    if (result.tiling.maps[tile.map].name != tile_map) continue;
    pool.value += result.tiles[i].power;
    pool.expected += expected(tile) * tile.area_m2;
    if (result.tiles[i].hits > 0) pool.standard_error += std::pow(result.tiles[i].standard_error * tile.area_m2, 2);
    pool_area += tile.area_m2;
    if (pool.expected > 0.0 && pool.expected * hits_per_power < enough_hits) continue;
    figures.push_back(
        {pool.value / pool_area, std::sqrt(pool.standard_error) / pool_area, pool.expected / pool_area, 0.0});
    pool = {};
    pool_area = 0.0;
  }
  return figures;
}

std::vector<Compared> against(const Result& a, const Result& b) {
  if (a.tiles.size() != b.tiles.size()) throw std::logic_error("different tiles");
  std::vector<Compared> figures;
  for (std::size_t i = 0; i < a.tiles.size(); ++i) {
    figures.push_back(
        {a.tiles[i].irradiance, a.tiles[i].standard_error, b.tiles[i].irradiance, b.tiles[i].standard_error});
  }
  return figures;
}

double tile_mean(const glm::dvec3& centre, const glm::dvec3& half_u, const glm::dvec3& half_v, int n,
                 const std::function<double(const glm::dvec3&)>& f) {
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      sum += f(centre + (2.0 * (i + 0.5) / n - 1.0) * half_u + (2.0 * (j + 0.5) / n - 1.0) * half_v);
    }
  }
  return sum / (n * n);
}

std::vector<std::vector<double>> read_table(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot open " + file);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream fields(line);
    std::vector<double> row;
    for (std::string field; std::getline(fields, field, ',');) row.push_back(std::stod(field));
    rows.push_back(row);
  }
  return rows;
}

}  // namespace lichtmc::test
