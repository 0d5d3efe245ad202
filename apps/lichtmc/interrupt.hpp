// Ctrl-C as a request to stop.
#pragma once

#include <stop_token>
#include <thread>

namespace lichtmc::app {

// During its lifetime the first SIGINT (Ctrl-C), SIGTERM or SIGHUP (the terminal was closed) requests a stop; a second
// signal ends the program at once. If SIGHUP was ignored at the start (nohup), it stays ignored.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  std::stop_token token() const { return source_.get_token(); }

 private:
  bool handles_hangup_;
  std::stop_source source_;
  std::jthread watcher_;
};

}  // namespace lichtmc::app
