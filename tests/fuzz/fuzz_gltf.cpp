// Fuzz target: reading any bytes ends with a room or an InputError.
//
// Built with clang's libFuzzer (preset `fuzz`), under the address and undefined-behaviour sanitizers. Seeds: the files
// of the room folder; tools/fuzz.sh runs it.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include <unistd.h>

#include "lichtmc/error.hpp"
#include "lichtmc/gltf.hpp"

namespace {

// A file for this process, in memory if the system has a folder for that.
struct OwnFile {
  std::filesystem::path path;
  OwnFile() {
    const std::filesystem::path memory = "/dev/shm";
    const std::filesystem::path folder =
        std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
    path = folder / ("lichtmc_fuzz_" + std::to_string(::getpid()) + ".gltf");
  }
  ~OwnFile() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
  OwnFile(const OwnFile&) = delete;
  OwnFile& operator=(const OwnFile&) = delete;
};

const std::filesystem::path& file() {
  static const OwnFile own;
  return own.path;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  {
    std::ofstream out(file(), std::ios::binary | std::ios::trunc);
    out.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  }
  try {
    const lichtmc::Room room = lichtmc::read_gltf(file());
    lichtmc::check_room(room);
  } catch (const lichtmc::InputError&) {  // the result for malformed files
  }
  return 0;
}
