#include <cstdio>

#include "lichtmc/lichtmc.hpp"

int main() {
  lichtmc::Room room = lichtmc::read_gltf("office.glb");
  lichtmc::set_maintenance_factor(room, 0.8);
  lichtmc::lay_areas(room);  // those of the file
  lichtmc::AreaProperties desks;
  desks.name = "desks";
  desks.target_lx = 300.0;
  lichtmc::lay_working_planes(room, 0.75, desks);
  lichtmc::Settings settings;
  settings.measured = lichtmc::Measured::receivers;
  settings.photons = lichtmc::no_photon_limit;
  settings.target_error = 0.01;
  const lichtmc::Result result = lichtmc::simulate(room, settings);
  for (const lichtmc::AreaResult& one : result.areas)
    std::printf("%s: Em %.1f ± %.1f lx, U0 %.3f ± %.3f\n", one.area.properties.name.c_str(), one.mean.value,
                one.mean.standard_error, one.uniformity.value, one.uniformity.standard_error);
}
