#include "receiver_table.hpp"

#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>
#include <string_view>

#include "lichtmc/error.hpp"
#include "quantities.hpp"

namespace lichtmc::app {

namespace {

constexpr const char* form = "x,y,z,nx,ny,nz or x,y,z,nx,ny,nz,name";

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.remove_suffix(1);
  return text;
}

// The first six fields; the rest is the name, which may contain commas.
std::vector<std::string_view> fields_of(std::string_view row) {
  std::vector<std::string_view> fields;
  while (fields.size() < 6) {
    const std::size_t comma = row.find(',');
    fields.push_back(trimmed(row.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    row.remove_prefix(comma + 1);
  }
  fields.push_back(trimmed(row));
  return fields;
}

bool is_heading(const std::vector<std::string_view>& fields) {
  return !fields.front().empty() && std::isalpha(static_cast<unsigned char>(fields.front().front())) != 0 &&
         fields.front() != "nan" && fields.front() != "inf";
}

Receiver parse_row(const std::string& where, const std::vector<std::string_view>& fields, std::size_t number) {
  if (fields.size() < 6) {
    throw InputError(where + " has " + std::to_string(fields.size()) + " fields (allowed: " + form +
                     "). Give the position in metres and the normal of the receiver.");
  }
  Receiver receiver;
  for (int k = 0; k < 3; ++k) {
    receiver.position[k] = parse_number(fields[static_cast<std::size_t>(k)], where);
    receiver.normal[k] = parse_number(fields[static_cast<std::size_t>(k) + 3], where);
  }
  if (receiver.normal == glm::dvec3(0.0)) {
    throw InputError(where +
                     " has the normal 0,0,0 (allowed: any other). Give the direction that the receiver faces, for "
                     "example 0,1,0 for upwards.");
  }
  receiver.name = fields.size() > 6 ? std::string(fields[6]) : "";
  if (receiver.name.empty()) receiver.name = "receiver_" + std::to_string(number);
  return receiver;
}

std::vector<Receiver> read_from(std::istream& in, const std::string& name) {
  std::vector<Receiver> receivers;
  std::size_t row = 0;
  bool heading_allowed = true;
  for (std::string line; std::getline(in, line);) {
    ++row;
    const std::string_view text = trimmed(line);
    if (text.empty() || text.front() == '#') continue;
    const std::vector<std::string_view> fields = fields_of(text);
    if (heading_allowed && is_heading(fields)) {
      heading_allowed = false;
      continue;
    }
    heading_allowed = false;
    receivers.push_back(parse_row(name + ", row " + std::to_string(row) + ",", fields, receivers.size()));
  }
  if (in.bad()) throw InputError("Cannot read " + name + ". Check its disk.");
  if (receivers.empty()) throw InputError(name + " contains no receiver (allowed: at least one row " + form + ").");
  return receivers;
}

}  // namespace

std::vector<Receiver> read_receivers(const std::string& file) {
  if (file == "-") return read_from(std::cin, "The table on stdin");
  std::ifstream in(file);
  if (!in)
    throw InputError("Cannot open " + file + " (" + std::strerror(errno) + "). Check the name given to --receivers.");
  return read_from(in, file);
}

}  // namespace lichtmc::app
