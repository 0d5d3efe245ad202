// A team whose members are threads of one process: what lichtmc::mpi does over machines, without MPI.
#pragma once

#include <barrier>
#include <cstddef>
#include <functional>
#include <vector>

#include "lichtmc/communicator.hpp"

namespace lichtmc::test {

// Calls work(team) on `size` threads, one for each member; returns when all have. Exceptions are not expected.
void run_ranks(unsigned size, const std::function<void(Communicator&)>& work);

}  // namespace lichtmc::test
