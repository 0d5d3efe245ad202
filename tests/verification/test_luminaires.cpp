// Measured luminaires: tiles and receivers by all walks against the exact illuminance, direct and once reflected.
//
// The room is a black floor and one reflecting wall, both flat: light is reflected once. The exact values are sums over
// midpoints of the wall, through the table's intensity, whose values have tests of their own.
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "lichtmc/photometry.hpp"
#include "support/catch.hpp"
#include "support/luminaires.hpp"
#include "support/rooms.hpp"
#include "support/verdict.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double reflectance = 0.7;
constexpr double half_width = 3.0;  // m, of floor and wall
constexpr double wall_z = -2.0;     // m
constexpr double wall_height = 3.0;

const std::vector<std::string> files{"c_skew.ies",   "c_lambert.ies", "c_90_270.ies",      "c_0_180.ies",
                                     "c_typeb.ies",  "c_typea.ies",   "c_v86_factors.ies", "c_ldt_comma.ldt",
                                     "c_ldt_up.ldt", "c_ldt_abs.ldt"};

std::shared_ptr<const Photometry> luminaire(const std::string& file) {
  return std::make_shared<const Photometry>(read_photometry(std::string(LICHTMC_TEST_DATA) + "/luminaires/" + file));
}

// A rectangle with a corner and two edges; its front is along u × v.
Surface rectangle(const std::string& name, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v,
                  double rho) {
  Surface surface;
  surface.name = name;
  surface.reflectance = rho;
  surface.positions = {corner, corner + u, corner + v, corner + u + v};
  surface.uvs = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  surface.triangles = {{0, 1, 2}, {2, 1, 3}};
  return surface;
}

Room floor_and_wall(const Emitter& emitter) {
  Room room;
  room.source = "floor and wall";
  room.surfaces = {
      rectangle("floor", {-half_width, 0, wall_z}, {0, 0, 5}, {2 * half_width, 0, 0}, 0.0),
      rectangle("wall", {-half_width, 0, wall_z}, {2 * half_width, 0, 0}, {0, wall_height, 0}, reflectance)};
  room.emitters = {emitter};
  return room;
}

// Narrow beams (types A and B) aim at the wall, others at the floor.
Emitter mounted(std::shared_ptr<const Photometry> photometry, const glm::dvec3& position, bool area = false) {
  const bool narrow = photometry->candela->grid().type != PhotometricType::c;
  const glm::dvec3 aim = narrow ? glm::dvec3(0.2, -0.5, -1.0) : glm::dvec3(0.2, -1.0, -0.15);
  LuminaireOptions options;
  options.rotation_deg = 25.0;
  options.area = area;
  const LuminaireEmitter found = mount(std::move(photometry), position, axes_towards(aim), options, "test");
  return {"luminaire", found.power, found.shape};
}

// The illuminance by a luminaire at one of its points, without reflection.
double direct_from(const Emitter& emitter, const glm::dvec3& from, const glm::dvec3& point, const glm::dvec3& normal) {
  const auto& shape = std::get<MeasuredEmitter>(emitter.shape);
  const CandelaTable& table = *shape.photometry->candela;
  const glm::dvec3 way = point - from;
  const double distance = glm::length(way);
  const glm::dvec3 d = way / distance;
  const double cosine = -glm::dot(d, normal);
  if (!(cosine > 0.0)) return 0.0;
  const glm::dvec3 local(glm::dot(d, shape.c0), glm::dot(d, shape.c90), glm::dot(d, shape.axis));
  return emitter.power / table.flux() * table.candela(local) * cosine / (distance * distance);
}

// The illuminance by the wall, and by the luminaire itself.
class Exact {
 public:
  using Direct = std::function<double(const glm::dvec3& point, const glm::dvec3& normal)>;

  explicit Exact(Direct direct) : direct_(std::move(direct)) {
    for (int i = 0; i < columns; ++i) {
      for (int j = 0; j < rows; ++j) {
        const glm::dvec3 p(-half_width + 2 * half_width * (i + 0.5) / columns, wall_height * (j + 0.5) / rows, wall_z);
        const double area = 2 * half_width * wall_height / (columns * rows);
        parts_.push_back({p, reflectance / pi * area * direct_(p, {0, 0, 1})});
      }
    }
  }
  double direct(const glm::dvec3& point, const glm::dvec3& normal) const { return direct_(point, normal); }
  double reflected(const glm::dvec3& point, const glm::dvec3& normal) const {
    double sum = 0.0;
    for (const Part& part : parts_) {
      const glm::dvec3 way = point - part.place;
      const double cosines = way.z * -glm::dot(way, normal);
      const double squared = glm::dot(way, way);
      if (way.z > 0.0 && cosines > 0.0) sum += part.intensity * cosines / (squared * squared);
    }
    return sum;
  }

