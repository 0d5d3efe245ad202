#include "luminaire_rows.hpp"

#include <cmath>
#include <memory>
#include <numbers>

#include "lichtmc/photometry.hpp"
#include "lichtmc/simulate.hpp"
#include "rooms.hpp"

namespace lichtmc::bench {

namespace {

std::shared_ptr<const Photometry> office_photometry() {
  CandelaTable::Grid grid;
  grid.type = PhotometricType::c;
  grid.symmetry = PhotometricSymmetry::none;
  for (int k = 0; k <= 72; ++k) grid.horizontal_deg.push_back(5.0 * k);
  for (int k = 0; k <= 72; ++k) grid.vertical_deg.push_back(2.5 * k);
  constexpr double degree = std::numbers::pi / 180.0;
  for (const double c : grid.horizontal_deg) {
    const double across = 1.0 + 0.3 * std::cos(2.0 * c * degree) + 0.05 * std::sin(c * degree);
    for (const double g : grid.vertical_deg) {
      const double down = std::fmax(0.0, std::cos(g * degree));
      const double up = std::fmax(0.0, -std::cos(g * degree));
      grid.candela.push_back(across * (900.0 * down * down + 150.0 * up));
    }
  }
  auto photometry = std::make_shared<Photometry>();
  photometry->candela = std::make_shared<const CandelaTable>(std::move(grid));
  return photometry;
}

Emitter spot(const glm::dvec3& position, double power) {
  return {"spot", power, SpotEmitter{position, {0.0, -1.0, 0.0}, 0.4, 1.2}};
}

// A cube of 4 m with spheres as furniture, with n × n lamps below its ceiling.
template <class Lamp>
Room furnished(int n, const Lamp& lamp) {
  Room room = room_of_triangles(11'000);
  room.emitters.clear();
  for (int k = 0; k < n * n; ++k)
    room.emitters.push_back(lamp({4.0 * (k % n + 0.5) / n, 3.7, 4.0 * (k / n + 0.5) / n}, 100.0));
  return room;
}

Settings forward() {
  Settings settings;
  settings.engine = Engine::embree;
  return settings;
}

Work launching(Stage& stage, std::uint64_t photons) {
  return [&stage, photons, rays = std::make_shared<Rays>(batch_histories),
          photon = std::make_shared<std::vector<std::uint32_t>>(batch_histories)] {
    const Stream stream(1);
    for (std::uint64_t first = 0; first < photons; first += batch_histories)
      stage.scene().launcher->launch_all(stream, first, batch_histories, *rays, photon->data());
    return static_cast<double>(photons);
  };
}

Measured launch(const Options& options, int n) {
  Stage measured(furnished(n, office_luminaire), forward(), 0.1);
  Stage spots(furnished(n, spot), forward(), 0.1);
  const std::uint64_t photons = options.quick ? 1'024'000 : 4'096'000;
  const Ratio ratio = compare_speeds(launching(measured, photons), launching(spots, photons), options.turns());
  const std::string lamps =
      n == 1 ? "1 measured luminaire against a spot" : std::to_string(n * n) + " measured luminaires against spots";
  return {"photons launched per second by " + lamps,
          ratio.value,
          1.0 / 1.3,
          true,
          "",
          details_of(ratio, "measured_per_second", "spots_per_second")};
}

Measured whole_walk(const Options& options) {
  Stage measured(furnished(3, office_luminaire), forward(), 0.1);
  Stage spots(furnished(3, spot), forward(), 0.1);
  const auto walking = [&](Stage& stage) -> Work { return [&] { return stage.walk(options.impacts() / 4.0); }; };
  const Ratio ratio = compare_speeds(walking(measured), walking(spots), options.turns());
  return {"impacts per second of a furnished room with 9 measured luminaires against spots",
          ratio.value,
          {},
          true,
          "",
          details_of(ratio, "measured_per_second", "spots_per_second")};
}

// Receivers by one walk, light of all lamps at every surface of a backward walk.
Measured receiver_walk(const Options& options, ReceiverWalk walk) {
  const auto walking = [&](Room room) -> Work {
    for (int k = 0; k < 16; ++k)
      room.receivers.push_back({"r" + std::to_string(k), {0.2 + 0.23 * k, 0.05, 3.8 - 0.21 * k}, {0.0, 1.0, 0.0}});
    Settings settings = forward();
    settings.threads = 1;
    settings.measured = lichtmc::Measured::receivers;
    settings.receiver_walk = walk;
    settings.estimator = Estimator::weight;
    settings.photons = options.quick ? 200'000 : 600'000;
    return [room = std::make_shared<Room>(std::move(room)), settings] {
      simulate(*room, settings);
      return static_cast<double>(settings.photons);
    };
  };
  const Ratio ratio =
      compare_speeds(walking(furnished(2, office_luminaire)), walking(furnished(2, spot)), options.turns());
  return {
      "histories per second of receivers, " + std::string(to_string(walk)) + ", 4 measured luminaires against spots",
      ratio.value,
      {},
      true,
      "",
      details_of(ratio, "measured_per_second", "spots_per_second")};
}

}  // namespace

Emitter office_luminaire(const glm::dvec3& position, double power) {
  static const std::shared_ptr<const Photometry> photometry = office_photometry();
  return {"luminaire", power, MeasuredEmitter{photometry, position}};
}

std::vector<Measured> luminaire_rows(const Options& options) {
  return {launch(options, 1), launch(options, 3), whole_walk(options), receiver_walk(options, ReceiverWalk::backward),
          receiver_walk(options, ReceiverWalk::next_event)};
}

}  // namespace lichtmc::bench
