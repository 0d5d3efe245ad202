// Ctrl-C as a request to stop, not as the end.
#pragma once

#include <stop_token>
#include <thread>

namespace lichtmc::app {

// While it lives, the first SIGINT or SIGTERM asks for a stop; a second one ends the program at once.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::jthread watcher_;
};

}  // namespace lichtmc::app