 private:
  static constexpr int columns = 120;
  static constexpr int rows = 60;
  struct Part {
    glm::dvec3 place;
    double intensity;  // along the normal of the wall
  };
  Direct direct_;
  std::vector<Part> parts_;
};

Exact exact_of_point(const Emitter& emitter) {
  const glm::dvec3 position = std::get<MeasuredEmitter>(emitter.shape).position;
  return Exact([emitter, position](const glm::dvec3& point, const glm::dvec3& normal) {
    return direct_from(emitter, position, point, normal);
  });
}

// The exact mean over a square tile of the floor: direct light by n × n midpoints.
double exact_on(const Tile& tile, const Exact& exact, int n) {
  const glm::dvec3 up(0, 1, 0);
  const double half = 0.5 * std::sqrt(tile.area_m2);
  const auto mean = [&](int points, const auto& f) {
    return tile_mean(tile.point, {half, 0, 0}, {0, 0, half}, points, f);
  };
  return mean(n, [&](const glm::dvec3& p) { return exact.direct(p, up); }) +
         mean(4, [&](const glm::dvec3& p) { return exact.reflected(p, up); });
}
// Such tiles see the wall at any distance: their means need more than midpoints, and are left out.
bool touches_wall(const Tile& tile) {
  return tile.point.z < wall_z + std::sqrt(tile.area_m2);
}

std::vector<Compared> on_tiles(const Result& result, const Exact& exact, int direct_points, double factor = 1.0) {
  std::vector<Compared> figures;
  const auto all = against(result, "floor", [&](const Tile& tile) {
    return touches_wall(tile) ? -1.0 : factor * exact_on(tile, exact, direct_points);
  });
  for (const Compared& one : all) {
    if (one.expected > 0.0) figures.push_back(one);
  }
  return figures;
}

// Of backward walks every tile has its own error. part: error of the sums of midpoints, as a part of the value.
std::vector<Compared> on_tiles_backward(const Result& result, const Exact& exact, int direct_points, double part) {
  std::vector<Compared> figures;
  for (std::size_t k = 0; k < result.tiles.size(); ++k) {
    const Tile& tile = result.tiling.tiles[k];
    if (result.tiling.maps[tile.map].name != "floor" || touches_wall(tile)) continue;
    const double expected = exact_on(tile, exact, direct_points);
    figures.push_back({result.tiles[k].irradiance, result.tiles[k].standard_error, expected, part * expected});
  }
  return figures;
}

std::vector<Receiver> receivers_of_test() {
  std::vector<Receiver> receivers;
  for (int k = 0; k < 16; ++k) {
    const double x = -2.5 + 5.0 * std::fmod(0.618 * k + 0.11, 1.0);
    const double z = -1.2 + 3.7 * std::fmod(0.755 * k + 0.37, 1.0);
    receivers.push_back(
        {"r" + std::to_string(k), {x, k % 3 == 0 ? 0.4 : 0.05, z}, {0.2 * (k % 2), 1.0, -0.3 * (k % 4)}});
  }
  return receivers;
}

}  // namespace

TEST_CASE("luminaires: tiles, forward and backward, against the exact illuminance") {
  for (const std::string& file : files) {
    const Emitter emitter = mounted(luminaire(file), {0.3, 1.6, 0.2});
    const Room room = floor_and_wall(emitter);
    const Exact exact = exact_of_point(emitter);
    const Result forward = simulate(room, settings_of(Estimator::collision, Engine::embree, 6e5, 31, 0.5));
    check(file + ", forward", compare(on_tiles(forward, exact, 48)));
    Settings settings = settings_of(Estimator::collision, Engine::embree, 1e6, 32, 1.0);
    settings.tile_walk = WalkDirection::backward;
    check(file + ", backward", compare(on_tiles_backward(simulate(room, settings), exact, 200, 2e-4)));
    if (file == "c_skew.ies") check("5 % more light", compare(on_tiles(forward, exact, 48, 1.05)), false);
  }
}

TEST_CASE("luminaires: receivers, by all walks, against the exact illuminance") {
  for (const std::string& file : files) {
    const Emitter emitter = mounted(luminaire(file), {0.3, 1.6, 0.2});
    Room room = floor_and_wall(emitter);
    room.receivers = receivers_of_test();
    const Exact exact = exact_of_point(emitter);
    for (const ReceiverWalk walk : {ReceiverWalk::backward, ReceiverWalk::next_event, ReceiverWalk::two_way}) {
      Settings settings = settings_of(Estimator::weight, Engine::embree, 3e5, 33);
      settings.measured = Measured::receivers;
      settings.receiver_walk = walk;
      const Result result = simulate(room, settings);
      std::vector<Compared> figures;
      std::vector<Compared> more;
      for (std::size_t k = 0; k < room.receivers.size(); ++k) {
        const Receiver& receiver = room.receivers[k];
        const glm::dvec3 normal = glm::normalize(receiver.normal);
        const ReceiverResult& one = result.receiver_results[k];
        const double direct = exact.direct(receiver.position, normal);
        CHECK(std::abs(one.direct - direct) <= 1e-6 * std::max(direct, 1e-3));
        figures.push_back({one.indirect, one.standard_error, exact.reflected(receiver.position, normal), 0.0});
        more.push_back(figures.back());
        more.back().expected *= 1.1;
      }
      const std::string name = file + ", " + std::string(to_string(walk));
      check(name, compare(figures, Deviations::correlated));
      if (file == "c_skew.ies") check(name + ", 10 % more light", compare(more, Deviations::correlated), false);
    }
  }
}

