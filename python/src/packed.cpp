#include "packed.hpp"

#include <array>
#include <cstdio>
#include <functional>
#include <new>

#include <xxhash.h>

#include "consistency.hpp"
#include "fields_of_result.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/state_bytes.hpp"
#include "lichtmc/version.hpp"
#include "lichtmc/visible_text.hpp"

namespace lichtmc::python {

namespace {

constexpr const char* of_room = "lichtmc room";
constexpr const char* of_result = "lichtmc result";
constexpr const char* of_result_beside_state = "lichtmc result beside state.h5";

// The number changes whenever the members in fields_of_room.hpp or fields_of_result.hpp do.
std::string beginning(const std::string& kind) {
  return kind + ", layout 1, version " + std::string(version()) + ", ";
}

std::string checksum(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "XXH3-128 %016llx%016llx", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return text.data();
}

std::string first_line(const std::string& kind, std::string_view content) {
  return beginning(kind) + std::to_string(content.size()) + " bytes follow; " + checksum(content) + "\n";
}

// The line before the others in result.lichtmc. It has no version, so that it can be compared by all versions.
std::string line_of_seal(std::string_view seal) {
  return "lichtmc, of the state.h5 that begins with " + checksum(seal) + "\n";
}

std::string packed(const std::string& kind, const std::function<void(BytesOut&)>& write) {
  BytesOut out;
  write(out);
  return first_line(kind, out.bytes) + out.bytes;
}

[[noreturn]] void refuse(const std::string& source, const std::string& what) {
  throw InputError("Cannot read " + source + ": " + what);
}

// The checksum does not detect what was made on purpose.
void require(bool consistent) {
  if (!consistent) throw cereal::Exception("their numbers and indices do not fit each other");
}

void read_packed(const std::string& kind, std::string_view bytes, const std::string& source,
                 const std::function<void(BytesIn&)>& read) {
  const std::size_t end = bytes.substr(0, 256).find('\n');
  const std::string_view line = bytes.substr(0, end == std::string_view::npos ? 0 : end + 1);
  if (!line.starts_with(kind + ", layout "))
    refuse(source, "its beginning is not '" + kind + "' (allowed: what lichtmc has written). Give another one.");
  if (!line.starts_with(beginning(kind))) {
    const std::string found(line.substr(0, line.find(", ", line.find("version"))));
    refuse(source, "it is '" + visible_text(found) + "' (allowed: '" +
                       beginning(kind).substr(0, beginning(kind).size() - 2) +
                       "'). Read it with the version of lichtmc that wrote it, or simulate again.");
  }
  const std::string_view content = bytes.substr(line.size());
  const char* const damaged = "it is damaged or cut off (allowed: the unchanged bytes). Use a copy, or simulate again.";
  if (line != first_line(kind, content)) refuse(source, damaged);
  BytesIn in(content);
  try {
    read(in);
  } catch (const cereal::Exception&) {
    refuse(source, damaged);
  } catch (const std::bad_alloc&) {
    throw RuntimeError("There is not enough memory to read " + source + ". Free some, or use a machine that has more.");
  }
  if (!in.at_end()) refuse(source, damaged);
}

}  // namespace

std::string pack(const Room& room) {
  return packed(of_room, [&](BytesOut& out) { out(room); });
}

std::string pack(const RunResult& run) {
  const std::string state = state_bytes(run.result.state, run.result.state.note());
  return packed(of_result, [&](BytesOut& out) { out(run.room->room, run.result, state); });
}

std::string pack_beside_state(const Room& room, const Result& result, std::string_view seal) {
  return line_of_seal(seal) + packed(of_result_beside_state, [&](BytesOut& out) { out(room, result); });
}

Room unpack_room(std::string_view bytes, const std::string& source) {
  Room room;
  read_packed(of_room, bytes, source, [&](BytesIn& in) {
    in(room);
    require(is_consistent(room));
  });
  return room;
}

RunResult unpack_result(std::string_view bytes, const std::string& source) {
  Room room;
  Result result;
  std::string state;
  read_packed(of_result, bytes, source, [&](BytesIn& in) {
    in(room, result, state);
    require(is_consistent(result, room));
  });
  result.state = parse_state(state, source);
  return {std::make_shared<KeptRoom>(std::move(room)), std::move(result)};
}

std::optional<ResultBesideState> unpack_beside_state(std::string_view bytes, std::string_view seal,
                                                     const std::string& source) {
  const std::string line = line_of_seal(seal);
  if (!bytes.starts_with(line)) return std::nullopt;
  ResultBesideState found;
  read_packed(of_result_beside_state, bytes.substr(line.size()), source, [&](BytesIn& in) {
    in(found.room, found.result);
    require(is_consistent(found.result, found.room));
  });
  return found;
}

}  // namespace lichtmc::python
