#include "process_group.hpp"

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <string>
#include <thread>

#include "lichtmc/error.hpp"
#ifdef LICHTMC_WITH_MPI
#include "lichtmc/mpi.hpp"
#endif

namespace lichtmc::app {

#ifdef LICHTMC_WITH_MPI

struct ProcessGroup::Connection {
  std::unique_ptr<MpiCommunicator> communicator = join_mpi();
};

ProcessGroup::ProcessGroup() : connection_(std::make_unique<Connection>()) {}

Communicator* ProcessGroup::get() const {
  return connection_->communicator.get();
}

// Most errors, such as a wrong option, occur in all processes at the same time. Then only rank 0 reports the error and
// ends the others.
void ProcessGroup::end(const char* message, int status) const {
  if (connection_->communicator == nullptr) return;
  const unsigned rank = connection_->communicator->rank();
  if (rank > 0) {
    std::this_thread::sleep_for(std::chrono::seconds(2));
    std::cerr << "lichtmc (process " << rank << " of " << connection_->communicator->size() << "): " << message
              << std::endl;
  } else {
    std::cerr << "lichtmc: " << message << std::endl;
  }
  connection_->communicator->abort(status);
}

#else

struct ProcessGroup::Connection {};

ProcessGroup::ProcessGroup() {
  const char* size = std::getenv("OMPI_COMM_WORLD_SIZE");
  if (size != nullptr && std::string(size) != "1")
    throw InputError(std::string("lichtmc was started as ") + size +
                     " processes, but was built without MPI: each process would simulate the whole run. Start it "
                     "without mpirun, or build it with -DLICHTMC_MPI=ON.");
}

Communicator* ProcessGroup::get() const {
  return nullptr;
}

void ProcessGroup::end(const char* /*message*/, int /*status*/) const {}

#endif

ProcessGroup::~ProcessGroup() = default;

}  // namespace lichtmc::app
