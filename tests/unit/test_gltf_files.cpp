// Files from other authors: valid files load with all their triangles, malformed files are refused.
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "lichtmc/error.hpp"
#include "lichtmc/gltf.hpp"
#include "support/catch.hpp"

using namespace lichtmc;

namespace {

struct Entry {
  std::string file, errors, codes, triangles;
};

// The list of files with the verdict of the Khronos validator and their triangle counts; empty if the folder is absent.
std::vector<Entry> entries(const std::string& folder) {
  std::vector<Entry> list;
  std::ifstream in(std::string(LICHTMC_ROOMS) + "/expected.tsv");
  if (!in)
    WARN("skipped: " << LICHTMC_ROOMS
                     << "/expected.tsv is not there (set LICHTMC_ROOMS to the folder of the room files)");
  for (std::string line; std::getline(in, line);) {
    std::istringstream fields(line);
    Entry entry;
    std::getline(fields, entry.file, '\t');
    std::getline(fields, entry.errors, '\t');
    std::getline(fields, entry.codes, '\t');
    std::getline(fields, entry.triangles, '\t');
    if (entry.file.rfind(folder, 0) == 0) list.push_back(entry);
  }
  return list;
}

// Triangles of a room, including those that were left out because they have no area.
std::size_t triangles_of(const Room& room) {
  std::size_t count = 0;
  for (const Surface& surface : room.surfaces) count += surface.triangles.size() + surface.without_area;
  return count;
}

// The validator counts a mesh with several instances once, and does not read compressed buffers.
std::string triangles_placed(const Entry& entry) {
  const std::map<std::string, std::string> corrected{{"conformance/others/simple-instancing.glb", "1500"},
                                                     {"conformance/others/BoxMeshopt.glb", "12"},
                                                     {"conformance/others/BoxMeshopt.gltf", "12"}};
  const auto found = corrected.find(entry.file);
  return found == corrected.end() ? entry.triangles : found->second;
}

}  // namespace

TEST_CASE("valid files load with all their triangles") {
  for (const Entry& entry : entries("conformance/")) {
    if (entry.errors != "0") continue;
    INFO(entry.file);
    const Room room = read_gltf(std::string(LICHTMC_ROOMS) + "/" + entry.file);
    CHECK(std::to_string(triangles_of(room)) == triangles_placed(entry));
  }
}

TEST_CASE("real rooms load") {
  for (const Entry& entry : entries("real/")) {
    INFO(entry.file);
    const Room room = read_gltf(std::string(LICHTMC_ROOMS) + "/" + entry.file);
    CHECK(triangles_of(room) > 0);
  }
}

TEST_CASE("malformed files are refused with a message or read without error") {
  for (const Entry& entry : entries("malformed/")) {
    INFO(entry.file);
    try {
      read_gltf(std::string(LICHTMC_ROOMS) + "/" + entry.file);
    } catch (const InputError& error) {
      CHECK(std::string(error.what()).find(std::filesystem::path(entry.file).filename().string()) != std::string::npos);
    }
  }
}
