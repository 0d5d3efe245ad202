// Fuzz target: any bytes as a table of receivers end with receivers or an InputError, and receivers that were read
// have finite positions and a normal. What a table contains does not depend on its line ends or on a byte order mark.
//
// Built like fuzz_gltf. Seeds: tests/fuzz/receivers/.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "lichtmc/error.hpp"
#include "lichtmc/receiver_table.hpp"
#include "lichtmc/visible_text.hpp"

namespace {

std::optional<lichtmc::ReceiverTable> read(std::string_view bytes) {
  try {
    return lichtmc::parse_receiver_table(bytes, "table");
  } catch (const lichtmc::InputError& error) {  // the result for malformed tables; its text is for a terminal
    const std::string text = error.what();
    if (lichtmc::visible_text(text) != text) std::abort();
    return std::nullopt;
  }
}

void check(const lichtmc::ReceiverTable& table) {
  if (table.receivers.empty()) std::abort();
  for (const lichtmc::Receiver& receiver : table.receivers) {
    for (int k = 0; k < 3; ++k) {
      if (!std::isfinite(receiver.position[k]) || !std::isfinite(receiver.normal[k])) std::abort();
    }
    if (receiver.normal == glm::dvec3(0.0) || receiver.name.empty()) std::abort();
    const bool optics = receiver.area_m2 >= 0.0 && receiver.half_angle_deg >= 0.0 && receiver.half_angle_deg <= 90.0 &&
                        receiver.concentrator_index.value_or(1.0) >= 1.0 && receiver.filter_gain >= 0.0;
    if (!optics) std::abort();
  }
}

bool same(const lichtmc::ReceiverTable& a, const lichtmc::ReceiverTable& b) {
  if (a.receivers.size() != b.receivers.size()) return false;
  for (std::size_t k = 0; k < a.receivers.size(); ++k) {
    const lichtmc::Receiver& one = a.receivers[k];
    const lichtmc::Receiver& other = b.receivers[k];
    if (one.position != other.position || one.normal != other.normal || one.name != other.name) return false;
  }
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const std::optional<lichtmc::ReceiverTable> table = read(bytes);
  if (!table) return 0;
  check(*table);
  // Line ends in names are part of them, and files with a byte order mark have one.
  if (bytes.find('"') != std::string::npos || static_cast<unsigned char>(bytes.front()) >= 0x80) return 0;
  if (bytes.find('\r') == std::string::npos) {
    std::string carriage = bytes;
    for (char& c : carriage) c = c == '\n' ? '\r' : c;
    const std::optional<lichtmc::ReceiverTable> other = read(carriage);
    if (!other || !same(*table, *other)) std::abort();
  }
  const std::optional<lichtmc::ReceiverTable> marked = read("\xEF\xBB\xBF" + bytes);
  if (!marked || !same(*table, *marked)) std::abort();
  return 0;
}
