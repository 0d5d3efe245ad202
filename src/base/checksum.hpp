// A hash of 128 bits over bytes that come piece by piece: XXH3, which finds any damage but is no protection against
// intent. (Y. Collet, xxHash, https://xxhash.com.)
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace lichtmc {

class Checksum {
 public:
  Checksum();
  ~Checksum();
  Checksum(const Checksum&) = delete;
  Checksum& operator=(const Checksum&) = delete;

  void add(const void* bytes, std::size_t n);
  // Numbers by their bits: −0 and 0 are different.
  template <class Number>
  requires std::is_arithmetic_v<Number>
  void add(Number value) { add(&value, sizeof value); }
  // With its length, so that what follows cannot be taken for a part of it.
  void add(std::string_view text) {
    add(std::uint64_t{text.size()});
    add(text.data(), text.size());
  }

  // Low and high word of what was added so far.
  std::array<std::uint64_t, 2> value() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// 32 hexadecimal digits, the high word first.
std::string to_hex(const std::array<std::uint64_t, 2>& value);

}  // namespace lichtmc
