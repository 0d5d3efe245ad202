// Files that a user or a room names: anything but a regular file of a sensible size is refused, at once.
#include <filesystem>
#include <fstream>
#include <string>

#include <sys/stat.h>

#include "base/read_file.hpp"
#include "lichtmc/error.hpp"
#include "support/catch.hpp"
#include "support/gltf_text.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

TEST_CASE("a regular file is read, whole or its start") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "file";
  std::ofstream(file) << "12345";
  CHECK(read_regular_file(file, 5).bytes == "12345");
  CHECK(read_start_of_file(file, 3).bytes == "123");
  CHECK(read_start_of_file(file, 9).bytes == "12345");
  CHECK(require_regular_file(file, 10, "file", "Do this.") == "12345");
}

TEST_CASE("folders, pipes, devices and files that are too large are refused without waiting") {
  const TemporaryFolder folder;
  const std::filesystem::path pipe = folder.path() / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(read_regular_file(pipe, 10).fault == "it is a pipe");
  CHECK(read_regular_file(folder.path(), 10).fault == "it is a folder");
  CHECK(read_regular_file("/dev/zero", 10).fault == "it is a device");
  CHECK(read_start_of_file("/dev/zero", 10).fault == "it is a device");

  const std::filesystem::path large = folder.path() / "large";
  std::ofstream(large) << "1";
  std::filesystem::resize_file(large, std::uintmax_t{1} << 40);  // sparse: it takes no space
  CHECK_THAT(read_regular_file(large, 1000).fault,
             ContainsSubstring("1099511627776 bytes, more than the limit of 1000"));
  CHECK(read_start_of_file(large, 2).bytes == std::string("1\0", 2));

  const FileContent missing = read_regular_file(folder.path() / "none", 10);
  CHECK(missing.missing);
  CHECK(missing.fault == "No such file or directory");
}

TEST_CASE("a file that must exist is refused with its name, what is allowed and what to do") {
  const TemporaryFolder folder;
  const auto message = [](const std::filesystem::path& file) -> std::string {
    try {
      require_regular_file(file, 10, "the table 'x'", "Give a table.");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK(message(folder.path()) ==
        "Cannot read the table 'x' (it is a folder; allowed: a regular file of up to 10 bytes). Give a table.");
  CHECK(message(folder.path() / "none") == "Cannot read the table 'x' (No such file or directory). Give a table.");
}