namespace {

// The illuminance without reflection by light from all over an opening: the mean over the points of a Fibonacci
// lattice, n a Fibonacci number and m the one before it.
double direct_from_opening(const Emitter& emitter, int n, int m, const glm::dvec3& point, const glm::dvec3& normal) {
  const auto& shape = std::get<MeasuredEmitter>(emitter.shape);
  double sum = 0.0;
  for (std::int64_t k = 0; k < n; ++k) {
    const glm::dvec3 p =
        shape.opening->place((static_cast<double>(k) + 0.5) / n, (static_cast<double>(k * m % n) + 0.5) / n);
    sum += direct_from(emitter, shape.position + p.x * shape.c0 + p.y * shape.c90 + p.z * shape.axis, point, normal);
  }
  return sum / n;
}
Exact exact_of_opening(const Emitter& emitter) {
  return Exact([emitter](const glm::dvec3& point, const glm::dvec3& normal) {
    return direct_from_opening(emitter, 610, 377, point, normal);
  });
}

Emitter with_opening(OpeningForm form, const glm::dvec3& size) {
  auto photometry = std::make_shared<Photometry>(*luminaire("c_skew.ies"));
  photometry->opening = {form, size};
  return mounted(photometry, {0.3, 1.0, 0.2}, true);
}

}  // namespace

// Under a luminaire of 1.2 m at 1 m the same light from a point is rejected.
TEST_CASE("luminaires: light from all over an opening, tiles and receivers") {
  struct Case {
    OpeningForm form;
    glm::dvec3 size;
  };
  const std::vector<Case> cases{{OpeningForm::rectangle, {1.2, 0.6, 0.0}},   {OpeningForm::ellipse, {0.8, 0.8, 0.0}},
                                {OpeningForm::box, {1.2, 0.3, 0.2}},         {OpeningForm::cylinder, {0.4, 0.4, 0.5}},
                                {OpeningForm::cylinder_c0, {1.2, 0.1, 0.1}}, {OpeningForm::ellipsoid, {0.6, 0.6, 0.6}}};
  for (const Case& one : cases) {
    const Emitter emitter = with_opening(one.form, one.size);
    Room room = floor_and_wall(emitter);
    const Exact exact = exact_of_opening(emitter);
    const Exact point = exact_of_point(emitter);
    const std::string name(name_of(one.form));
    const Result forward = simulate(room, settings_of(Estimator::collision, Engine::embree, 6e5, 34, 0.5));
    check(name + ", tiles forward", compare(on_tiles(forward, exact, 6)));
    if (one.size.x > 1.0) check(name + ", tiles forward, as a point", compare(on_tiles(forward, point, 6)), false);
    Settings settings = settings_of(Estimator::collision, Engine::embree, 5e5, 35, 1.0);
    settings.tile_walk = WalkDirection::backward;
    check(name + ", tiles backward", compare(on_tiles_backward(simulate(room, settings), exact, 6, 5e-3)));
    room.receivers = receivers_of_test();
    for (const ReceiverWalk walk : {ReceiverWalk::backward, ReceiverWalk::next_event, ReceiverWalk::two_way}) {
      settings = settings_of(Estimator::weight, Engine::embree, 2e5, 36);
      settings.measured = Measured::receivers;
      settings.receiver_walk = walk;
      const Result result = simulate(room, settings);
      std::vector<Compared> indirect;
      for (std::size_t k = 0; k < room.receivers.size(); ++k) {
        const Receiver& receiver = room.receivers[k];
        const glm::dvec3 normal = glm::normalize(receiver.normal);
        const ReceiverResult& got = result.receiver_results[k];
        // Stratified points to a relative standard error of 0.1 %: five of them.
        const double expected = direct_from_opening(emitter, 46368, 28657, receiver.position, normal);
        if (walk == ReceiverWalk::backward) CHECK(std::abs(got.direct / expected - 1.0) < 5e-3);
        indirect.push_back({got.indirect, got.standard_error, exact.reflected(receiver.position, normal), 0.0});
      }
      check(name + ", receivers, " + std::string(to_string(walk)), compare(indirect, Deviations::correlated));
    }
  }
}
