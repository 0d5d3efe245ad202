// Ctrl-C as a request to stop, not as the end.
#pragma once

#include <stop_token>
#include <thread>

namespace lichtmc::app {

// While it lives, the first SIGINT (Ctrl-C), SIGTERM or SIGHUP (the terminal is gone) asks for a stop; a second one
// ends the program at once. A SIGHUP that the program was started to ignore (nohup) stays ignored.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  std::stop_token token() const { return source_.get_token(); }

 private:
  bool hears_hang_up_;
  std::stop_source source_;
  std::jthread watcher_;
};

}  // namespace lichtmc::app
