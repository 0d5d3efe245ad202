// Processes that share one run: all call simulate() with the same room and settings, and each simulates a part.
//
// The library needs three collective operations: every member calls the same one in the same order, and returns when
// its result is there. lichtmc::mpi (lichtmc/mpi.hpp) does them by MPI; another transport is a class like it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace lichtmc {

class Communicator {
 public:
  virtual ~Communicator() = default;

  // This member's number, 0 … size() − 1. Member 0, the first, decides what hangs on rounding and calls back.
  virtual unsigned rank() const = 0;
  virtual unsigned size() const = 0;

  // Every member gets the sums over all, element by element, modulo 2⁶⁴.
  virtual void sum(std::span<std::uint64_t> words) = 0;
  // The same for integers of 128 bits: pairs of words, the low one first; modulo 2¹²⁸.
  virtual void sum_wide(std::span<std::uint64_t> words) = 0;
  // Every member gets what the first has.
  virtual void broadcast(std::span<std::byte> bytes) = 0;

 protected:
  Communicator() = default;
  Communicator(const Communicator&) = default;
  Communicator& operator=(const Communicator&) = default;
};

}  // namespace lichtmc
