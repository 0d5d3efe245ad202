// The processes that mpirun has started together with this one.
#pragma once

#include <memory>

#include "lichtmc/communicator.hpp"

namespace lichtmc::app {

// A team, and how to end it where one member cannot go on.
class ProcessGroup {
 public:
  // Throws InputError where several were started and this program was built without MPI.
  ProcessGroup();
  ~ProcessGroup();
  ProcessGroup(const ProcessGroup&) = delete;
  ProcessGroup& operator=(const ProcessGroup&) = delete;

  Communicator* get() const;  // null where this process is alone
  // Says why, and ends all members with the exit status; returns where this process is alone.
  void end(const char* message, int status) const;

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace lichtmc::app
