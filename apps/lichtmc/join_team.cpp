#include "join_team.hpp"

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

struct ProcessTeam::Connection {
  std::unique_ptr<MpiTeam> team = join_mpi_team();
};

ProcessTeam::ProcessTeam() : connection_(std::make_unique<Connection>()) {}

Team* ProcessTeam::get() const {
  return connection_->team.get();
}

// Most faults, as a wrong option, all members find at the same time: then the first speaks and ends the others.
void ProcessTeam::end(const char* message, int status) const {
  if (connection_->team == nullptr) return;
  const unsigned rank = connection_->team->rank();
  if (rank > 0) {
    std::this_thread::sleep_for(std::chrono::seconds(2));
    std::cerr << "lichtmc (process " << rank << " of " << connection_->team->size() << "): " << message << std::endl;
  } else {
    std::cerr << "lichtmc: " << message << std::endl;
  }
  connection_->team->abort(status);
}

#else

struct ProcessTeam::Connection {};

ProcessTeam::ProcessTeam() {
  const char* size = std::getenv("OMPI_COMM_WORLD_SIZE");
  if (size != nullptr && std::string(size) != "1")
    throw InputError(std::string("lichtmc was started as ") + size +
                     " processes, and was built without MPI: each would do all the work. Start it without mpirun, or "
                     "build it with -DLICHTMC_MPI=ON.");
}

Team* ProcessTeam::get() const {
  return nullptr;
}

void ProcessTeam::end(const char* /*message*/, int /*status*/) const {}

#endif

ProcessTeam::~ProcessTeam() = default;

}  // namespace lichtmc::app
