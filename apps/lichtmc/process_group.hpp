// The processes that mpirun started together with this one.
#pragma once

#include <memory>

#include "lichtmc/communicator.hpp"

namespace lichtmc::app {

// The communicator of these processes, and how to end them if one cannot continue.
class ProcessGroup {
 public:
  // Throws InputError if several processes were started and this program was built without MPI.
  ProcessGroup();
  ~ProcessGroup();
  ProcessGroup(const ProcessGroup&) = delete;
  ProcessGroup& operator=(const ProcessGroup&) = delete;

  Communicator* get() const;  // null for a single process
  // Prints the message and ends all processes with the exit status; returns for a single process.
  void end(const char* message, int status) const;

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace lichtmc::app
