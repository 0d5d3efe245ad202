// The processes that mpirun has started together with this one.
#pragma once

#include <memory>

#include "lichtmc/team.hpp"

namespace lichtmc::app {

// A team, and how to end it where one member cannot go on.
class ProcessTeam {
 public:
  // Throws InputError where several were started and this program was built without MPI.
  ProcessTeam();
  ~ProcessTeam();
  ProcessTeam(const ProcessTeam&) = delete;
  ProcessTeam& operator=(const ProcessTeam&) = delete;

  Team* get() const;  // null where this process is alone
  // Says why, and ends all members with the exit status; returns where this process is alone.
  void end(const char* message, int status) const;

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace lichtmc::app
