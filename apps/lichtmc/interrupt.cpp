#include "interrupt.hpp"

#include <atomic>
#include <chrono>
#include <csignal>

namespace lichtmc::app {

namespace {

// The signal handler only sets this flag (async-signal-safe); the watcher thread requests the stop.
std::atomic<int> interrupted{0};
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void note_interrupt(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

InterruptWatch::InterruptWatch() {
  interrupted = 0;
  handles_hangup_ = std::signal(SIGHUP, note_interrupt) != SIG_IGN;
  if (!handles_hangup_) std::signal(SIGHUP, SIG_IGN);
  std::signal(SIGINT, note_interrupt);
  std::signal(SIGTERM, note_interrupt);
  watcher_ = std::jthread([this](const std::stop_token& ended) {
    while (!ended.stop_requested() && interrupted == 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (interrupted != 0) source_.request_stop();
  });
}

InterruptWatch::~InterruptWatch() {
  if (handles_hangup_) std::signal(SIGHUP, SIG_DFL);
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

}  // namespace lichtmc::app
