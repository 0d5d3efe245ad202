// A 128-bit hash of bytes that are added piece by piece: XXH3. It detects accidental damage; it does not protect
// against deliberate changes. (Y. Collet, xxHash, https://xxhash.com.)
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
  // Adds the length too, so that the boundary to what follows counts.
  void add(std::string_view text) {
    add(std::uint64_t{text.size()});
    add(text.data(), text.size());
  }

  // Low and high word of the hash of everything added so far.
  std::array<std::uint64_t, 2> value() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// 32 hexadecimal digits, the high word first.
std::string to_hex(const std::array<std::uint64_t, 2>& value);

}  // namespace lichtmc
