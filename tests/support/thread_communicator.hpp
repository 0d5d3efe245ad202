// A communicator whose ranks are threads of one process: as lichtmc::mpi, but without MPI.
#pragma once

#include <barrier>
#include <cstddef>
#include <functional>
#include <vector>

#include "lichtmc/communicator.hpp"

namespace lichtmc::test {

// Calls work(communicator) on `size` threads, one per rank; returns when all have returned. `work` must not throw.
void run_ranks(unsigned size, const std::function<void(Communicator&)>& work);

}  // namespace lichtmc::test
