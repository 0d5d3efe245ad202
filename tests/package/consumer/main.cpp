#include <iostream>

#include <lichtmc/lichtmc.hpp>

int main() {
  // A room of 5 m × 2.6 m × 4 m that reflects 60 %, with a lamp of 2000 lm below the ceiling.
  lichtmc::Room room = lichtmc::make_cuboid({5.0, 2.6, 4.0}, lichtmc::uniform_reflectance(0.6));
  room.emitters.push_back({"lamp", 2000.0, lichtmc::LambertEmitter{{2.5, 2.5, 2.0}, {0, -1, 0}, 1.0}});

  lichtmc::Settings settings;
  settings.photons = 200'000;
  const lichtmc::Result result = lichtmc::simulate(room, settings);
  for (const lichtmc::SurfaceResult& surface : result.surfaces) {
    std::cout << surface.name << ": " << surface.mean_irradiance << " +- " << surface.standard_error << " lx\n";
  }
}
