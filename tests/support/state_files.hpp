// State files for tests: to change and to seal again.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <unistd.h>

#include "lichtmc/lichtmc.hpp"
#include "run/state_data.hpp"

namespace lichtmc::test {

// A folder with a file for one test.
class Scratch {
 public:
  Scratch() { std::filesystem::create_directories(folder_); }
  ~Scratch() { std::filesystem::remove_all(folder_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  std::filesystem::path file() const { return folder_ / "state.h5"; }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("lichtmc_state_file_" + std::to_string(::getpid()));
};

std::string bytes_of(const std::filesystem::path& file);
void write_bytes(const std::filesystem::path& file, std::string_view bytes);

// Seals the file, whatever its contents are.
void seal_again(const std::filesystem::path& file);

// A unit cube with a receiver.
Room small_room();

// 24 tiles on 6 tile maps, 20 000 photons, forward and backward, by the closed form.
Settings small_settings(Estimator estimator);

// The state of a run of the small room, with a fixed duration.
StateData small_state(const Settings& settings);

void write(const StateData& data, const std::filesystem::path& file);

}  // namespace lichtmc::test
