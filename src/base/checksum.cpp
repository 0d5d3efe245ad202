#include "base/checksum.hpp"

#include <cstdio>
#include <new>

#include <xxhash.h>

namespace lichtmc {

struct Checksum::State {
  XXH3_state_t* hash = XXH3_createState();
  State() {
    if (hash == nullptr) throw std::bad_alloc();
    XXH3_128bits_reset(hash);
  }
  ~State() { XXH3_freeState(hash); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
};

Checksum::Checksum() : state_(std::make_unique<State>()) {}
Checksum::~Checksum() = default;

void Checksum::add(const void* bytes, std::size_t n) {
  if (n > 0) XXH3_128bits_update(state_->hash, bytes, n);
}

std::array<std::uint64_t, 2> Checksum::value() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_->hash);
  return {hash.low64, hash.high64};
}

std::string to_hex(const std::array<std::uint64_t, 2>& value) {
  char text[33];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(value[1]),
                static_cast<unsigned long long>(value[0]));
  return text;
}

}  // namespace lichtmc
