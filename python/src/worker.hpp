// Long work for Python code: it runs in a thread of its own, while the calling thread waits without Python's lock, so
// that other Python threads go on.
//
// The calling thread passes progress on to Python and looks for signals some times a second. Hence a callback needs no
// thought about threads, an exception from it ends the work and is raised, and Ctrl-C (KeyboardInterrupt) requests a
// stop: the work then returns what it has. If it has nothing yet, or nothing that is of use alone, and after a second
// Ctrl-C, KeyboardInterrupt is raised when the work has stopped.
#pragma once

#include <nanobind/nanobind.h>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

namespace lichtmc::python {

namespace nb = nanobind;

// How often the calling thread looks for signals: a response to Ctrl-C that feels immediate. 20 times a second costs
// nothing measurable.
inline constexpr std::chrono::milliseconds look_for_signals{50};

// What becomes of work that the first Ctrl-C has stopped.
enum class Interrupted {
  returns,  // what it has
  raises,   // nothing: KeyboardInterrupt
};

// The part that does not depend on the types of the work.
class CallingThread {
 public:
  // With Python's lock, which is held at the end too. Raises SystemExit if Python is ending.
  CallingThread(std::stop_source stop, Interrupted interrupted);
  ~CallingThread();
  CallingThread(const CallingThread&) = delete;
  CallingThread& operator=(const CallingThread&) = delete;

  // Runs `call`, which may call Python, and Python's signal handlers. The lock is taken for it.
  void visit_python(const std::function<void()>& call) noexcept;
  // Raises the first exception that `visit_python` has met, if any; `failed`: also a first Ctrl-C, because the work has
  // nothing to return; SystemExit if Python is ending. With the lock.
  void raise(bool failed) const;

  // At the end of Python: stops the work of all threads, and waits until it has ended. Python ends the threads that are
  // left then (daemon threads) when they next ask for its lock, by unwinding their stacks, which the functions of this
  // module do not allow.
  static void end_all();

 private:
  void note(std::exception_ptr error);

  static std::vector<CallingThread*>& running();  // only used with the lock

  int process_;  // after a fork the threads of the parent are not here
  std::stop_source stop_;
  Interrupted policy_;
  std::exception_ptr interrupt_;  // the first Ctrl-C
  std::exception_ptr error_;
};

// Carries out work(stop, tell) -> Outcome, where tell(const Report&) may be called from any thread, and passes the
// reports on to on_report(const Report&), which may be empty. A report replaces one that has not been passed on yet.
// `work` may not call Python.
template <class Outcome, class Report>
Outcome work_aside(const std::function<Outcome(std::stop_token, const std::function<void(const Report&)>&)>& work,
                   const std::function<void(const Report&)>& on_report,
                   Interrupted interrupted = Interrupted::returns) {
  std::mutex mutex;
  std::condition_variable changed;
  std::optional<Report> report;
  std::optional<Outcome> outcome;
  std::exception_ptr failure;
  bool done = false;
  std::stop_source stop;
  CallingThread caller(stop, interrupted);
  {
    const nb::gil_scoped_release without_lock;
    std::jthread thread([&] {
      try {
        outcome.emplace(work(stop.get_token(), [&](const Report& latest) {
          const std::scoped_lock lock(mutex);
          report = latest;
          changed.notify_one();
        }));
      } catch (...) {
        failure = std::current_exception();
      }
      const std::scoped_lock lock(mutex);
      done = true;
      changed.notify_one();
    });
    for (bool working = true; working;) {
      std::optional<Report> latest;
      {
        std::unique_lock lock(mutex);
        changed.wait_for(lock, look_for_signals, [&] { return done || (report.has_value() && on_report); });
        std::swap(latest, report);
        working = !done;
      }
      caller.visit_python([&] {
        if (latest && on_report) on_report(*latest);
      });
    }
  }
  caller.raise(failure != nullptr);
  if (failure) std::rethrow_exception(failure);
  return std::move(*outcome);
}

}  // namespace lichtmc::python
