// A communicator by MPI. Link lichtmc::mpi, which exists if lichtmc was built with LICHTMC_MPI.
#pragma once

#include <memory>

#include "lichtmc/communicator.hpp"

namespace lichtmc {

// MPI is finalized when the object is destroyed, which is collective.
class MpiCommunicator : public Communicator {
 public:
  // Ends all ranks immediately with this exit status, if one of them cannot continue.
  [[noreturn]] virtual void abort(int status) = 0;
};

// Joins the processes that mpirun or a batch system has started together. Returns null if this process was started
// alone; MPI is then not initialized. Call it once per process; call the collective operations from the same thread.
// Throws RuntimeError if MPI fails.
std::unique_ptr<MpiCommunicator> join_mpi();

}  // namespace lichtmc
