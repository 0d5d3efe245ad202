// A team of processes that MPI connects: link lichtmc::mpi, which is there where lichtmc was built with LICHTMC_MPI.
#pragma once

#include <memory>

#include "lichtmc/communicator.hpp"

namespace lichtmc {

// MPI lasts as long as the object does; its members leave together, by its destruction.
class MpiCommunicator : public Communicator {
 public:
  // Ends all members at once, with this exit status: where one of them cannot go on.
  [[noreturn]] virtual void abort(int status) = 0;
};

// Joins the processes that mpirun or a batch system has started together; null where this one was started alone, and
// then MPI is not touched at all. Once in a process. The team's operations are to be called from the thread that calls
// this. Throws RuntimeError where MPI fails.
std::unique_ptr<MpiCommunicator> join_mpi();

}  // namespace lichtmc
