// Direct light of luminaires with photometric files, compared with illuminances that another program computed.
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "lichtmc/photometry.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
namespace fs = std::filesystem;

namespace {

constexpr std::array<glm::dvec3, 9> points{
    {{0, 0, 0}, {2, 0, 0}, {0, 0, -2}, {-2, 0, 0}, {0, 0, 2}, {1.5, 0, -1}, {-1, 0, -2.5}, {-2, 0, 1.5}, {3, 0, 2}}};

// A row of illuminance.tsv.
struct Pose {
  std::string file;
  glm::dvec3 nadir{0.0};
  double rotation_deg = 0.0;
  std::array<double, points.size()> lux{};
};

// The columns are found by their names: "file", "nadir", "rotation_deg", then the points from "E_lx_x0_z0" on.
std::vector<Pose> read_poses(const fs::path& table) {
  std::ifstream file(table);
  std::vector<Pose> poses;
  std::size_t file_column = 0;
  for (std::string line; std::getline(file, line);) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, '\t');) cells.push_back(cell);
    if (poses.empty() && file_column == 0 && line.find("nadir") != std::string::npos) {
      while (cells.at(file_column) != "file") ++file_column;
      continue;
    }
    Pose& pose = poses.emplace_back();
    pose.file = cells.at(file_column);
    std::istringstream nadir(cells.at(file_column + 1));
    char comma = 0;
    nadir >> pose.nadir.x >> comma >> pose.nadir.y >> comma >> pose.nadir.z;
    pose.rotation_deg = std::stod(cells.at(file_column + 2));
    for (std::size_t k = 0; k < points.size(); ++k) pose.lux[k] = std::stod(cells.at(file_column + 3 + k));
  }
  return poses;
}

// A black floor 1 m below the points, so that each of them is in free space.
Room black_room(const Pose& pose, const fs::path& folder) {
  Room room;
  room.source = "floor";
  Surface& floor = room.surfaces.emplace_back();
  floor.name = "floor";
  floor.reflectance = 0.0;
  floor.positions = {{-5, -1, -5}, {5, -1, -5}, {-5, -1, 5}, {5, -1, 5}};
  floor.triangles = {{0, 2, 1}, {1, 2, 3}};
  LuminaireOptions options;
  options.rotation_deg = pose.rotation_deg;
  LuminaireEmitter mounted = mount(std::make_shared<const Photometry>(read_photometry(folder / pose.file)), {0, 3, 0},
                                   axes_towards(pose.nadir), options, pose.file);
  room.emitters.push_back({pose.file, mounted.power, std::move(mounted.shape)});
  for (const glm::dvec3& point : points) {
    Receiver& receiver = room.receivers.emplace_back();
    receiver.name = "p" + std::to_string(room.receivers.size());
    receiver.position = point;
  }
  return room;
}

std::vector<double> direct_illuminances(const Room& room) {
  Settings settings = settings_of(Estimator::collision, Engine::embree, 1024, 1);
  settings.measured = Measured::receivers;
  std::vector<double> lux;
  for (const ReceiverResult& one : simulate(room, settings).receiver_results) {
    CHECK(one.irradiance == one.direct);
    lux.push_back(one.direct);
  }
  return lux;
}

// The largest relative difference. The tables have seven digits: 5e-7 of rounding.
double difference(const std::vector<double>& found, const Pose& pose) {
  REQUIRE(found.size() == points.size());
  double largest = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) largest = std::max(largest, std::abs(found[k] / pose.lux[k] - 1.0));
  return largest;
}

constexpr double tolerance = 1e-6;

std::size_t check_poses(const fs::path& table, const fs::path& folder) {
  const std::vector<Pose> poses = read_poses(table);
  for (const Pose& pose : poses) {
    INFO(pose.file << " " << pose.rotation_deg);
    CHECK(difference(direct_illuminances(black_room(pose, folder)), pose) < tolerance);
  }
  return poses.size();
}

}  // namespace

TEST_CASE("luminaires give the illuminances of the table in every pose") {
  const fs::path folder = fs::path(LICHTMC_TEST_DATA) / "luminaires";
  CHECK(check_poses(folder / "illuminance.tsv", folder) == 10);
}

TEST_CASE("luminaires of other authors give the illuminances of the table") {
  const fs::path folder = fs::path(LICHTMC_ROOMS).parent_path() / "luminaires";
  const fs::path table = folder / "ILLUMINANCE.tsv";
  if (!fs::exists(table)) {
    WARN("absent: " << table.string());
    return;
  }
  CHECK(check_poses(table, folder / "valid") > 0);
}

TEST_CASE("a luminaire that is mirrored, turned or rotated the other way is not that of the table") {
  const fs::path folder = fs::path(LICHTMC_TEST_DATA) / "luminaires";
  for (const Pose& pose : read_poses(folder / "illuminance.tsv")) {
    if (pose.file != "c_skew.ies" && pose.file != "c_typeb.ies") continue;
    INFO(pose.file << " " << pose.rotation_deg);
    const Room right = black_room(pose, folder);
    const auto changed = [&](const auto& change) {
      Room wrong = right;
      change(std::get<MeasuredEmitter>(wrong.emitters.front().shape));
      return difference(direct_illuminances(wrong), pose);
    };
    CHECK(changed([](MeasuredEmitter& one) { one.c90 = -one.c90; }) > 0.01);
    CHECK(changed([](MeasuredEmitter& one) { std::swap(one.c0, one.c90); }) > 0.01);
    CHECK(changed([](MeasuredEmitter& one) {
            const glm::dvec3 c0 = one.c0;
            one.c0 = one.c90;
            one.c90 = -c0;
          }) > 0.01);
    if (pose.rotation_deg == 0.0) continue;
    Pose opposite = pose;
    opposite.rotation_deg = -pose.rotation_deg;
    CHECK(difference(direct_illuminances(black_room(opposite, folder)), pose) > 0.01);
  }
}
