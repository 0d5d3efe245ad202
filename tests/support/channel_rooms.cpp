#include "support/channel_rooms.hpp"

#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "lichtmc/cuboid.hpp"
#include "lichtmc/simulate.hpp"
#include "support/rooms.hpp"

namespace lichtmc::test {

namespace {

constexpr glm::dvec3 up{0.0, 1.0, 0.0};
constexpr double square_centimetre = 1e-4;

std::vector<std::string> fields_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> fields;
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

double number_in(const std::string& field) {
  std::istringstream in(field);
  double value = 0.0;
  return in >> value ? value : std::numeric_limits<double>::quiet_NaN();
}

// Without the lines that begin with #.
std::vector<std::vector<std::string>> read_fields(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot open " + file);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line.front() != '#') rows.push_back(fields_of(line));
  }
  return rows;
}

}  // namespace

Settings channel_settings(double width_s, double span_s, double histories, std::uint64_t seed) {
  Settings settings = settings_of(Estimator::weight, Engine::automatic, histories, seed);
  settings.measured = Measured::receivers;
  settings.channel.bin_width_s = width_s;
  settings.channel.time_span_s = span_s;
  settings.channel.orders = 5;
  return settings;
}

ImpulseResponses channels_of(const Room& room, const Settings& settings) {
  return *simulate(room, settings).channels;
}

std::map<std::string, std::vector<double>> channel_table(const std::string& name) {
  return read_columns(LICHTMC_TEST_DATA "/channel/" + name + ".csv");
}

Room barry_room(double half_angle_deg) {
  Room room = make_cuboid({5.0, 3.0, 5.0}, {0.3, 0.8, 0.8, 0.8, 0.8, 0.8});
  room.quantity = Quantity::radiometric;
  room.emitters.push_back(lambert({2.5, 3.0, 2.5}, -up, 1.0));
  room.emitters.back().name = "lamp";
  room.receivers.push_back({"eye", {0.5, 0.0, 1.0}, up, half_angle_deg, square_centimetre});
  return room;
}

Room cube_with_receivers() {
  Room room = unit_cube(0.6, paper_emitter());
  room.receivers.push_back({"centre", {0.5, 0.0, 0.5}, up});
  room.receivers.push_back({"corner", {0.05, 0.0, 0.05}, up});
  return room;
}

Room partitioned_room() {
  Room room = make_cuboid({6.0, 2.7, 5.0}, {0.3, 0.8, 0.7, 0.7, 0.7, 0.7});
  room.quantity = Quantity::radiometric;
  Surface partition;
  partition.name = partition.material = "partition";
  partition.reflectance = 0.5;
  partition.sides = Sides::both;
  partition.positions = {{3.0, 0.0, 0.0}, {3.0, 1.8, 0.0}, {3.0, 1.8, 5.0}, {3.0, 0.0, 5.0}};
  partition.triangles = {{0, 1, 2}, {0, 2, 3}};
  room.surfaces.push_back(partition);
  room.emitters.push_back(lambert({1.0, 1.5, 2.5}, {1.0, 0.0, 0.0}, 1.0));
  room.receivers.push_back({"eye", {5.0, 0.8, 3.3}, up, 85.0, square_centimetre});
  return room;
}

std::map<std::string, std::vector<double>> read_columns(const std::string& file) {
  const std::vector<std::vector<std::string>> rows = read_fields(file);
  std::map<std::string, std::vector<double>> columns;
  for (std::size_t column = 0; column < rows.at(0).size(); ++column) {
    std::vector<double>& values = columns[rows[0][column]];
    for (std::size_t row = 1; row < rows.size(); ++row)
      values.push_back(column < rows[row].size() ? number_in(rows[row][column])
                                                 : std::numeric_limits<double>::quiet_NaN());
  }
  return columns;
}

std::map<std::string, double> derived_reference(const std::string& room, const std::string& set) {
  const std::vector<std::vector<std::string>> rows = read_fields(LICHTMC_TEST_DATA "/channel/derived.csv");
  for (const std::vector<std::string>& row : rows) {
    if (row[0] != room || row[1] != set) continue;
    std::map<std::string, double> figures;
    for (std::size_t k = 2; k < rows[0].size(); ++k)
      figures[rows[0][k]] = k < row.size() ? number_in(row[k]) : std::numeric_limits<double>::quiet_NaN();
    return figures;
  }
  throw std::logic_error("no figures of " + room + ", " + set);
}

}  // namespace lichtmc::test
