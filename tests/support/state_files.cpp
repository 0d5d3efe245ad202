#include "support/state_files.hpp"

#include <fstream>
#include <iterator>
#include <memory>

#include "store/sealed_file.hpp"
#include "store/state_layout.hpp"
#include "support/rooms.hpp"

namespace lichtmc::test {

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const std::filesystem::path& file, std::string_view bytes) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void seal_again(const std::filesystem::path& file) {
  const std::string rest = bytes_of(file).substr(seal_bytes);
  write_bytes(file, seal_of(state_title, rest) + rest);
}

Room small_room() {
  Room room = unit_cube(0.5, paper_emitter());
  room.receivers.push_back({"desk", {0.5, 0.3, 0.5}, {0, 1, 0}, 90.0, 1.0});
  return room;
}

Settings small_settings(Estimator estimator) {
  Settings settings = settings_of(estimator, Engine::cuboid, 20'000, 1, 0.5);
  settings.measured = Measured::all;
  settings.threads = 1;
  return settings;
}

StateData small_state(const Settings& settings) {
  StateData data = simulate(small_room(), settings).state.data();
  const auto in_no_time = [](Walked& walked) {
    walked.seconds = 0.5;
    walked.convergence = {{20'000, 0.25, 0.1}};
  };
  if (data.photons) in_no_time(*data.photons);
  if (data.tile_walks) in_no_time(*data.tile_walks);
  if (data.receivers) in_no_time(*data.receivers);
  return data;
}

void write(const StateData& data, const std::filesystem::path& file) {
  write_state(State(std::make_shared<const StateData>(data)), file);
}

}  // namespace lichtmc::test
