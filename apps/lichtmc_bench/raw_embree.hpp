// Embree alone: the number of flights of a walk that it traces per second.
#pragma once

#include <cstddef>
#include <memory>

#include "rooms.hpp"

namespace lichtmc::bench {

class RawEmbree {
 public:
  // Records the flights of about the first `flights` impacts of a walk through the stage's room.
  RawEmbree(const Stage& stage, std::size_t flights);
  ~RawEmbree();
  RawEmbree(const RawEmbree&) = delete;
  RawEmbree& operator=(const RawEmbree&) = delete;

  // Traces all flights, prepared beforehand, one by one or in packets of 8 or 16; returns their number.
  double trace(int packet);

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace lichtmc::bench
