// A result together with the room that it belongs to: what all views of a result keep alive.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "lichtmc/result.hpp"
#include "shared_room.hpp"

namespace lichtmc::python {

struct RunResult {
  RunResult(std::shared_ptr<const KeptRoom> of, Result found) : room(std::move(of)), result(std::move(found)) {}
  // A result with its tiles is large, and views show its memory.
  RunResult(const RunResult&) = delete;
  RunResult& operator=(const RunResult&) = delete;

  const std::shared_ptr<const KeptRoom> room;
  const Result result;
};

// What Python objects hold.
using RunResultPtr = std::shared_ptr<RunResult>;

inline RunResultPtr make_run_result(std::shared_ptr<const KeptRoom> room, Result result) {
  return std::make_shared<RunResult>(std::move(room), std::move(result));
}

// Parts of a result, as Python sees them: the result, and which part.
struct Tiles {
  RunResultPtr run;
};

}  // namespace lichtmc::python
