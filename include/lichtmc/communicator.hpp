// Processes (ranks) that share one run: all call simulate() with the same room and settings, and each simulates a part.
//
// The library needs three collective operations: all ranks call the same operation in the same order, and each call
// returns when its result is available. lichtmc::mpi (lichtmc/mpi.hpp) implements them by MPI; for another transport,
// derive a class.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace lichtmc {

class Communicator {
 public:
  virtual ~Communicator() = default;

  // Number of this rank, 0 … size() − 1. Rank 0 makes the decisions that depend on rounding or time, and the callbacks.
  virtual unsigned rank() const = 0;
  virtual unsigned size() const = 0;

  // Reduction: all ranks get the sums over all ranks, element by element, modulo 2⁶⁴.
  virtual void sum(std::span<std::uint64_t> words) = 0;
  // The same for integers of 128 bits: pairs of words, the low one first; modulo 2¹²⁸.
  virtual void sum_wide(std::span<std::uint64_t> words) = 0;
  // All ranks get the bytes of rank 0.
  virtual void broadcast(std::span<std::byte> bytes) = 0;

 protected:
  Communicator() = default;
  Communicator(const Communicator&) = default;
  Communicator& operator=(const Communicator&) = default;
};

}  // namespace lichtmc
