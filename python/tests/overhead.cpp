// The C++ side of tools/measure_python.py: runs the simulations that it is told on stdin, one a line, and prints what
// each took. Room and settings are those of the Python side.
//
// Line: ROOM PHOTONS THREADS, where ROOM is "cuboid" or the path of a glTF file. Answer: wall seconds, CPU seconds, the
// incident power (to compare).
#include <chrono>
#include <cstdint>
#include <ctime>
#include <iomanip>
#include <iostream>
#include <string>

#include "lichtmc/lichtmc.hpp"

namespace {

lichtmc::Room room_of(const std::string& name) {
  if (name != "cuboid") return lichtmc::read_gltf(name);
  lichtmc::Room room = lichtmc::make_cuboid({5.0, 2.6, 4.0}, lichtmc::uniform_reflectance(0.6));
  room.emitters.push_back({"lamp", 2000.0, lichtmc::LambertEmitter{{2.5, 2.5, 2.0}, {0.0, -1.0, 0.0}, 1.0}});
  return room;
}

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

int main() {
  std::string name;
  lichtmc::Settings settings;
  std::cout << std::setprecision(17);
  while (std::cin >> name >> settings.photons >> settings.threads) {
    const lichtmc::Room room = room_of(name);
    const double cpu_before = cpu_seconds();
    const auto before = std::chrono::steady_clock::now();
    const lichtmc::Result result = lichtmc::simulate(room, settings);
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - before;
    std::cout << wall.count() << ' ' << cpu_seconds() - cpu_before << ' ' << result.incident << std::endl;
  }
}
